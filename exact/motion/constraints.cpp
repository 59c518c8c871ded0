// The four constraints at a viewpoint, by integers.
#include "exact/motion/constraints.h"

#include <cmath>

#include "scene/messages/error.h"

namespace clues::exact {
namespace {

using Vector = std::array<mpz_class, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpz_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Whether p and q are seen at least eps apart: p.q <= cos(eps) |p| |q|, with cos^2 = 1 - sigma.
bool apart(const SightRow& p, const SightRow& q, const mpq_class& sigma) {
  const mpz_class product = dot(p, q);
  if (sgn(product) <= 0) return true;
  const mpz_class& den = sigma.get_den();
  return product * product * den <= (den - sigma.get_num()) * p.square * q.square;
}

}  // namespace

ExactThresholds::ExactThresholds(const scene::MotionThresholds& thresholds) {
  if (!std::isfinite(thresholds.kappa)) {
    throw scene::Error(scene::ErrorCode::non_finite, "kappa, the cotangent of the least edge length, must be finite");
  }
  if (!(thresholds.sigma >= 0 && thresholds.sigma <= 1)) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       "sigma, the squared sine of the least separation, must be from 0 to 1");
  }
  kappa = thresholds.kappa;
  sigma = thresholds.sigma;
}

int facing_sign(const SightRow& a, const SightRow& b, const SightRow& c) { return sgn(determinant(a, b, c)); }

bool edge_length_holds(const SightRow& a, const SightRow& b, const ExactThresholds& thresholds) {
  if (sgn(a.square) == 0 || sgn(b.square) == 0) return false;
  const mpz_class p = dot(a, b);
  const mpz_class area = a.square * b.square - p * p;  // |a x b|^2
  const mpz_class left = thresholds.kappa.get_num() * thresholds.kappa.get_num() * area;
  const mpz_class right = p * thresholds.kappa.get_den();
  return sign_of_sum({sgn(thresholds.kappa), left}, {-sgn(right), right * right}) >= 0;
}

// The point of the great circle of a and b that is nearest to p lies between a and b when p is on the inner sides of the planes through N
// and a, and N and b; then the angle to the circle counts, sin = |N.p| / |N||p|. Otherwise an end of the edge is nearest.
bool separation_holds(const SightRow& p, const SightRow& a, const SightRow& b, const ExactThresholds& thresholds) {
  if (sgn(p.square) == 0 || sgn(a.square) == 0 || sgn(b.square) == 0) return false;
  const Vector normal = cross(a.x, b.x);
  const mpz_class normal_square = dot(normal, normal);
  if (sgn(normal_square) == 0) {
    // Both ends in one direction are one point of the sphere; in opposite ones, the viewpoint stands on the edge.
    return sgn(dot(a, b)) > 0 && apart(p, a, thresholds.sigma);
  }
  if (sgn(dot(cross(normal, a.x), p.x)) >= 0 && sgn(dot(cross(b.x, normal), p.x)) >= 0) {
    const mpz_class height = dot(normal, p.x);
    return height * height * thresholds.sigma.get_den() >= thresholds.sigma.get_num() * normal_square * p.square;
  }
  return apart(p, a, thresholds.sigma) && apart(p, b, thresholds.sigma);
}

// G is the determinant of the rows (x, |x|), developed by its last column.
int delaunay_sign(const SightRow& a, const SightRow& b, const SightRow& c, const SightRow& d) {
  const auto term = [](int sign, const mpz_class& factor, const mpz_class& square) {
    return SignedRoot{sign * sgn(factor), factor * factor * square};
  };
  return sign_of_sum(term(-1, determinant(b, c, d), a.square), term(1, determinant(a, c, d), b.square),
                     term(-1, determinant(a, b, d), c.square), term(1, determinant(a, b, c), d.square));
}

}  // namespace clues::exact
