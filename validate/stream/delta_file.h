// The file of a transition, "clues-delta/1" (docs/delta.md), and what is read of a map file "clues-result/1" to judge it.
// Exact coordinates are texts in the files and plain rationals here.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/delta/delta.h"
#include "scene/mesh/mesh.h"
#include "validate/windows/rational.h"

namespace clues::validate {

// One of the two ends of a transition.
struct DeltaEnd {
  std::vector<scene::Point> cell;
  std::vector<std::uint32_t> visible;  // ascending
};

struct DeltaFragment {
  std::array<RVector, 3> corners;  // counter-clockwise from the side
  std::uint32_t triangle = 0;
  bool front = true;
  reference::SeenFrom seen = reference::SeenFrom::neither;
};

// A row of the file's two lists of vertices.
struct DeltaVertex {
  RVector exact;
  scene::Point rounded{};
};

struct DeltaRecord {
  std::string scene_file, scene_sha256;
  std::uint64_t scene_triangles = 0;
  std::string mode = "sheet";
  DeltaEnd from, to;
  std::vector<std::uint32_t> plus, minus;  // ascending
  bool has_fragments = false;
  std::vector<DeltaFragment> fragments;
  std::vector<DeltaVertex> vertices;  // of fragments, as a file has them; who writes one has it made of the fragments
};

const char* name_of(reference::SeenFrom seen);

// scene_file and the cells are left to the caller. With fragments, the regions are sewn into triangles (sewn_mesh.h).
DeltaRecord record_of(const reference::Delta& delta, bool with_fragments);

// Keys sorted; the same record gives the same bytes.
std::string to_json_text(const DeltaRecord& record);

// Throws scene::Error: malformed with file and field, unsupported where it is no delta, index_out_of_range.
DeltaRecord read_delta(const std::filesystem::path& path, std::uint64_t triangles);

// A region of a map file. `rings` turn as the file has them.
struct MapFileRegion {
  std::uint32_t triangle = 0;
  bool front = true;
  std::vector<std::vector<RVector>> rings;
};

struct MapFile {
  std::string scene_sha256, mode;
  std::vector<scene::Point> cell;
  std::vector<std::uint32_t> visible;
  std::vector<MapFileRegion> regions;  // the visible ones
};

// Of `clues map --map -o FILE` by the exact kernel. Throws as read_delta; unsupported where it has no exact regions.
MapFile read_map_file(const std::filesystem::path& path, std::uint64_t triangles);

}  // namespace clues::validate
