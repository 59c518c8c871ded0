// Depth meshes and motion bounds to JSON and back.
#include "scene/motion/motion_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/motion/malformed.h"

namespace clues::scene {
namespace {

using Json = nlohmann::json;

constexpr const char* kinds[] = {"point", "direction", "base-point", "base-direction"};

double finite(const Json& value, const std::string& where) {
  if (!value.is_number()) throw_malformed(where, json_excerpt(value) + " is no number");
  return value.get<double>();  // the reader has refused what overflows a double
}

void require_format(const Json& root, const char* format, const std::string& where) {
  if (!root.is_object() || !root.contains("format") || root["format"] != format) {
    throw_malformed(where, fmt::format("this is no {} file: \"format\" must be \"{}\"", format, format));
  }
}

void require_keys(const Json& object, std::initializer_list<const char*> required,
                  std::initializer_list<const char*> optional, const std::string& where) {
  if (!object.is_object()) throw_malformed(where, json_excerpt(object) + " is no object");
  for (const char* key : required) {
    if (!object.contains(key)) throw_malformed(where, fmt::format("the field \"{}\" is missing", key));
  }
  for (const auto& [key, value] : object.items()) {
    const auto is_key = [&name = key](const char* known) { return name == known; };
    if (std::none_of(required.begin(), required.end(), is_key) &&
        std::none_of(optional.begin(), optional.end(), is_key)) {
      throw_malformed(where, "there is no field \"" + key + "\" in this format");
    }
  }
}

}  // namespace

MotionPoint motion_point_of(const Json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 3) throw_malformed(where, json_excerpt(value) + " is no point [x, y, z]");
  return {finite(value[0], where), finite(value[1], where), finite(value[2], where)};
}

DepthSample sample_of(const Json& value, const std::string& where) {
  if (!value.is_array() || (value.size() != 3 && value.size() != 4)) {
    throw_malformed(where, json_excerpt(value) + " is no sample [x, y, z] or [x, y, z, KIND]");
  }
  DepthSample sample;
  for (std::size_t i = 0; i < 3; ++i) sample.at[i] = finite(value[i], where);
  if (value.size() == 4) {
    const auto kind = std::find_if(std::begin(kinds), std::end(kinds), [&](const char* k) { return value[3] == k; });
    if (kind == std::end(kinds)) {
      throw_malformed(where, json_excerpt(value[3]) +
                                 " is no kind of sample; there are point, direction, base-point and base-direction");
    }
    const auto number = kind - std::begin(kinds);
    sample.is_direction = number % 2 == 1;
    sample.is_base = number >= 2;
  }
  if (sample.is_direction && sample.at == MotionPoint{}) throw_malformed(where, "a direction of length 0");
  return sample;
}

MotionThresholds thresholds_of(const Json& value, const std::string& where) {
  require_keys(value, {"kappa", "sigma"}, {"delaunay"}, where);
  MotionThresholds thresholds;
  thresholds.kappa = finite(value["kappa"], where + " (kappa)");
  thresholds.sigma = finite(value["sigma"], where + " (sigma)");
  if (!(thresholds.sigma >= 0 && thresholds.sigma <= 1))
    throw_malformed(where, "sigma is the square of a sine: from 0 to 1");
  thresholds.delaunay = false;
  if (value.contains("delaunay")) {
    if (!value["delaunay"].is_boolean()) throw_malformed(where, "\"delaunay\" must be true or false");
    thresholds.delaunay = value["delaunay"].get<bool>();
  }
  return thresholds;
}

DepthMesh depth_mesh_of(const Json& samples, const Json& triangles, const std::string& where) {
  if (!samples.is_array()) throw_malformed(where, "\"samples\" must be a list");
  if (!triangles.is_array()) throw_malformed(where, "\"triangles\" must be a list");
  DepthMesh mesh;
  mesh.samples.reserve(samples.size());
  for (const auto& sample : samples) {
    mesh.samples.push_back(sample_of(sample, fmt::format("{}: sample {}", where, mesh.samples.size())));
  }
  mesh.triangles.reserve(triangles.size());
  for (const auto& triangle : triangles) {
    const auto place = fmt::format("{}: triangle {}", where, mesh.triangles.size());
    if (!triangle.is_array() || triangle.size() != 3)
      throw_malformed(place, json_excerpt(triangle) + " is no triangle [a, b, c]");
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (!triangle[i].is_number_unsigned())
        throw_malformed(place, json_excerpt(triangle[i]) + " is no number of a sample");
      const auto index = triangle[i].get<std::uint64_t>();
      if (index >= mesh.samples.size()) {
        throw Error(ErrorCode::index_out_of_range,
                    fmt::format("{}: there is no sample {}, only {} samples", place, index, mesh.samples.size()));
      }
      corners[i] = static_cast<std::uint32_t>(index);
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      throw_malformed(place, "it has a sample twice");
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

double bound_of(const Json& value, const std::string& where) {
  if (value.is_null()) return std::numeric_limits<double>::infinity();
  const double bound = finite(value, where);
  if (!(bound >= 0))
    throw_malformed(where, json_excerpt(value) + " is no distance; a bound is 0, more, or null for none");
  return bound;
}

std::string to_text(const MotionPoint& point) { return fmt::format("[{}, {}, {}]", point[0], point[1], point[2]); }

std::string to_text(const DepthSample& sample) {
  const auto kind = (sample.is_base ? 2U : 0U) + (sample.is_direction ? 1U : 0U);
  if (kind == 0) return to_text(sample.at);
  return fmt::format("[{}, {}, {}, \"{}\"]", sample.at[0], sample.at[1], sample.at[2], kinds[kind]);
}

std::string to_text(const MotionThresholds& thresholds) {
  return fmt::format(R"({{"delaunay": {}, "kappa": {}, "sigma": {}}})", thresholds.delaunay, thresholds.kappa,
                     thresholds.sigma);
}

std::string bound_to_text(double bound) { return std::isinf(bound) ? "null" : fmt::format("{}", bound); }

DepthMesh read_depth_mesh(const std::filesystem::path& path) {
  const auto root = read_json_file(path);
  require_format(root, "clues-depth-mesh/1", path.string());
  require_keys(root, {"format", "samples", "triangles"}, {}, path.string());
  return depth_mesh_of(root["samples"], root["triangles"], path.string());
}

std::string to_json_text(const DepthMesh& mesh) {
  std::string text = "{\n  \"format\": \"clues-depth-mesh/1\",\n  \"samples\": [";
  for (std::size_t i = 0; i < mesh.samples.size(); ++i) {
    text.append(i == 0 ? "\n    " : ",\n    ").append(to_text(mesh.samples[i]));
  }
  text += "\n  ],\n  \"triangles\": [";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    text.append(i == 0 ? "\n    " : ",\n    ").append(fmt::format("[{}, {}, {}]", t[0], t[1], t[2]));
  }
  return text + "\n  ]\n}\n";
}

MotionBounds read_motion_bounds(const std::filesystem::path& path) {
  const auto root = read_json_file(path);
  const auto where = path.string();
  require_format(root, "clues-motion-bounds/1", where);
  require_keys(root, {"format", "thresholds", "bounds"}, {"viewpoint"}, where);
  MotionBounds bounds;
  if (root.contains("viewpoint")) bounds.viewpoint = motion_point_of(root["viewpoint"], where + ": viewpoint");
  bounds.thresholds = thresholds_of(root["thresholds"], where + ": thresholds");
  if (!root["bounds"].is_array()) throw_malformed(where, "\"bounds\" must be a list");
  bounds.bounds.reserve(root["bounds"].size());
  for (const auto& bound : root["bounds"]) {
    bounds.bounds.push_back(bound_of(bound, fmt::format("{}: bound {}", where, bounds.bounds.size())));
  }
  return bounds;
}

std::string to_json_text(const MotionBounds& bounds) {
  std::string text = "{\n  \"bounds\": [";
  for (std::size_t i = 0; i < bounds.bounds.size(); ++i) {
    text.append(i == 0 ? "\n    " : ",\n    ").append(bound_to_text(bounds.bounds[i]));
  }
  text += "\n  ],\n  \"format\": \"clues-motion-bounds/1\",\n  \"thresholds\": " + to_text(bounds.thresholds);
  if (bounds.viewpoint) text += ",\n  \"viewpoint\": " + to_text(*bounds.viewpoint);
  return text + "\n}\n";
}

}  // namespace clues::scene
