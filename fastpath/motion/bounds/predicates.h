// The four constraints of a depth mesh (D29) at one viewpoint, in filtered doubles: an answer, or "unsure"; and decided, with exact/motion/
// where doubles are unsure. Signs as in exact/motion/constraints.h.
#pragma once

#include <cstdint>

#include "fastpath/motion/bounds/row.h"

namespace clues::fastpath::motion {

enum class Answer : std::int8_t { no, yes, unsure };

// ---- Error bounds. u = 2^-53; l are exact lengths of rows.
//
// det(a,b,c): each of the six terms is a product of three coordinates (3 roundings), with a product, a difference, a product and two sums (5)
// on its way: (1+u)^8 - 1 times the permanent of the absolute values. For rows of length 1 that permanent is at most 2/sqrt(3): it is a . p with
// p = (b2 c3 + b3 c2, ...), and |p|^2 = 1 + t^2 - 2 sum (bi ci)^2 <= 1 + t^2 / 3 <= 4/3 for t = sum bi ci <= 1. The lengths as
// computed are too short by a factor of at most (1-4u)^3, their product with the constant by (1-u)^3.
inline constexpr double kDeterminantError = 0x1.28p-50;  // times la lb lc
// G: det of rows (x, y, z, l) from minors of columns xy (2 + 1 + 1 roundings) and zl (1 + 4 + 1 + 1), their product (1) and five sums: (1+u)^17 - 1
// times the permanent, at most 4 * 2/sqrt(3) times la lb lc ld; (1-4u)^4 and (1-u)^4 as above.
inline constexpr double kDelaunayError = 0x1.3cp-47;  // times la lb lc ld
// |a x b|: a coordinate of the product has (1+u)^4 - 1 times |aj bk| + |ak bj|, of norm at most sqrt(4/3) la lb; the norm adds (1+u)^(5/2) - 1:
// below 7.2u la lb. a.b: (1+u)^5 - 1 times at most la lb. kappa |a x b| - a.b adds a product and a difference: 9.3u |kappa| + 6.1u. Rounded up,
// with the lengths as computed.
inline constexpr double kCrossError = 0x1p-50;                                // 8u, times la lb
inline constexpr double kEdgeErrorOfKappa = 0x1.4p-50, kEdgeError = 0x1p-50;  // 10u, 8u, times la lb

inline double determinant(const Row& a, const Row& b, const Row& c) { return dot(a.x, cross(b.x, c.x)); }

// det4 of rows (x, l); positive where d lies outside of the cap through a, b, c.
inline double delaunay_value(const Row& a, const Row& b, const Row& c, const Row& d) {
  const auto xy = [](const Row& p, const Row& q) { return p.x.x * q.x.y - p.x.y * q.x.x; };
  const auto zl = [](const Row& p, const Row& q) { return p.x.z * q.length - p.length * q.x.z; };
  return ((xy(a, b) * zl(c, d) + xy(c, d) * zl(a, b)) + (xy(b, c) * zl(a, d) + xy(a, d) * zl(b, c))) -
         (xy(a, c) * zl(b, d) + xy(b, d) * zl(a, c));
}

inline Answer above(double value, double bound) {
  return value > bound ? Answer::yes : value < -bound ? Answer::no : Answer::unsure;
}

// det > 0. `error` is a parameter so that a test can show what a smaller one does.
inline Answer faces_filtered(const Row& a, const Row& b, const Row& c, double error = kDeterminantError) {
  if (!fits(a) || !fits(b) || !fits(c)) return Answer::unsure;
  return above(determinant(a, b, c), error * (a.length * b.length * c.length));
}

// G > 0; "no": G < 0.
inline Answer delaunay_filtered(const Row& a, const Row& b, const Row& c, const Row& d, double error = kDelaunayError) {
  if (!fits(a) || !fits(b) || !fits(c) || !fits(d)) return Answer::unsure;
  return above(delaunay_value(a, b, c, d), error * ((a.length * b.length) * (c.length * d.length)));
}

Answer edge_length_filtered(const Row& a, const Row& b, double kappa);
// Never says no: what is not certain is rare enough.
Answer separation_filtered(const Row& p, const Row& a, const Row& b, double sine);

// How often doubles were unsure.
struct PredicateCounts {
  std::uint64_t exact = 0;
};

// The constraints, decided. A vertex is its sample and its row from `at`. O(1); some microseconds where doubles are unsure.
struct Seen {
  const DepthSample* sample;
  const Row* row;
};

// Finite, and sigma from 0 to 1: throws scene::Error non_finite, bad_argument.
void require_thresholds(const scene::MotionThresholds& thresholds);

class Constraints {
 public:
  // Throws as require_thresholds(), and bad_argument for a kappa beyond 2^50.
  explicit Constraints(const scene::MotionThresholds& thresholds);

  const scene::MotionThresholds& thresholds() const { return thresholds_; }
  double sine() const { return sine_; }  // sqrt(sigma), rounded up

  // -1, 0, 1
  int facing(const Seen& a, const Seen& b, const Seen& c, const MotionPoint& at);
  int delaunay(const Seen& a, const Seen& b, const Seen& c, const Seen& d, const MotionPoint& at);
  bool edge_length(const Seen& a, const Seen& b, const MotionPoint& at);
  bool separation(const Seen& p, const Seen& a, const Seen& b, const MotionPoint& at);
  // Facing, the three edges, the three separations.
  bool triangle(const Seen& a, const Seen& b, const Seen& c, const MotionPoint& at);

  PredicateCounts counts;

 private:
  scene::MotionThresholds thresholds_;
  double sine_;
};

}  // namespace clues::fastpath::motion
