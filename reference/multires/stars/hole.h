// The hole that a vertex leaves, closed by triangles (D31): Delaunay in the flattened polygon, where edges that the surface already has do not
// forbid it; else the locally best triangulation without these; none where there is none.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "exact/multires/grid.h"

namespace clues::reference {

// A polygon, counter-clockwise, with the numbers of its vertices.
struct HolePolygon {
  std::vector<exact::DiskPoint> points;
  std::vector<std::uint32_t> vertices;
};

// `forbidden(a, b)`: the surface has this edge, so that the hole must not get it as a diagonal. Edges of the polygon are not asked.
// Of cocircular corners the diagonal at the lowest number is taken. Triangles are oriented and ascending, each from its lowest corner. O(K^3).
std::optional<std::vector<scene::Triangle>> triangulated(
    const HolePolygon& polygon, const std::function<bool(std::uint32_t, std::uint32_t)>& forbidden);

}  // namespace clues::reference
