// D16: the scene as an embedded, conforming complex. Wherever input triangles pierce, touch or overlap each other
// they are cut exactly, so that two pieces meet in a common vertex, a common edge, or not at all; coincident pieces
// are one piece with several origins. Every contact in the scene is then a matter of shared indices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh/mesh.h"

namespace clues::exact {

class CutMemory;

struct Origin {
  std::uint32_t triangle = 0;  // input id (D1)
  bool same_side = true;       // the piece's front side is the input triangle's front side
};

struct Piece {
  std::array<std::uint32_t, 3> corners{};  // indices into Complex::points
  std::vector<Origin> origins;             // at least one, ascending by triangle
};

struct Edge {
  std::uint32_t a = 0, b = 0;         // a < b
  std::vector<std::uint32_t> pieces;  // incident pieces, ascending
};

struct Complex {
  std::vector<Point3> points;
  std::vector<Piece> pieces;
  std::vector<Plane3> planes;                             // per piece; positive side = front
  std::vector<bool> in_cell;                              // per piece: in int V, so no occluder (D3)
  std::vector<Edge> edges;                                // ascending by (a, b)
  std::vector<std::array<std::uint32_t, 3>> piece_edges;  // per piece: edges (c0c1, c1c2, c2c0)
  std::vector<std::vector<std::uint32_t>> point_pieces;   // per point: incident pieces
  std::vector<std::vector<std::uint32_t>> point_edges;    // per point: incident edges
  std::vector<std::uint32_t> degenerate;                  // input ids without area: no surface
  double unit = 1;                                        // unit_of(points): what flat constructions are measured in
  std::uint64_t input_triangles = 0;
  std::uint64_t refined_triangles = 0;  // input triangles that had to be cut
};

// With a cell of dimension 3 the triangles are also cut along its border, so that what ends there (D3) ends in edges and points of the complex;
// pieces in int V are in nothing but `pieces`, `planes` and `in_cell`: edges and points know occluders only.
// O(n log n + k) box tests for k box contacts, then the exact cuts: quadratic where every triangle meets every other.
Complex build_complex(const scene::TriangleMesh& mesh, const ConvexCell* cell = nullptr);

// The same of a part of a scene, with what `memory` knows from other parts of it (cut_memory.h), and adds to that. `names` are the
// ids, ascending and below 2^31, of the part's triangles in the whole scene. Where the cell is another, it has to forget the one before.
Complex build_complex(const scene::TriangleMesh& part, const ConvexCell* cell, std::span<const std::uint32_t> names,
                      CutMemory& memory);

// The same for exact points.
Complex build_complex(const std::vector<Point3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                      const ConvexCell* cell = nullptr);

// D4: closed and consistently oriented: every edge has exactly two sides leaving it for each entering it. Returns the ids of
// input triangles at offending edges (empty: solid mode is allowed). Whether a cell cut the complex does not matter to whether there are any: a cut
// closed mesh is closed.
std::vector<std::uint32_t> triangles_not_solid(const Complex& complex);

// Throws scene::Error not_solid, which names some of these triangles, if there are any.
void require_solid(const Complex& complex);

}  // namespace clues::exact
