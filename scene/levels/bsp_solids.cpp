#include "scene/levels/bsp_solids.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/levels/bsp_flags.h"
#include "scene/levels/bsp_hulls.h"

namespace clues::scene {
namespace {

RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}
mpq_class dot(const RationalPoint& a, const RationalPoint& b) {
  return mpq_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

struct Meeting {
  mpq_class share;           // of the way from v to p, where the segment enters the solid
  bool with_p_in_it = true;  // not on its boundary
};

// How far in front of the plane the point is, and by how much that may be wrong. Coordinates are cut off by less than a relative 2^-52 (or by 2^-1074); products, sums and the difference round
// five times more: below 2^-48 of the sum of the absolute values, and 2^-900 for what underflows: normals are floats.
struct Height {
  double value = 0, error = 0;
};

Height height_of(const Point& normal, double distance, const Point& at) {
  double sizes = std::fabs(distance), height = -distance;
  for (std::size_t i = 0; i < 3; ++i) {
    height += normal[i] * at[i];
    sizes += std::fabs(normal[i] * at[i]);
  }
  return {height, 0x1p-48 * sizes + 0x1p-900};
}

// Which part of the way from v to p may be in the closed solid, as a share; none where they certainly do not meet. An end whose side is in doubt may be on either.
template <class Sides>
std::optional<double> rough_share_in(const Sides& sides, const Point& v, const Point& p) {
  constexpr double kRounding = 0x1p-48;
  double in = 0, out = 1;
  for (const auto& side : sides) {
    const Height at_v = height_of(side.normal, side.distance, v), at_p = height_of(side.normal, side.distance, p);
    const bool v_is_out = at_v.value > at_v.error, p_is_out = at_p.value > at_p.error;
    if (v_is_out && p_is_out) return std::nullopt;
    if (v_is_out) {  // it enters no earlier than if v is nearer, and p deeper
      const double least = at_v.value - at_v.error, deep = std::max(0.0, at_p.error - at_p.value);
      in = std::max(in, least / (least + deep) - kRounding);
    } else if (p_is_out) {
      const double least = at_p.value - at_p.error, deep = std::max(0.0, at_v.error - at_v.value);
      out = std::min(out, 1 - least / (least + deep) + kRounding);
    }
  }
  if (in > out) return std::nullopt;
  return out - in;
}

// Of the segment with the closed solid; none where they do not meet.
template <class Sides>
std::optional<Meeting> meeting(const Sides& sides, const RationalPoint& v, const RationalPoint& p) {
  Meeting found;
  mpq_class leaves = 1;
  for (const auto& side : sides) {
    const mpq_class at_v = side.exact.height(v), at_p = side.exact.height(p);
    if (sgn(at_v) > 0 && sgn(at_p) > 0) return std::nullopt;
    if (sgn(at_p) >= 0) found.with_p_in_it = false;
    if (sgn(at_v) <= 0 && sgn(at_p) <= 0) continue;
    const mpq_class share = at_v / (at_v - at_p);
    if (sgn(at_v) > 0) {
      found.share = std::max(found.share, share);
    } else {
      leaves = std::min(leaves, share);
    }
  }
  if (found.share > leaves) return std::nullopt;
  return found;
}

// Whether q is in the prism over the triangle that reaches side_thickness to both sides.
bool is_over(const std::array<Point, 3>& drawn, const RationalPoint& q) {
  const std::array corners{to_rational(drawn[0]), to_rational(drawn[1]), to_rational(drawn[2])};
  const RationalPoint normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const mpq_class height = dot(normal, minus(q, corners[0])), thickness = side_thickness;
  if (height * height > thickness * thickness * dot(normal, normal)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalPoint edge = minus(corners[(i + 1) % 3], corners[i]);
    if (sgn(dot(normal, cross(edge, minus(q, corners[i])))) < 0) return false;
  }
  return true;
}

// Whether the triangle is a drawing of one of the sides, before which v is. Behind such a side solids are held (bsp_hulls.h), so that v sees the triangle past them.
template <class Sides>
bool is_drawing_before(const Sides& sides, const std::array<Point, 3>& drawn, const RationalPoint& v) {
  return std::any_of(sides.begin(), sides.end(), [&](const auto& side) {
    return sgn(side.exact.height(v)) > 0 && depth_of_drawing(side.exact, drawn);
  });
}

}  // namespace

HalfSpace half_space_of(const BspFile::Plane& plane) { return {to_rational(plane.normal), mpq_class(plane.distance)}; }

SolidBrushes::SolidBrushes(const BspFile& level) {
  const auto& world = level.models[0].brushes;
  for (std::uint32_t i = 0; i < world.count; ++i) {
    const auto& brush = level.brushes[world.first + i];
    if (!is_structural(level.shaders[brush.shader])) continue;
    auto& sides = brushes_.emplace_back();
    for (std::uint32_t k = 0; k < brush.sides.count; ++k) {
      const auto& plane = level.planes[level.sides[brush.sides.first + k].plane];
      sides.push_back({half_space_of(plane), plane.normal, plane.distance});
    }
  }
}

bool SolidBrushes::block(const RationalPoint& v, const RationalPoint& p, const std::array<Point, 3>& drawn) const {
  const Point near_v = to_doubles(v), near_p = to_doubles(p);
  std::vector<std::pair<double, const std::vector<Side>*>> candidates;
  for (const auto& sides : brushes_) {
    if (const auto share = rough_share_in(sides, near_v, near_p)) candidates.emplace_back(*share, &sides);
  }
  // What is likely to stop it comes first.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return std::any_of(candidates.begin(), candidates.end(), [&](const auto& candidate) {
    const auto met = meeting(*candidate.second, v, p);
    if (!met || met->share == 1) return false;
    if (!met->with_p_in_it || !is_drawing_before(*candidate.second, drawn, v)) return true;
    RationalPoint entry = v;
    for (std::size_t axis = 0; axis < 3; ++axis) entry[axis] += met->share * (p[axis] - v[axis]);
    return !is_over(drawn, entry);
  });
}

}  // namespace clues::scene
