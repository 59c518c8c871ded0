// What is left of the Delaunay condition of four samples as the viewpoint moves (T9, form 3), and how far it may move in some directions and in others.
//
// A bound need not be the radius of a ball. For a convex body B that holds 0, let gauge(w) be the least t with w in t B. It is subadditive: the sum of the
// gauges of the steps of a walk, an odometer, is at least the gauge of the way from any place on it to the viewpoint. So if nothing within t B
// violates a constraint, it holds until that odometer has gone on by t (D30, T14 in docs/motion.md). Here B is a ball, or a needle, which is long where the
// viewpoint is heading and thin elsewhere.
#pragma once

#include <cmath>

#include "fastpath/motion/bounds/row.h"

namespace clues::fastpath::motion {

// A symmetric matrix.
struct Symmetric {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  void add(double f, const Vec& p) {
    const Vec fp = f * p;
    xx += fp.x * p.x, yy += fp.y * p.y, zz += fp.z * p.z;
    xy += fp.x * p.y, xz += fp.x * p.z, yz += fp.y * p.z;
  }
  // The symmetric part of p r^T.
  void add(const Vec& p, const Vec& r) {
    xx += p.x * r.x, yy += p.y * r.y, zz += p.z * r.z;
    xy += 0.5 * (p.x * r.y + p.y * r.x), xz += 0.5 * (p.x * r.z + p.z * r.x), yz += 0.5 * (p.y * r.z + p.z * r.y);
  }
  void scale(double f) { xx *= f, yy *= f, zz *= f, xy *= f, xz *= f, yz *= f; }
  Vec times(const Vec& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
  void add_identity(double f) { xx += f, yy += f, zz += f; }
  double frobenius() const { return std::sqrt((xx * xx + yy * yy + zz * zz) + 2 * (xy * xy + xz * xz + yz * yz)); }
  double form(const Vec& v) const {
    return (xx * v.x * v.x + yy * v.y * v.y + zz * v.z * v.z) + 2 * (xy * v.x * v.y + xz * v.x * v.z + yz * v.y * v.z);
  }
};

// B: all d u + e with 0 <= d <= 1 and |e| <= tail + d (head - tail). A ball has u = 0.
struct Gauge {
  Vec u;                      // a unit vector, nearly
  double tail = 1, head = 1;  // radii at its blunt end, which is at 0, and at u: 0 < tail <= head <= 1
};

// gauge(step), rounded up.
double gauge_up(const Gauge& gauge, const Vec& step);

// After a way w of at most `up_to` the sum of T9 is at least value + slope.w + w^T second w - (slope_error |w| + second_error |w|^2 + third |w|^3),
// times a positive number. Nothing is known where value is not positive; nothing can fail where it is infinite.
struct DelaunayModel {
  double value = 0;
  Vec slope;
  Symmetric second;
  double slope_error = 0, second_error = 0, third = 0, up_to = 0;
};

DelaunayModel delaunay_model(const Row& a, const Row& b, const Row& c, const Row& d);

// How far along the gauges of a walk; the model must outlive it.
class Reaches {
 public:
  explicit Reaches(const DelaunayModel& model);
  explicit Reaches(const DelaunayModel&&) = delete;
  // A t, nearly the largest, for which no viewpoint in t B violates the condition, as long as both triangles face the viewpoint; 0 where none is found, or
  // infinite. O(1), some 50 ns.
  double of(const Gauge& gauge) const;
  // About that, in a third of the time: to choose by.
  double guess(const Gauge& gauge) const;

 private:
  // value - t b - t^2 c is left at the blunt end of t B and at the other, without errors and third order.
  struct Falls {
    double b_tail, c_tail, b_head, c_head;
  };
  Falls falls(const Gauge& gauge) const;
  double rest(double s) const { return s * (model_.slope_error + s * (model_.second_error + s * model_.third)); }

  const DelaunayModel& model_;
  double slope_, size_;  // |slope|, |second|
  double sinks_ = 0;     // at least minus the least eigenvalue of `second`, and not negative
};

}  // namespace clues::fastpath::motion
