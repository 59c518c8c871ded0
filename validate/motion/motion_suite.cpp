// Reads and writes the cases of vectors/motion.
#include "validate/motion/motion_suite.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "scene/motion/motion_files.h"
#include "validate/motion/mesh_places.h"
#include "validate/vectors/side_lint.h"
#include "validate/vectors/side_topic.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;
using scene::ConstraintPlace;
using scene::MotionConstraint;

constexpr const char* format_name = "clues-motion-vectors/1";

// [CONSTRAINT, TRIANGLE, CORNER, ...]
ConstraintPlace place_of(const Json& value, std::size_t length, std::size_t triangles, const std::string& where) {
  if (!value.is_array() || value.size() != length) refuse(where, scene::json_excerpt(value) + " is no constraint");
  for (const auto constraint : {MotionConstraint::facing, MotionConstraint::edge_length, MotionConstraint::separation,
                                MotionConstraint::delaunay}) {
    if (value[0] != scene::name_of(constraint)) continue;
    try {
      const auto triangle = scene::whole_number(value[1], "the triangle", triangles == 0 ? 0 : triangles - 1);
      const auto corner = scene::whole_number(value[2], "the corner", constraint == MotionConstraint::facing ? 0 : 2);
      return {constraint, static_cast<std::uint32_t>(triangle), static_cast<std::uint8_t>(corner)};
    } catch (const scene::JsonError& e) {
      refuse(where, e.what());
    }
  }
  refuse(where,
         scene::json_excerpt(value[0]) + " is no constraint; there are facing, edge-length, separation, delaunay");
}

std::vector<double> bounds_of(const Json& list, std::size_t triangles, const std::string& where) {
  if (!list.is_array() || list.size() != triangles) {
    refuse(where, fmt::format("must be a list of {} bounds, one a triangle", triangles));
  }
  std::vector<double> out;
  for (const auto& value : list) out.push_back(scene::bound_of(value, where));
  return out;
}

void read_expectation(const Json& expect, MotionVector& out, const std::string& where) {
  check_keys(expect, {"violated", "sound", "unsound"}, {"exact"}, where);
  const auto triangles = out.mesh.triangles.size();
  if (!expect["violated"].is_array()) refuse(where + ".violated", "must be a list");
  for (const auto& item : expect["violated"]) {
    out.violated.push_back(place_of(item, 3, triangles, where + ".violated"));
  }
  out.sound = bounds_of(expect["sound"], triangles, where + ".sound");
  out.unsound = bounds_of(expect["unsound"], triangles, where + ".unsound");
  out.has_expectation = true;
  if (!expect.contains("exact")) return;
  if (!expect["exact"].is_array() || expect["exact"].empty()) refuse(where + ".exact", "must be a list with items");
  for (const auto& item : expect["exact"]) {
    const auto place = place_of(item, 4, triangles, where + ".exact");
    const auto square = text_in(item[3], where + ".exact");
    mpq_class number;
    if (square.find_first_not_of("0123456789/") != std::string::npos || number.set_str(square, 10) != 0 ||
        sgn(number.get_den()) == 0) {
      refuse(where + ".exact", "'" + square + "' is no fraction p/q");
    }
    out.exact.push_back({place, square});
  }
}

MotionVector read_case(const Json& value, const std::string& file, bool drafts) {
  MotionVector out;
  out.file = file;
  check_keys(value, {"id", "comment", "viewpoint", "thresholds", "samples", "triangles"}, {"expect"}, file);
  out.id = case_id_in(value, file);
  const auto where = place_of_case(file, out.id);
  out.comment = comment_in(value, where);
  out.viewpoint = scene::motion_point_of(value["viewpoint"], where + ": viewpoint");
  out.thresholds = scene::thresholds_of(value["thresholds"], where + ": thresholds");
  out.mesh = scene::depth_mesh_of(value["samples"], value["triangles"], where);
  if (out.mesh.triangles.empty()) refuse(where, "there is no triangle");
  if (const MeshPlaces places(out.mesh); out.thresholds.delaunay && !places.tangled.empty()) {
    refuse(where, places.tangled);
  }
  if (value.contains("expect")) {
    read_expectation(value["expect"], out, where + ": expect");
  } else if (!drafts) {
    refuse_draft(where);
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

bool is_motion_suite(const std::filesystem::path& folder) { return is_suite_of(folder, format_name); }

MotionTopic parse_motion_topic(std::string_view text, const std::string& file, bool drafts) {
  return topic_in<MotionTopic>(text, file, format_name,
                               [&](const Json& value) { return read_case(value, file, drafts); });
}

MotionTopic read_motion_topic(const std::filesystem::path& path, bool drafts) {
  return parse_motion_topic(scene::read_file_bytes(path), path.string(), drafts);
}

std::string to_json_text(const MotionTopic& topic) {
  std::vector<std::string> cases;
  for (const MotionVector& test : topic.cases) cases.push_back(case_to_text(test));
  return topic_to_text(format_name, topic.topic, cases);
}

std::vector<MotionVector> read_motion_suite(const std::filesystem::path& folder) {
  std::vector<MotionVector> out;
  std::set<std::string> ids;
  for (const auto& path : side_vector_files(folder)) {
    for (auto& test : read_motion_topic(path).cases) {
      if (!ids.insert(test.id).second) refuse(path.string(), "the id '" + test.id + "' is there twice");
      out.push_back(std::move(test));
    }
  }
  if (out.empty()) refuse(folder.string(), "there is no case");
  return out;
}

}  // namespace clues::validate
