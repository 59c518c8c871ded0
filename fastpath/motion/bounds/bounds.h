// Motion bounds in doubles, rounded down (D29, T8, T9): how far the viewpoint may move, in any direction, before a constraint can fail. Every
// bound is sound: no viewpoint nearer than it violates the constraint. 0 where doubles cannot tell; infinite where the constraint can never fail.
//
// Rounding. Every bound is made of (1) a few values that cancel - determinants, kappa |a x b| - a.b, gradients - each taken with its derived
// absolute error towards the safe side, and (2) sums, products, quotients and roots of numbers of one sign, or a difference of two numbers that
// are taken as exact: fewer than 200 operations, each of which moves the result by a relative 2^-53, at most doubled on its way to the result. The last
// factor kDown = 1 - 2^-40 makes up for 2^13 of these.
#pragma once

#include <cmath>
#include <limits>

#include "fastpath/motion/bounds/row.h"
#include "scene/motion/depth_mesh.h"

namespace clues::fastpath::motion {

inline constexpr double kDown = 1 - 0x1p-40, kUp = 1 + 0x1p-40, kInfinity = std::numeric_limits<double>::infinity();

// Odometers are rounded up, keys down.
inline double sum_up(double a, double b) { return std::nextafter(a + b, kInfinity); }
inline double sum_down(double a, double b) { return std::isfinite(b) ? std::nextafter(a + b, -kInfinity) : b; }

// Thresholds as the bounds need them.
struct BoundThresholds {
  // Throws scene::Error non_finite, and bad_argument where sigma is no square of a sine.
  explicit BoundThresholds(const scene::MotionThresholds& t);
  double kappa, secant;  // secant >= sqrt(1 + kappa^2) = 1 / sin(phi)
  double sine;           // >= sqrt(sigma)
};

// Facing, edge lengths and separations of one triangle: min(d_i, d_e of three edges, d_v of three pairs).
double triangle_bound(const Row& a, const Row& b, const Row& c, const BoundThresholds& thresholds);

// Its parts. facing_bound: d_i = det / |grad det| (A1.1; det is linear in the viewpoint, also where rows are directions).
double facing_bound(const Row& a, const Row& b, const Row& c);
double edge_bound(const Row& a, const Row& b, const BoundThresholds& thresholds);
double separation_bound(const Row& p, const Row& a, const Row& b, const BoundThresholds& thresholds);

// That a, b, c and the triangle on the other side of the edge bc, with d, stay locally Delaunay, as long as both face the viewpoint.
double delaunay_bound(const Row& a, const Row& b, const Row& c, const Row& d);

}  // namespace clues::fastpath::motion
