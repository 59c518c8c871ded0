// Reads and writes the cases of vectors/motion.
#include "validate/motion/motion_suite.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/motion/motion_files.h"
#include "validate/vectors/side_lint.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;
using scene::ConstraintPlace;
using scene::MotionConstraint;

constexpr const char* format_name = "clues-motion-vectors/1";

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw scene::Error(scene::ErrorCode::malformed, where + ": " + what);
}

void require_keys(const Json& object, std::initializer_list<const char*> required,
                  std::initializer_list<const char*> optional, const std::string& where) {
  if (!object.is_object()) fail(where, scene::json_excerpt(object) + " is no object");
  for (const char* key : required) {
    if (!object.contains(key)) fail(where, fmt::format("the field \"{}\" is missing", key));
  }
  for (const auto& item : object.items()) {
    const auto is_key = [&](const char* known) { return item.key() == known; };
    if (std::none_of(required.begin(), required.end(), is_key) &&
        std::none_of(optional.begin(), optional.end(), is_key)) {
      fail(where, "there is no field \"" + item.key() + "\" in this format");
    }
  }
}

std::string text_of(const Json& value, const std::string& where) {
  if (!value.is_string() || value.get<std::string>().empty()) fail(where, "must be a text that is not empty");
  return value.get<std::string>();
}

bool is_slug(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

// [CONSTRAINT, TRIANGLE, CORNER, ...]
ConstraintPlace place_of(const Json& value, std::size_t length, std::size_t triangles, const std::string& where) {
  if (!value.is_array() || value.size() != length) fail(where, scene::json_excerpt(value) + " is no constraint");
  for (const auto constraint : {MotionConstraint::facing, MotionConstraint::edge_length, MotionConstraint::separation,
                                MotionConstraint::delaunay}) {
    if (value[0] != scene::name_of(constraint)) continue;
    try {
      const auto triangle = scene::whole_number(value[1], "the triangle", triangles == 0 ? 0 : triangles - 1);
      const auto corner = scene::whole_number(value[2], "the corner", constraint == MotionConstraint::facing ? 0 : 2);
      return {constraint, static_cast<std::uint32_t>(triangle), static_cast<std::uint8_t>(corner)};
    } catch (const scene::JsonError& e) {
      fail(where, e.what());
    }
  }
  fail(where, scene::json_excerpt(value[0]) + " is no constraint; there are facing, edge-length, separation, delaunay");
}

std::vector<double> bounds_of(const Json& list, std::size_t triangles, const std::string& where) {
  if (!list.is_array() || list.size() != triangles) {
    fail(where, fmt::format("must be a list of {} bounds, one a triangle", triangles));
  }
  std::vector<double> out;
  for (const auto& value : list) out.push_back(scene::bound_of(value, where));
  return out;
}

void read_expectation(const Json& expect, MotionVector& out, const std::string& where) {
  require_keys(expect, {"violated", "sound", "unsound"}, {"exact"}, where);
  const auto triangles = out.mesh.triangles.size();
  if (!expect["violated"].is_array()) fail(where + ".violated", "must be a list");
  for (const auto& item : expect["violated"]) {
    out.violated.push_back(place_of(item, 3, triangles, where + ".violated"));
  }
  out.sound = bounds_of(expect["sound"], triangles, where + ".sound");
  out.unsound = bounds_of(expect["unsound"], triangles, where + ".unsound");
  out.has_expectation = true;
  if (!expect.contains("exact")) return;
  if (!expect["exact"].is_array() || expect["exact"].empty()) fail(where + ".exact", "must be a list with items");
  for (const auto& item : expect["exact"]) {
    const auto place = place_of(item, 4, triangles, where + ".exact");
    const auto square = text_of(item[3], where + ".exact");
    mpq_class number;
    if (square.find_first_not_of("0123456789/") != std::string::npos || number.set_str(square, 10) != 0 ||
        sgn(number.get_den()) == 0) {
      fail(where + ".exact", "'" + square + "' is no fraction p/q");
    }
    out.exact.push_back({place, square});
  }
}

MotionVector read_case(const Json& value, const std::string& file, bool drafts) {
  MotionVector out;
  out.file = file;
  require_keys(value, {"id", "comment", "viewpoint", "thresholds", "samples", "triangles"}, {"expect"}, file);
  out.id = text_of(value["id"], file + ": id");
  const auto where = file + ": case '" + out.id + "'";
  if (!is_slug(out.id)) fail(where, "an id is made of a-z, 0-9 and -");
  out.comment = text_of(value["comment"], where + ": comment");
  if (out.comment.size() < 20) fail(where, "a comment has at least 20 characters");
  out.viewpoint = scene::motion_point_of(value["viewpoint"], where + ": viewpoint");
  out.thresholds = scene::thresholds_of(value["thresholds"], where + ": thresholds");
  out.mesh = scene::depth_mesh_of(value["samples"], value["triangles"], where);
  if (out.mesh.triangles.empty()) fail(where, "there is no triangle");
  if (value.contains("expect")) {
    read_expectation(value["expect"], out, where + ": expect");
  } else if (!drafts) {
    fail(where, "the field \"expect\" is missing (`clues lint --write` fills it in)");
  }
  return out;
}

std::string in_quotes(const std::string& text) { return Json(text).dump(); }

std::string place_to_text(const ConstraintPlace& place) {
  return fmt::format("[\"{}\", {}, {}", scene::name_of(place.constraint), place.triangle, place.corner);
}

template <class List, class ToText>
std::string joined(const List& list, const ToText& to_text) {
  std::string out;
  for (const auto& item : list) out.append(out.empty() ? "" : ", ").append(to_text(item));
  return out;
}

std::string case_to_text(const MotionVector& test) {
  std::string out = "    {\n      \"id\": " + in_quotes(test.id) + ",\n      \"comment\": " + in_quotes(test.comment);
  out += ",\n      \"viewpoint\": " + scene::to_text(test.viewpoint);
  out += ",\n      \"thresholds\": " + scene::to_text(test.thresholds);
  out += ",\n      \"samples\": [" + joined(test.mesh.samples, [](const auto& s) { return scene::to_text(s); }) + "]";
  out += ",\n      \"triangles\": [" +
         joined(test.mesh.triangles, [](const auto& t) { return fmt::format("[{}, {}, {}]", t[0], t[1], t[2]); }) + "]";
  if (!test.has_expectation) return out + "\n    }";
  out += ",\n      \"expect\": {\n        \"violated\": [" +
         joined(test.violated, [](const auto& place) { return place_to_text(place) + "]"; }) + "]";
  const auto bounds = [](const auto& list) { return joined(list, [](double b) { return scene::bound_to_text(b); }); };
  out += ",\n        \"sound\": [" + bounds(test.sound) + "],\n        \"unsound\": [" + bounds(test.unsound) + "]";
  if (!test.exact.empty()) {
    out += ",\n        \"exact\": [" +
           joined(test.exact,
                  [](const auto& known) { return place_to_text(known.place) + ", " + in_quotes(known.square) + "]"; }) +
           "]";
  }
  return out + "\n      }\n    }";
}

}  // namespace

bool is_motion_suite(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / "schema.json", ignored)) return false;
  const auto schema = scene::read_json_file(folder / "schema.json");
  return schema.is_object() && schema.value("title", "") == format_name;
}

MotionTopic parse_motion_topic(std::string_view text, const std::string& file, bool drafts) {
  const auto root = scene::parse_json(text, file);
  require_keys(root, {"format", "topic", "cases"}, {}, file);
  if (root["format"] != format_name) fail(file, fmt::format("\"format\" must be \"{}\"", format_name));
  MotionTopic out{file, text_of(root["topic"], file + ": topic"), {}};
  if (!root["cases"].is_array() || root["cases"].empty()) fail(file, "\"cases\" must be a list with cases");
  for (const auto& value : root["cases"]) out.cases.push_back(read_case(value, file, drafts));
  return out;
}

MotionTopic read_motion_topic(const std::filesystem::path& path, bool drafts) {
  return parse_motion_topic(scene::read_file_bytes(path), path.string(), drafts);
}

std::string to_json_text(const MotionTopic& topic) {
  std::string out =
      fmt::format("{{\n  \"format\": \"{}\",\n  \"topic\": {},\n  \"cases\": [\n", format_name, in_quotes(topic.topic));
  for (std::size_t i = 0; i < topic.cases.size(); ++i) {
    out.append(i == 0 ? "" : ",\n").append(case_to_text(topic.cases[i]));
  }
  return out + "\n  ]\n}\n";
}

std::vector<MotionVector> read_motion_suite(const std::filesystem::path& folder) {
  std::vector<MotionVector> out;
  std::set<std::string> ids;
  for (const auto& path : side_vector_files(folder)) {
    for (auto& test : read_motion_topic(path).cases) {
      if (!ids.insert(test.id).second) fail(path.string(), "the id '" + test.id + "' is there twice");
      out.push_back(std::move(test));
    }
  }
  if (out.empty()) fail(folder.string(), "there is no case");
  return out;
}

}  // namespace clues::validate
