// The cases of vectors/multires: surfaces, hierarchy files and plain maps of which it is known, with proof, what is true of them. A closed format,
// "clues-multires-vectors/1"; vectors/multires/schema.json says the same as this reader.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/multires/hierarchy_file.h"

namespace clues::validate {

enum class MultiresKind : std::uint8_t {
  surface,  // a mesh: refused with the place, or what it is and which of its vertices a first level may remove (D31)
  file,     // a hierarchy file: which checks (E1 to E6) find something
  plain     // a map of another program: proved, refuted or undecided
};

// Why a mesh is no surface: an edge of three triangles or against the orientation, a vertex without triangle or with several fans, a triangle that
// is none or there twice. One of the three is given.
struct RefusedPlace {
  std::optional<scene::Edge> edge;
  std::optional<std::uint32_t> vertex, triangle;
};

struct SurfaceFacts {
  std::uint64_t components = 0, genus = 0, boundaries = 0;
  std::vector<std::string> vertices;  // of each: removable, fixed, high (12 neighbours or more), link, flat
};

struct MultiresVector {
  std::string file, id, comment;
  MultiresKind kind = MultiresKind::surface;
  scene::TriangleMesh mesh, base;                    // surface: mesh; plain: both
  std::vector<scene::Edge> features;                 // surface
  std::vector<std::uint32_t> fixed;                  // surface
  std::string text;                                  // file: its lines
  std::vector<scene::PlainMapLine> map;              // plain
  std::optional<RefusedPlace> refused;               // expected, of a surface
  std::optional<SurfaceFacts> facts;                 // expected, of a surface
  std::optional<std::vector<std::string>> findings;  // expected, of a file or plain map: "E3", ascending
  std::string verdict;                               // expected, of a plain map
  nlohmann::json source;                             // the case as it was read

  bool has_expectation() const { return refused || facts || findings; }
};

struct MultiresTopic {
  std::string file, topic;
  std::vector<MultiresVector> cases;
};

// Whether `clues lint` of this folder is about maps of surfaces: its schema says so.
bool is_multires_suite(const std::filesystem::path& folder);
// A case without "expect" is accepted when `drafts`. Throws Error malformed with file and case.
MultiresTopic parse_multires_topic(std::string_view text, const std::string& file, bool drafts = false);
MultiresTopic read_multires_topic(const std::filesystem::path& path, bool drafts = false);
std::string to_json_text(const MultiresTopic& topic);  // the one canonical text

}  // namespace clues::validate
