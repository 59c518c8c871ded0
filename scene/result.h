// The result file *.clues.json ("clues-result/1", docs/formats.md) and the plain PVS list.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// A polygon of the map: corners in order, exact coordinates as "p/q" strings ("p" when q is 1) and the nearest doubles.
struct MapRegion {
  std::uint32_t triangle = 0;
  bool front = true;
  bool visible = true;
  // Exact part of the triangle's area, "p/q". Empty when only the estimate is known; then there are no exact rings either.
  std::string area_fraction;
  double area_estimate = 0;
  std::vector<std::vector<std::array<std::string, 3>>> rings_exact;  // outer ring first, then holes
  std::vector<std::vector<Point>> rings;
  std::vector<std::string> render_states;  // "NO_BACKFACE_CULL", "NO_Z_COMPARE", "NO_Z_WRITE", as far as they hold
};

// The regions as a mesh: shared vertices, and edges that know the faces on both sides.
struct MapMesh {
  std::vector<std::array<std::string, 3>> vertices_exact;
  struct Face {
    std::vector<std::uint64_t> regions;  // indices into Result::regions; several where input triangles coincide
    std::vector<std::vector<std::uint64_t>> rings;
  };
  std::vector<Face> faces;
  struct Edge {
    std::string kind;  // "border" (of the triangle, or of a part of it), "dm", "ob" (D15)
    std::array<std::uint64_t, 2> ends{};
    std::vector<std::uint64_t> faces;  // left of the edge, then right; a border has one
  };
  std::vector<Edge> edges;
};

struct MapSegment {  // a DM segment; boundary: also an OB segment (D15)
  std::uint32_t triangle = 0;
  bool front = true;
  bool boundary = false;
  std::array<std::array<std::string, 3>, 2> exact;
  std::array<Point, 2> points;
};

struct MapWedge {
  std::string kind;  // "SV-ME", "SE-ME", "SE-MV"
  int generation = 0;
  std::array<std::array<std::string, 3>, 4> exact;  // near segment (2 points), far segment (2 points)
  std::array<Point, 4> points;
  bool unbounded = false;
};

struct Result {
  std::string scene_file, scene_sha256;
  std::uint64_t scene_triangles = 0;
  std::vector<Point> cell;
  std::string method = "first-order";         // or "backprojected"
  std::string kernel = "exact";               // or "fast"
  std::string mode = "sheet";                 // or "solid"
  std::vector<std::uint32_t> visible;         // sorted, unique
  std::map<std::string, std::int64_t> stats;  // always holds "conservative_fallbacks"
  bool has_map = false;
  bool has_render_states = false;
  std::vector<MapRegion> regions;
  MapMesh mesh;
  std::vector<MapSegment> segments;
  std::vector<MapWedge> wedges;
};

// Keys sorted, two-space indent, trailing newline; the same Result gives the same bytes.
std::string to_json_text(const Result& result);

// What is asked about. A result says what it answers; where it says something else it is refused. What is empty here, or
// not said there, is not compared.
struct Asked {
  std::uint64_t triangles = 0;
  std::string scene_sha256, mode;
  std::vector<Point> cell;  // in any order
};

// A PVS from a result file (*.json) or a plain list (ids with blanks or ends of lines between them, '#' comments).
// Sorted and unique. Throws Error: file errors, malformed (file and line; a result of another scene, cell or mode),
// index_out_of_range when an id is
// >= triangles.
std::vector<std::uint32_t> read_pvs(const std::filesystem::path& path, const Asked& asked);
std::vector<std::uint32_t> read_pvs(const std::filesystem::path& path, std::uint64_t triangles);
// The same from bytes; `file` is for messages only.
std::vector<std::uint32_t> parse_pvs_list(std::string_view bytes, const std::string& file, std::uint64_t triangles);
std::vector<std::uint32_t> parse_result_pvs(std::string_view bytes, const std::string& file, const Asked& asked);
std::string to_pvs_text(const std::vector<std::uint32_t>& visible);

// Lower-case hex SHA-256 of a file's bytes, and of bytes.
std::string sha256_of_file(const std::filesystem::path& path);
std::string sha256_of(std::string_view bytes);

}  // namespace clues::scene
