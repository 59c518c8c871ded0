// D26: a file of contours, "clues-contours 1" (docs/delta.md): the maps of cells, each within the map of another cell of
// the file, or within whole triangles. Of a map there are the labels of planes, the points where it ends, and seeds.
// There is no geometry in this file: what a label means is made of it, the scene and the cell, exactly by
// reference/contours/, in doubles by fastpath/contours/.
//
// The drawing of a side of a triangle are its three edges and all segments that the cell and those around it have there.
// Points of a drawing have numbers: the corners 0, 1, 2; then those of the outermost cell, and so on inwards. So two ends
// that are one point are known to be one, without arithmetic; and a drawing hangs together: where it does not, a bridge,
// along which nothing ends, says so. Who has doubles only can walk around in it, and needs them for the order of
// directions at a point and of points on an edge, and for nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// FIGS. 31, 32: the plane of a wedge, from the scene, the cell and a few numbers.
struct ContourPlane {
  enum class Kind : std::uint8_t {
    edge,      // through points[0] and points[1] of the scene, and cell[0]
    vertex,    // through points[0], and cell[0], cell[1]
    crossing,  // through the point where that edge crosses the plane `crossed`, and cell[0], cell[1]
    triangle,  // through points
  };
  Kind kind = Kind::edge;
  std::array<std::uint32_t, 3> points{};
  std::array<std::uint32_t, 2> cell{};  // vertices of the cell
  std::uint32_t crossed = 0;            // an earlier plane of the cell

  friend bool operator==(const ContourPlane&, const ContourPlane&) = default;
};

struct ContourPoint {
  enum class Kind : std::uint8_t {
    on_edge,     // where plane `second` crosses edge `first` of the triangle, from corner `first` to the next
    crossing,    // where planes `first` and `second` cross in the triangle
    on_segment,  // where plane `second` crosses segment `first` of the drawing
    again,       // on edge `first` of the triangle: point `second` of those that this edge of the scene has
    in_full,     // `at`, three fractions; `first`: 0 in the open, 1 to 3 on an edge, 4 + n on segment n of the drawing
  };
  Kind kind = Kind::on_edge;
  std::uint32_t first = 0, second = 0;
  std::array<std::string, 3> at;

  friend bool operator==(const ContourPoint&, const ContourPoint&) = default;
};

// What a point is on: 0: nothing, 1 to 3: an edge of its triangle, 4 + n: segment n of the drawing.
std::uint32_t lies_on(const ContourPoint& point);
// The edge of the triangle to whose edge of the scene the point is added: one that lies there and was not known.
std::optional<std::uint32_t> edge_that_gets(const ContourPoint& point);

using PointPair = std::array<std::uint32_t, 2>;  // numbers of points in the drawing

// What a cell adds to the drawing of a side.
struct ContourSide {
  struct Block {  // a stretch of an edge of the triangle that no flood passes
    std::uint32_t edge = 0;
    PointPair ends{};

    friend bool operator==(const Block&, const Block&) = default;
  };
  std::uint32_t side = 0;  // 2 t is the front of triangle t, 2 t + 1 its back
  std::vector<ContourPoint> points;
  std::vector<PointPair> segments;
  std::vector<Block> blocks;
  std::vector<PointPair> bridges;  // of the whole drawing, as it is with these segments

  friend bool operator==(const ContourSide&, const ContourSide&) = default;
};

// A point A + u (B - A) + v (C - A) of a triangle ABC, inside of a component.
struct ContourSeed {
  std::uint32_t side = 0;
  std::uint32_t from = 0;                // a point of the drawing from which nothing parts it
  std::uint32_t bits = 0;                // 1 to 52: u and v are numbers / 2^bits; 0: fractions
  std::array<std::uint64_t, 2> at{};     // numbers
  std::array<std::string, 2> fractions;  // with bits 0

  friend bool operator==(const ContourSeed&, const ContourSeed&) = default;
};

struct ContourCell {
  std::string name;
  std::uint32_t within = 0;  // 0: whole triangles; else 1 + the number of an earlier cell
  bool exact = true;         // decoding gives the map; false: more than that, where it was coded so
  std::uint64_t fallbacks = 0;
  std::vector<Point> points;           // vertices of the cell, by which planes name them
  std::vector<std::uint32_t> besides;  // triangles that are visible though no side of them is (D3), ascending
  std::vector<ContourPlane> planes;
  std::vector<ContourSide> sides;  // ascending
  std::vector<ContourSeed> seeds;  // by side

  friend bool operator==(const ContourCell&, const ContourCell&) = default;
};

struct ContourFile {
  std::string scene_sha256;  // 64 hex digits
  std::uint64_t scene_points = 0, scene_triangles = 0;
  std::string mode = "sheet";  // or "solid"
  double reach = 0;            // 0: every cell is decoded exactly
  std::vector<ContourCell> cells;

  friend bool operator==(const ContourFile&, const ContourFile&) = default;
};

// Of each side that one of the cell and those around it draws on: how many points and segments its drawing has.
struct DrawingSize {
  std::uint64_t points = 3, segments = 0;
};
using DrawingSizes = std::map<std::uint32_t, DrawingSize>;
DrawingSizes drawing_sizes(const std::vector<ContourCell>& cells, std::uint32_t cell);

// From the outermost cell to this one.
std::vector<std::uint32_t> chain_of(const std::vector<ContourCell>& cells, std::uint32_t cell);

// What a cell takes without its name and corners: planes, sides, seeds.
std::string contour_bytes(const std::vector<ContourCell>& cells, std::uint32_t cell);

// The same bytes for the same file; a SHA-256 of them at the end.
std::string to_bytes(const ContourFile& file);

// All numbers are looked at, but for those of points of an edge of the scene, which only the scene can say. A file has
// one form: what would be written otherwise is refused. Throws Error malformed, non_finite; unsupported for another version.
ContourFile parse_contours(std::string_view bytes, const std::string& where);
// Without the hash in the end, for those who have none.
ContourFile parse_unsealed_contours(std::string_view bytes, const std::string& where);
ContourFile read_contours(const std::filesystem::path& path);

}  // namespace clues::scene
