// D7: a potentially visible set from a result file or a plain list of triangle ids.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/result.h"

namespace clues::scene {
namespace {

using Json = nlohmann::json;

std::uint32_t checked_id(std::uint64_t id, std::uint64_t triangles, const Place& place) {
  if (id >= triangles || id > std::numeric_limits<std::uint32_t>::max()) {
    fail_at(place, ErrorCode::index_out_of_range,
            fmt::format("the id {} is not below the {} triangles of the scene; is it the PVS of another scene?", id,
                        triangles));
  }
  return static_cast<std::uint32_t>(id);
}

bool is_whole_number(std::string_view token) {
  return !token.empty() && token.find_first_not_of("0123456789") == std::string_view::npos;
}

std::vector<std::uint32_t> list_ids(std::string_view bytes, const std::string& file, std::uint64_t triangles) {
  LineReader lines(file, bytes, {});
  std::vector<std::uint32_t> ids;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    for (const auto token : tokens) {
      if (!is_whole_number(token)) {
        fail_at(
            lines.place(), ErrorCode::malformed,
            excerpt(token) + " is not what a PVS holds; write triangle ids, with blanks or ends of lines between them");
      }
      const auto id = parse_integer(token);
      ids.push_back(checked_id(id ? static_cast<std::uint64_t>(*id) : std::numeric_limits<std::uint64_t>::max(),
                               triangles, lines.place()));
    }
  }
  return ids;
}

std::vector<Point> sorted_points(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

[[noreturn]] void fail_other(const std::string& file, const std::string& what) {
  fail_in(file, ErrorCode::malformed, "the result is of " + what + "; give the one that belongs to this question");
}

// A text where a result has one; empty: it says nothing.
std::string text_at(const Json& object, const char* key, const std::string& file) {
  const auto found = object.find(key);
  if (found == object.end()) return {};
  if (!found->is_string())
    fail_in(file, ErrorCode::malformed, fmt::format("\"{}\" is no text; write the result again", key));
  return found->get<std::string>();
}

void check_cell(const Json& json, const std::string& file, const Asked& asked) {
  const auto cell = json.find("cell");
  if (cell == json.end() || asked.cell.empty()) return;
  const auto vertices = cell->is_object() ? cell->find("vertices") : cell->end();
  if (!cell->is_object() || vertices == cell->end() || !vertices->is_array())
    fail_in(file, ErrorCode::malformed, "\"cell\" has no list \"vertices\"; write the result again");
  std::vector<Point> points;
  for (const Json& p : *vertices) {
    const bool three = p.is_array() && p.size() == 3 && p[0].is_number() && p[1].is_number() && p[2].is_number();
    if (!three)
      fail_in(file, ErrorCode::malformed, "a vertex of \"cell\" is not three numbers; write the result again");
    points.push_back({p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
  }
  if (sorted_points(std::move(points)) != sorted_points(asked.cell)) fail_other(file, "another cell");
}

void check_question(const Json& json, const std::string& file, const Asked& asked) {
  const std::string mode = text_at(json, "mode", file);
  if (!mode.empty() && !asked.mode.empty() && mode != asked.mode)
    fail_other(file, "mode " + excerpt(mode) + ", and not " + asked.mode);
  check_cell(json, file, asked);
  const auto scene = json.find("scene");
  if (scene == json.end()) return;
  if (!scene->is_object()) fail_in(file, ErrorCode::malformed, "\"scene\" is no object; write the result again");
  const std::string sha256 = text_at(*scene, "sha256", file);
  if (!sha256.empty() && !asked.scene_sha256.empty() && sha256 != asked.scene_sha256)
    fail_other(file, "another scene, or of an older version of this one (the SHA-256 of the file differs)");
}

void check_head(const Json& json, const std::string& file, std::uint64_t triangles) {
  const auto format = json.is_object() ? json.find("format") : json.end();
  if (!json.is_object() || format == json.end() || !format->is_string()) {
    fail_in(file, ErrorCode::malformed, "no \"format\"; a result file has \"format\": \"clues-result/1\"");
  }
  const auto& name = format->get_ref<const std::string&>();
  if (name != "clues-result/1") {
    fail_in(file, ErrorCode::unsupported, "the format " + excerpt(name) + " is not clues-result/1; convert it");
  }
  const auto scene = json.find("scene");
  if (scene == json.end() || !scene->is_object()) return;
  const auto count = scene->find("triangles");
  if (count != scene->end() && (!count->is_number_unsigned() || *count != triangles)) {
    fail_in(file, ErrorCode::malformed,
            fmt::format("the result is of a scene of {} triangles, but this one has {}; give the matching scene",
                        json_excerpt(*count), triangles));
  }
}

std::vector<std::uint32_t> result_ids(std::string_view bytes, const std::string& file, const Asked& asked) {
  const auto json = parse_json(bytes, file);
  check_head(json, file, asked.triangles);
  check_question(json, file, asked);
  const auto visible = json.find("visible");
  if (visible == json.end() || !visible->is_array()) {
    fail_in(file, ErrorCode::malformed, "no list \"visible\"; add the ids of the visible triangles");
  }
  std::vector<std::uint32_t> ids;
  for (const auto& entry : *visible) {
    const Place place{file, "visible, entry", ids.size()};
    if (!entry.is_number_unsigned()) {
      fail_at(place, ErrorCode::malformed, json_excerpt(entry) + " is not a triangle id; give whole numbers");
    }
    ids.push_back(checked_id(entry.get<std::uint64_t>(), asked.triangles, place));
  }
  return ids;
}

std::vector<std::uint32_t> sorted_unique(std::vector<std::uint32_t> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

std::vector<std::uint32_t> parse_pvs_list(std::string_view bytes, const std::string& file, std::uint64_t triangles) {
  return sorted_unique(list_ids(bytes, file, triangles));
}

std::vector<std::uint32_t> parse_result_pvs(std::string_view bytes, const std::string& file, const Asked& asked) {
  return sorted_unique(result_ids(bytes, file, asked));
}

std::vector<std::uint32_t> read_pvs(const std::filesystem::path& path, const Asked& asked) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;
  const auto bytes = read_file_bytes(path, most_bytes);
  return path.extension() == ".json" ? parse_result_pvs(bytes, path.string(), asked)
                                     : parse_pvs_list(bytes, path.string(), asked.triangles);
}

std::vector<std::uint32_t> read_pvs(const std::filesystem::path& path, std::uint64_t triangles) {
  return read_pvs(path, Asked{triangles, {}, {}, {}});
}

std::string to_pvs_text(const std::vector<std::uint32_t>& visible) {
  std::string text;
  for (const auto id : visible) text += fmt::format("{}\n", id);
  return text;
}

}  // namespace clues::scene
