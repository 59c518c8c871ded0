#include "app/view/page_json.h"

#include "app/view/base64.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

using nlohmann::json;

// Of a list in a result: what is wrong with it, as an exception that names the place.
struct Checked {
  const json& value;
  std::string place;

  [[noreturn]] void fail(const std::string& what) const {
    throw scene::Error(scene::ErrorCode::malformed, place + ": " + what + "; write the result again");
  }
  const json& at(const char* key) const {
    const auto found = value.is_object() ? value.find(key) : value.end();
    if (!value.is_object() || found == value.end()) fail(std::string("there is no \"") + key + "\"");
    return *found;
  }
  // A list of points, `size` of them where that is not 0. What is past the range of doubles is null in a file, and here.
  const json& points(const json& list, std::size_t size) const {
    if (!list.is_array() || (size != 0 && list.size() != size)) fail("a list of points is none, or not complete");
    for (const json& p : list) {
      if (!p.is_array() || p.size() != 3) fail("a point is not three numbers");
      for (const json& x : p)
        if (!x.is_number() && !x.is_null()) fail("a point is not three numbers");
    }
    return list;
  }
};

json region_for_page(const Checked& region, std::uint64_t triangles) {
  json out = json::object();
  out["triangle"] = scene::whole_number(region.at("triangle"), region.place + ": \"triangle\"", triangles - 1);
  const json& side = region.at("side");
  if (side != "front" && side != "back") region.fail("the side is neither \"front\" nor \"back\"");
  out["side"] = side;
  if (!region.at("visible").is_boolean()) region.fail("\"visible\" is neither true nor false");
  out["visible"] = region.at("visible");
  const json& rings = region.at("rings");
  if (!rings.is_array()) region.fail("\"rings\" is no list");
  for (const json& ring : rings) region.points(ring, 0);
  out["rings"] = rings;
  for (const char* area : {"area_fraction", "area_estimate"})
    if (region.value.contains(area)) out[area] = region.value.at(area);
  return out;
}

json list_for_page(const json& result, const char* key, const std::string& file,
                   const std::function<json(const Checked&)>& item) {
  json out = json::array();
  const Checked top{result, file};
  const json& list = top.at(key);
  if (!list.is_array()) top.fail(std::string("\"") + key + "\" is no list");
  for (std::size_t i = 0; i < list.size(); ++i)
    out.push_back(item({list[i], file + ": \"" + key + "\", entry " + std::to_string(i)}));
  return out;
}

}  // namespace

json mesh_for_page(const scene::TriangleMesh& mesh) {
  Base64 points, triangles;
  for (const auto& p : mesh.points)
    for (const double x : p) points.put(x);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t) triangles.put(corner);
  return {{"points", points.take()}, {"triangles", triangles.take()}};
}

json mesh_for_page(const scene::FlaggedMesh& scene) {
  json out = mesh_for_page(scene.mesh);
  if (!scene.is_plain()) {
    Base64 flags;
    for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t)
      flags.put(static_cast<std::uint8_t>((scene.blocking(t) ? 1 : 0) | (scene.counting(t) ? 2 : 0)));
    out["flags"] = flags.take();
  }
  if (!scene.parts.empty()) {
    json& parts = out["parts"] = json::array();
    for (const auto& part : scene.parts) parts.push_back({part.first_triangle, part.name});
  }
  return out;
}

json result_for_page(const json& result, std::uint64_t triangles, const std::string& file) {
  const Checked top{result, file};
  json out = json::object();
  for (const char* key : {"format", "scene", "cell", "method", "kernel", "mode", "visible"}) out[key] = top.at(key);
  top.points(Checked{out["cell"], file + ": \"cell\""}.at("vertices"), 0);
  if (!result.contains("regions")) return out;
  try {
    out["regions"] =
        list_for_page(result, "regions", file, [&](const Checked& r) { return region_for_page(r, triangles); });
    out["segments"] = list_for_page(result, "segments", file, [](const Checked& s) {
      return json{{"boundary", s.at("boundary")}, {"points", s.points(s.at("points"), 2)}};
    });
    out["wedges"] = list_for_page(result, "wedges", file, [](const Checked& w) {
      return json{{"kind", w.at("kind")}, {"points", w.points(w.at("points"), 4)}};
    });
  } catch (const scene::JsonError& problem) {
    throw scene::Error(scene::ErrorCode::malformed, problem.what());
  }
  return out;
}

}  // namespace clues::app
