// D22: a hull blocks what the brush blocks, or less. Its corners satisfy the half spaces of the brush, exactly, so every triangle between them
// lies in the brush, however they were rounded.
#include "scene/levels/bsp_hulls.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/levels/bsp_solids.h"
#include "scene/levels/rounding.h"

namespace clues::scene {
namespace {

// Coordinates of corners that are no doubles are multiples of this power of 1/2, where such a corner lies in the brush within
// three steps. That is below what compilers move drawn vertices by, and far above what planes in floats are off: a corner an ulp behind a drawing makes every sign between the two a hard one.
constexpr int corner_grid = 6;

// Rounded, with a wide margin and one for the rounding (below 2^-51 of the terms): who is within comes to the exact test.
bool may_be_near(const BspFile::Plane& plane, const Point& p) {
  double height = -plane.distance, terms = std::abs(plane.distance);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    height += plane.normal[axis] * p[axis];
    terms += std::abs(plane.normal[axis] * p[axis]);
  }
  return !(std::abs(height) > 2 * side_thickness + 0x1p-50 * terms);
}

std::vector<HalfSpace> sides_of(const BspFile& level, const BspFile::Brush& brush) {
  std::vector<HalfSpace> sides;
  for (std::uint32_t i = 0; i < brush.sides.count; ++i)
    sides.push_back(half_space_of(level.planes[level.sides[brush.sides.first + i].plane]));
  return sides;
}

// Whether a point of the triangle is in the interior. It is cut by one side after the other; what is left is convex, so
// its middle is in the interior where it does not lie in a side as a whole.
bool enters(const std::array<Point, 3>& triangle, const std::vector<HalfSpace>& sides) {
  std::vector<RationalPoint> left;
  for (const Point& p : triangle) left.push_back(to_rational(p));
  for (const auto& side : sides) {
    std::vector<RationalPoint> part;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const RationalPoint &a = left[i], &b = left[(i + 1) % left.size()];
      const mpq_class at_a = side.height(a), at_b = side.height(b);
      if (sgn(at_a) <= 0) part.push_back(a);
      if (sgn(at_a) * sgn(at_b) >= 0) continue;
      const mpq_class share = at_a / (at_a - at_b);
      RationalPoint& crossing = part.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) crossing[axis] = a[axis] + share * (b[axis] - a[axis]);
    }
    left = std::move(part);
  }
  return !left.empty() && std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
    return std::any_of(left.begin(), left.end(), [&](const RationalPoint& p) { return sgn(side.height(p)) < 0; });
  });
}

// How far each side has to be moved inwards so that no drawing of it is behind it, in units of its normal. What does not
// enter the brush is none, however close to the plane of the side it lies: the hull cannot hide it.
std::vector<mpq_class> depths_of_drawings(const BspFile& level, const BspFile::Brush& brush,
                                          const std::vector<HalfSpace>& sides,
                                          const std::vector<const std::array<Point, 3>*>& drawn) {
  std::vector<mpq_class> depths(sides.size());
  for (const auto* triangle : drawn) {
    std::optional<bool> is_in;
    for (std::uint32_t i = 0; i < brush.sides.count; ++i) {
      const auto& plane = level.planes[level.sides[brush.sides.first + i].plane];
      if (!std::all_of(triangle->begin(), triangle->end(), [&](const Point& p) { return may_be_near(plane, p); }))
        continue;
      const auto depth = depth_of_drawing(sides[i], *triangle);
      if (!depth || *depth <= depths[i]) continue;
      if (!is_in) is_in = enters(*triangle, sides);
      if (*is_in) depths[i] = *depth;
    }
  }
  return depths;
}

std::optional<Polytope> within(const std::vector<HalfSpace>& sides, const Polytope& bounds) {
  std::optional<Polytope> solid = bounds;
  for (const auto& side : sides) {
    if (solid) solid = intersection(*solid, side);
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

std::optional<mpq_class> depth_of_drawing(const HalfSpace& side, const std::array<Point, 3>& drawn) {
  mpq_class lowest;
  for (const Point& p : drawn) {
    const mpq_class height = side.height(to_rational(p));
    if (abs(height) > mpq_class(side_thickness)) return std::nullopt;
    lowest = std::min(lowest, height);
  }
  return -lowest;
}

std::optional<Polytope> solid_of_brush(const BspFile& level, const BspFile::Brush& brush, const Polytope& bounds,
                                       const std::vector<std::array<Point, 3>>& drawn) {
  auto sides = sides_of(level, brush);
  auto solid = within(sides, bounds);
  if (!solid) return std::nullopt;
  const auto box = rough_box(*solid);
  std::vector<const std::array<Point, 3>*> near;
  for (const auto& triangle : drawn) {
    if (meets_box(triangle, box)) near.push_back(&triangle);
  }
  const auto depths = depths_of_drawings(level, brush, sides, near);
  if (std::any_of(depths.begin(), depths.end(), [](const mpq_class& depth) { return sgn(depth) > 0; })) {
    for (std::size_t i = 0; i < sides.size(); ++i) sides[i].offset -= depths[i];
    solid = within(sides, bounds);
  }
  return solid;
}

Hull hull_of_solid(const Polytope& solid) {
  const auto corners = inner_vertices(solid, corner_grid);
  if (!corners) return {};
  Hull hull;
  for (const auto& face : solid.faces) {
    auto& polygon = hull.emplace_back();
    for (const auto vertex : face.vertices) polygon.push_back((*corners)[vertex]);
  }
  return hull;
}

}  // namespace clues::scene
