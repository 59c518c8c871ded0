// Small random scenes with their view cell (D1, D2), made to hit the hard cases of D3-D17: contours that end, inside
// corners, touching and coplanar faces, piercing triangles, cells that touch the geometry.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::fuzz {

enum class Kind { loose_triangles, tetrahedra, open_sheets, axis_boxes, interpenetrating, nonconvex_solids };

inline constexpr std::array<Kind, 6> all_kinds{Kind::loose_triangles, Kind::tetrahedra,       Kind::open_sheets,
                                               Kind::axis_boxes,      Kind::interpenetrating, Kind::nonconvex_solids};

const char* name_of(Kind kind);

struct GeneratedScene {
  std::string name;  // "<kind>-<seed>-<index>"
  scene::TriangleMesh mesh;
  std::vector<scene::Point> cell;
  bool solid = false;  // meant for solid mode (D4)
};

// A pure function of its arguments: 4 to 60 non-degenerate triangles with coordinates in multiples of 1/16, |x| <= 32, and
// a cell (the hull of `cell`; now and then flat) that may touch the geometry. tetrahedra and nonconvex_solids are closed,
// outward-oriented and disjoint; axis_boxes are closed and may touch; where a receiver wall stands behind them it is open.
GeneratedScene generate(Kind kind, std::uint64_t seed, std::uint64_t index);

}  // namespace clues::fuzz
