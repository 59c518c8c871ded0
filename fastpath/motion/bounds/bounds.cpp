// d_i, d_e and d_v; delaunay_bound.cpp has d_D.
#include "fastpath/motion/bounds/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fastpath/motion/bounds/predicates.h"

namespace clues::fastpath::motion {
namespace {

// How fast a x b changes with the viewpoint, at most: a and b lose w each, so a x b changes by (a - b) x w, and by b x w or a x w where only
// one of them moves. The difference of two rows has an error of 2u (la + lb), its norm one of 4u.
double speed_of_cross(const Row& a, const Row& b) {
  if (a.moves && b.moves) return norm(a.x - b.x) + 0x1p-50 * (a.length + b.length);
  if (a.moves) return b.length * kUp;
  return b.moves ? a.length * kUp : 0;
}

struct Pair {
  double cross_up, speed;
};

// What the three constraints of a triangle have in common: det >= low - speed s for all viewpoints within s.
struct Det {
  double low, speed;
};

// The gradient is the sum of the products of two rows, each where the third row moves. Its error is at most 16u times the sum of the products of
// their lengths that are in it: below 7.2u each (predicates.h), three sums.
Det det_of(const Row& a, const Row& b, const Row& c) {
  const Vec bc = cross(b.x, c.x), ca = cross(c.x, a.x), ab = cross(a.x, b.x);
  Vec gradient;
  double sizes = 0;
  const auto add = [&](const Row& moves, const Vec& product, const Row& p, const Row& q) {
    if (!moves.moves) return;
    gradient = gradient + product;
    sizes += p.length * q.length;
  };
  add(a, bc, b, c);
  add(b, ca, c, a);
  add(c, ab, a, b);
  return {dot(a.x, bc) - kDeterminantError * (a.length * b.length * c.length), norm(gradient) + 0x1p-49 * sizes};
}

// A1.3 as a determinant: the sine of the angle from p to the great circle of ab is det / (|a x b| |p|), so that the pair holds while
// det.low - det.speed s >= sine (cross + cross' s) (|p| + p' s). The least positive root of the difference.
double separation_root(const Det& det, const Pair& ab, const Row& p, double sine) {
  const double p_up = p.length * kUp, p_speed = p.moves ? 1 : 0;
  const double c = det.low - sine * (ab.cross_up * p_up) * kUp;
  if (!(c > 0)) return 0;
  const double a = sine * (ab.speed * p_speed);
  const double b = det.speed + sine * (ab.cross_up * p_speed + p_up * ab.speed);
  if (b == 0) return kInfinity;  // three directions
  return 2 * c / (b + std::sqrt(b * b + 4 * a * c)) * kDown;
}

// A1.2. value = kappa |a x b| - a.b is R^2 - r^2 of the spindle torus: the nearest point of its surface is at R - r = value / (R + sqrt(R^2 - value)), which
// grows with value and falls with R. Where the viewpoint certainly is in the double cone from the circle's centre over the edge (branch I1: |a x b| <=
// kappa (L^2 / 2 - X), X = |b^2 - a^2| / 2), the nearest point is an end, further away than R - r.
// Where one end is a direction, kappa |y x D| - y.D = |D| (kappa y_perp - y_par) is |D| / sin(phi) times the distance from the cone's side.
// The result is that distance, or `most` if that is less: it may be seen from value / 2R, which is never more than R - r.
double edge_root(const Row& a, const Row& b, double cross_norm, const Pair& ab, const BoundThresholds& t, double most) {
  const double size = a.length * b.length;
  const double value =
      (t.kappa * cross_norm - dot(a.x, b.x)) - (kEdgeErrorOfKappa * std::fabs(t.kappa) + kEdgeError) * size;
  if (!(value > 0)) return 0;
  if (!a.moves && !b.moves) return most;
  if (!a.moves || !b.moves) return std::min(most, value / ((a.moves ? b.length : a.length) * t.secant) * kDown);
  const double radius = 0.5 * (ab.speed * t.secant) * kUp;
  if (value * kDown > 2 * radius * most * kUp) return most;
  // Both products are within 2^-49 of the square of the sum of the lengths.
  const Vec along = b.x - a.x;
  const double sum = a.length + b.length;
  const double half = 0.5 * (dot(along, along) - std::fabs(dot(a.x + b.x, along))) - 0x1p-48 * (sum * sum);
  if (t.kappa > 0 && half > 0 && ab.cross_up <= t.kappa * half * kDown)
    return std::min({most, a.length * kDown, b.length * kDown});
  return std::min(most, value / (radius + std::sqrt(std::max(0.0, radius * radius * kUp - value))) * kDown);
}

struct PairAndNorm {
  Pair pair;
  double norm_of_cross;
};

PairAndNorm pair_of(const Row& a, const Row& b) {
  const double n = norm(cross(a.x, b.x));
  return {{n + kCrossError * (a.length * b.length), speed_of_cross(a, b)}, n};
}

bool fit(const Row& a, const Row& b, const Row& c) { return fits(a) && fits(b) && fits(c); }

}  // namespace

BoundThresholds::BoundThresholds(const scene::MotionThresholds& t)
    : kappa(t.kappa), secant(std::sqrt(1 + t.kappa * t.kappa) * kUp), sine(std::sqrt(t.sigma) * kUp) {
  require_thresholds(t);
}

double facing_bound(const Row& a, const Row& b, const Row& c) {
  if (!fit(a, b, c)) return 0;
  const Det det = det_of(a, b, c);
  if (!(det.low > 0)) return 0;
  return det.speed == 0 ? kInfinity : det.low / det.speed * kDown;
}

double edge_bound(const Row& a, const Row& b, const BoundThresholds& thresholds) {
  if (!fits(a) || !fits(b)) return 0;
  const PairAndNorm ab = pair_of(a, b);
  return edge_root(a, b, ab.norm_of_cross, ab.pair, thresholds, kInfinity);
}

double separation_bound(const Row& p, const Row& a, const Row& b, const BoundThresholds& thresholds) {
  if (!fit(p, a, b)) return 0;
  return separation_root(det_of(p, a, b), pair_of(a, b).pair, p, thresholds.sine);
}

// d_v is never above d_i, so that the least of the three stands for facing too.
double triangle_bound(const Row& a, const Row& b, const Row& c, const BoundThresholds& t) {
  if (!fit(a, b, c)) return 0;
  const Det det = det_of(a, b, c);
  if (!(det.low > 0)) return 0;
  const PairAndNorm ab = pair_of(a, b), bc = pair_of(b, c), ca = pair_of(c, a);
  double m = separation_root(det, ab.pair, c, t.sine);
  m = std::min(m, separation_root(det, bc.pair, a, t.sine));
  m = std::min(m, separation_root(det, ca.pair, b, t.sine));
  m = edge_root(a, b, ab.norm_of_cross, ab.pair, t, m);
  m = edge_root(b, c, bc.norm_of_cross, bc.pair, t, m);
  return edge_root(c, a, ca.norm_of_cross, ca.pair, t, m);
}

}  // namespace clues::fastpath::motion
