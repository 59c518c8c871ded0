// D31 to D33 as data: the input, what every level took away and put in its place, the base domain, and the overlay. No algorithm: who
// makes it (reference/multires) and who checks it (validate/multires) share this and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// Weights are whole numbers that sum to 2^60; flattened stars lie on the grid of 2^-24.
inline constexpr int weight_bits = 60;
inline constexpr std::int64_t whole_weight = std::int64_t{1} << weight_bits;
inline constexpr int disk_bits = 24;
inline constexpr std::int64_t disk_unit = std::int64_t{1} << disk_bits;
inline constexpr std::uint32_t no_vertex = 0xffffffff;

// A point of a triangulated surface: the corners of the vertex, edge or triangle in whose inside it lies, ascending, with positive
// weights that sum to 2^60. Unused corners are no_vertex with weight 0. So a point has one such form.
struct CarrierPoint {
  std::array<std::uint32_t, 3> corner{no_vertex, no_vertex, no_vertex};
  std::array<std::int64_t, 3> weight{0, 0, 0};

  std::size_t size() const {
    return corner[2] != no_vertex ? 3U : (corner[1] != no_vertex ? 2U : (corner[0] != no_vertex ? 1U : 0U));
  }
  std::int64_t weight_of(std::uint32_t vertex) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (corner[k] == vertex) return weight[k];
    }
    return 0;
  }
  bool operator==(const CarrierPoint&) const = default;
};
inline CarrierPoint at_vertex(std::uint32_t vertex) { return {{vertex, no_vertex, no_vertex}, {whole_weight, 0, 0}}; }

using Edge = std::array<std::uint32_t, 2>;  // ascending
inline Edge edge_of(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

enum class StarKind : std::uint8_t { interior, boundary, feature };
// Why a vertex that no removed neighbour blocks stayed on a level, though it is a candidate.
enum class KeptFor : std::uint8_t {
  link,     // every triangulation of the hole has an edge or a face that is there already
  flat,     // a side of its star is a single triangle, which flattens to nothing (a boundary or feature vertex)
  numbers,  // the overlay cannot be carried on the grids of this format
};

struct Removal {
  std::uint32_t vertex = 0;
  StarKind kind = StarKind::interior;
  // Counter-clockwise. Boundary: from one end to the other. Feature: ring[0] and ring[across] are the ends of its two tagged edges.
  std::vector<std::uint32_t> ring;
  std::uint32_t across = 0;
  std::vector<std::array<std::int64_t, 2>>
      flat;                         // of each ring vertex, in units of 2^-24; the vertex itself is at (0, 0)
  std::vector<Triangle> triangles;  // what closes the hole
};

struct Kept {
  std::uint32_t vertex = 0;
  KeptFor reason = KeptFor::link;
};

struct HierarchyLevel {
  std::vector<Removal> removals;  // in the order in which they were decided
  std::vector<Kept> kept;
};

// A vertex of the overlay: the same point on the input surface and on the base domain.
struct OverlayVertex {
  CarrierPoint source, image;
};
struct OverlayTriangle {
  std::array<std::uint32_t, 3> corners{};  // oriented as the input
  std::uint32_t input = 0;                 // the input triangle that it lies in
};

struct Hierarchy {
  TriangleMesh input;
  std::vector<Edge> features;          // ascending
  std::vector<std::uint32_t> fixed;    // vertices that are never removed, ascending
  std::vector<HierarchyLevel> levels;  // from the input to the base domain
  std::vector<Triangle> base;          // triangles of the base domain, over vertices of the input
  std::vector<OverlayVertex> points;   // the vertices of the input first, in their order: their images are Pi
  std::vector<OverlayTriangle> pieces;
};

}  // namespace clues::scene
