#include "app/view/page_data.h"

#include "app/view/page_json.h"
#include "scene/json_reader.h"

namespace clues::app {

using nlohmann::json;

void PageData::add_scene(const std::string& name, const scene::TriangleMesh& mesh, const std::string& sha256) {
  put({{"path", name}, {"sha256", sha256}, {"mesh", mesh_for_page(mesh)}});
}

void PageData::add_result(const std::string& name, const scene::Result& result) {
  const json whole = scene::parse_json(scene::to_json_text(result), name);
  put({{"path", name}, {"json", result_for_page(whole, result.scene_triangles, name)}});
}

std::string PageData::text() const {
  return json{{"format", "clues-view/1"}, {"files", files_}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace clues::app
