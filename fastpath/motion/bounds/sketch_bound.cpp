// The sketch: d_i, d_e, and the edge bound of vertex and foot with the angle eps.
#include "fastpath/motion/bounds/sketch_bound.h"

#include <algorithm>
#include <cmath>

namespace clues::fastpath::motion {
namespace {

double chord_bound(const Row& p, const Row& a, const Row& b, const BoundThresholds& chord, double otherwise) {
  if (!p.moves || !a.moves || !b.moves) return otherwise;
  const Vec along = b.x - a.x;
  const double t = dot(p.x - a.x, along) / dot(along, along);
  if (!(t > 0 && t < 1)) return otherwise;
  Row foot;
  foot.x = a.x + t * along;
  foot.length = norm(foot.x);
  return edge_bound(p, foot, chord);
}

}  // namespace

double sketch_bound_unsound(const Row& a, const Row& b, const Row& c, const BoundThresholds& t) {
  double m = facing_bound(a, b, c);
  m = std::min({m, edge_bound(a, b, t), edge_bound(b, c, t), edge_bound(c, a, t)});
  if (t.sine == 0) return m;
  scene::MotionThresholds eps;
  eps.kappa = std::sqrt(std::max(0.0, 1 - t.sine * t.sine)) / t.sine;
  const BoundThresholds chord(eps);
  return std::min({m, chord_bound(a, b, c, chord, m), chord_bound(b, c, a, chord, m), chord_bound(c, a, b, chord, m)});
}

}  // namespace clues::fastpath::motion
