#include "fastpath/visibility/wedges/beside.h"

#include <algorithm>
#include <cmath>

#include "fastpath/predicates/estimated_vectors.h"
#include "fastpath/visibility/points/near_enough.h"
#include "fastpath/visibility/wedges/on_wedge.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

namespace {

double length(const Point& v) { return length_estimate(v); }

// How far off the plane, as a part of the step `to` across the edge: so little that sight lines come through the plane by a quarter of the step beside
// the place, most of them, if V is thin above it, and that the place is no more than half of the way to the other supporting plane.
double lift_for(const LocalScene& scene, const ContourEdge& c, const Point& y, const Point& to, const Point& up) {
  constexpr double kMost = 0x1p-5, kLeast = 0x1p-300;
  double height = 0, away = 0;
  for (const ExactPoint& x : scene.cell.vertices) {
    const Point way = minus(x.estimate(), y);
    away = std::max(away, length(way));
    height = std::max(height, -dot_of(way, up) / length(up));
  }
  double lift = 4 * kMost * (height / away);
  if (c.other) {
    const Point normal = c.other->normal_estimate();
    const double up_to_other = -(dot_of(normal, to) / length(to)) / (dot_of(normal, up) / length(up));
    if (up_to_other > 0) lift = std::min(lift, up_to_other / 2);
  }
  return c.holds_cell || !(lift < kMost) ? kMost : std::max(lift, kLeast);
}

}  // namespace

std::optional<ExactPoint> beside_edge(const LocalScene& scene, const PieceSet& set, const ContourEdge& c,
                                      const EdgePart& part, int& level) {
  const LocalEdge& edge = scene.edges[c.edge];
  const ExactPoint &touching = scene.cell.vertices[static_cast<std::size_t>(c.touching.front())],
                   &a = scene.points[edge.a], &b = scene.points[edge.b];
  const Point y = part.y->estimate(), along = minus(b.estimate(), a.estimate());
  Point to = minus(touching.estimate(), y);  // across the edge
  const double shift = -dot_of(to, along) / dot_of(along, along);
  for (std::size_t k = 0; k < 3; ++k) to[k] += shift * along[k];
  const Point up = c.plane->normal_estimate();
  const double size = std::min(length(to), length(minus(part.hi->estimate(), part.lo->estimate())));
  const double lift = lift_for(scene, c, y, to, up);
  constexpr int kDoubles = 4;
  if (!(length(to) > 0 && length(up) > 0)) level = std::max(level, kDoubles);
  const auto place = [&](int at) {
    if (at >= kDoubles) {  // features smaller than the spacing of doubles
      const double step = std::ldexp(1.0, -5 - 24 * (at - kDoubles + 1));
      const Exact3 across = touching.exact() + Rational(std::isfinite(shift) ? shift : 0) * (b.exact() - a.exact());
      return ExactPoint::lifted(*part.y, ExactPoint(across), step, *c.plane, lift);
    }
    const double step = std::ldexp(size, -5 - 7 * at);
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = y[k] + step * (to[k] / length(to)) + step * lift * (up[k] / length(up));
    return ExactPoint(p);
  };
  return near_enough(level, 2 * kDoubles, place, [&](const ExactPoint& beside) {
    // Between H- and the event surface of the other supporting plane there is one label.
    if (c.plane->side(beside) <= 0 || (c.other && c.other->side(beside) >= 0)) return false;
    if (scene.is_on_surface(beside)) return false;
    const bool blocked = scene.tree.any(SegmentTest(beside, *part.y), [&](std::uint32_t i) {
      const std::uint32_t t = scene.occluders[i];
      if (std::find(edge.pieces.begin(), edge.pieces.end(), t) != edge.pieces.end()) return false;
      return scene.crosses(*part.y, beside, t) != Crossing::no;
    });
    return !blocked && !set.may_meet(beside, *part.y, 0, holds_edge(scene, c.edge));
  });
}

bool comes_next_to_edge(const LocalScene& scene, const ContourEdge& c, const EdgePart& part, const ExactPoint& v,
                        const ExactPoint& beside) {
  const LocalEdge& edge = scene.edges[c.edge];
  const ExactPoint &a = scene.points[edge.a], &b = scene.points[edge.b];
  const ExactPoint through = ExactPoint::on_plane(v, beside, *c.plane);
  const OnWedge frame{c.plane, &a, {}, {}, {}, {}, {}, {}};
  if (frame.turn(&b, &through) != frame.turn(&b, &scene.cell.vertices[static_cast<std::size_t>(c.touching.front())]))
    return false;
  if (scene.may_meet(through, beside)) return false;
  return !scene.tree.any(SegmentTest(through, *part.y), [&](std::uint32_t i) {
    const std::uint32_t t = scene.occluders[i];
    return std::find(edge.pieces.begin(), edge.pieces.end(), t) == edge.pieces.end() &&
           scene.crosses(*part.y, through, t) != Crossing::no;
  });
}

}  // namespace clues::fastpath
