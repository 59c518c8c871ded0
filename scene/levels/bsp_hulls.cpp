// D22: a hull blocks what the brush blocks, or less. Its corners satisfy the half spaces of the brush, exactly, so every triangle between them
// lies in the brush, however they were rounded.
#include "scene/levels/bsp_hulls.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/levels/rounding.h"

namespace clues::scene {
namespace {

HalfSpace half_space_of(const BspFile::Plane& plane) { return {to_rational(plane.normal), mpq_class(plane.distance)}; }

// Rounded, with a wide margin and one for the rounding (below 2^-51 of the terms): who is within comes to the exact test.
bool may_be_near(const BspFile::Plane& plane, const Point& p) {
  double height = -plane.distance, terms = std::abs(plane.distance);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    height += plane.normal[axis] * p[axis];
    terms += std::abs(plane.normal[axis] * p[axis]);
  }
  return !(std::abs(height) > 2 * side_thickness + 0x1p-50 * terms);
}

// How far the side has to be moved inwards so that no drawing of it is behind it; in units of its normal.
mpq_class depth_of_drawings(const BspFile::Plane& plane, const std::vector<const std::array<Point, 3>*>& drawn) {
  const HalfSpace side = half_space_of(plane);
  mpq_class depth;
  for (const auto* triangle : drawn) {
    if (!std::all_of(triangle->begin(), triangle->end(), [&](const Point& p) { return may_be_near(plane, p); }))
      continue;
    mpq_class lowest;
    bool near = true;
    for (const Point& p : *triangle) {
      const mpq_class height = side.height(to_rational(p));
      near = near && abs(height) <= mpq_class(side_thickness);
      lowest = std::min(lowest, height);
    }
    if (near && -lowest > depth) depth = -lowest;
  }
  return depth;
}

std::optional<Polytope> solid_of(const BspFile& level, const BspFile::Brush& brush, const Polytope& bounds,
                                 const std::vector<mpq_class>& depths) {
  std::optional<Polytope> solid = bounds;
  for (std::uint32_t i = 0; i < brush.sides.count && solid; ++i) {
    HalfSpace side = half_space_of(level.planes[level.sides[brush.sides.first + i].plane]);
    if (!depths.empty()) side.offset -= depths[i];
    solid = intersection(*solid, side);
  }
  return solid;
}

// The smallest box of doubles around the polytope, grown.
std::array<Point, 2> rough_box(const Polytope& polytope) {
  std::array<Point, 2> box{{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}}};
  for (const auto& v : polytope.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[0][axis] = std::min(box[0][axis], v[axis].get_d() - 2 * side_thickness);
      box[1][axis] = std::max(box[1][axis], v[axis].get_d() + 2 * side_thickness);
    }
  }
  return box;
}

bool meets_box(const std::array<Point, 3>& t, const std::array<Point, 2>& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::min({t[0][axis], t[1][axis], t[2][axis]}) > box[1][axis]) return false;
    if (std::max({t[0][axis], t[1][axis], t[2][axis]}) < box[0][axis]) return false;
  }
  return true;
}

}  // namespace

Hull hull_of_brush(const BspFile& level, const BspFile::Brush& brush, const Polytope& bounds,
                   const std::vector<std::array<Point, 3>>& drawn) {
  auto solid = solid_of(level, brush, bounds, {});
  if (!solid) return {};
  const auto box = rough_box(*solid);
  std::vector<const std::array<Point, 3>*> near;
  for (const auto& triangle : drawn) {
    if (meets_box(triangle, box)) near.push_back(&triangle);
  }
  std::vector<mpq_class> depths;
  for (std::uint32_t i = 0; i < brush.sides.count; ++i) {
    depths.push_back(depth_of_drawings(level.planes[level.sides[brush.sides.first + i].plane], near));
  }
  const bool shrinks = std::any_of(depths.begin(), depths.end(), [](const mpq_class& depth) { return sgn(depth) > 0; });
  if (shrinks) solid = solid_of(level, brush, bounds, depths);
  if (!solid) return {};
  const auto corners = inner_vertices(*solid);
  if (!corners) return {};
  Hull hull;
  for (const auto& face : solid->faces) {
    auto& polygon = hull.emplace_back();
    for (const auto vertex : face.vertices) polygon.push_back((*corners)[vertex]);
  }
  return hull;
}

}  // namespace clues::scene
