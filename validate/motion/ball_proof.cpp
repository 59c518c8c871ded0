// Branch and bound with interval arithmetic. In a cube with middle c and half edge h, and in the ball,
//   separation: the determinant is affine, so it is at least det(c) - h |m|_1 in the cube and det(center) - |m| radius in the ball; the constraint
//     holds where it is not less than sin(eps) times the greatest |p - v| times the greatest |N(v)|, N = a(v) x b(v);
//   Delaunay: with gradients enclosed over the cube (mean value theorem; over what of it is in the ball, if its middle is), G is at least G(c) - h |grad G|_1 in the cube, and, split into a
//     middle gradient g and what is left of it, G(c) + g.(center - c) - |g| radius - h |rest|_1 in the part of the cube that is in the ball.
// Near the point where the ball touches the violation it is the second of each that ends the halving.
#include "validate/motion/ball_proof.h"
#include "validate/motion/interval_vector.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clues::validate {
namespace {

using Vector = IntervalVector;
using Row = std::array<Vector, 4>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector times(const Interval& f, const Vector& a) { return {f * a[0], f * a[1], f * a[2]}; }
Interval length(const Vector& a) { return CGAL::sqrt(CGAL::square(a[0]) + CGAL::square(a[1]) + CGAL::square(a[2])); }
Interval sum_of_sizes(const Vector& a) { return CGAL::abs(a[0]) + CGAL::abs(a[1]) + CGAL::abs(a[2]); }

struct Cube {
  scene::MotionPoint middle;
  double half;  // a power of two times the radius, so that middles are nearly exact; what they are is taken exactly
};

class Prover {
 public:
  Prover(const BallClaim& claim, double radius)
      : claim_(claim), radius_(radius), center_{claim.center[0], claim.center[1], claim.center[2]} {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto* sample = claim.samples[i];
      if (!sample) continue;
      at_[i] = {sample->at[0], sample->at[1], sample->at[2]};
      all_points_ = all_points_ && !sample->is_direction;
    }
    if (claim.constraint == scene::MotionConstraint::separation) prepare_separation();
    if (claim.constraint == scene::MotionConstraint::delaunay) prepare_delaunay();
  }

  bool outside_ball(const Cube& cube) const {
    Interval square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval away = CGAL::abs(Interval(cube.middle[i]) - center_[i]) - cube.half;
      if (away.inf() > 0) square += CGAL::square(away);
    }
    return square.inf() > CGAL::square(Interval(radius_)).sup();
  }

  bool in_ball(const scene::MotionPoint& v) const {
    const Vector away = minus({v[0], v[1], v[2]}, center_);
    return dot(away, away).sup() <= CGAL::square(radius_).inf();
  }

  // Whether the inequality shows it; `fails` when it fails at the middle already.
  bool shown(const Cube& cube, bool& fails) const {
    return claim_.constraint == scene::MotionConstraint::separation ? separated(cube, fails) : delaunay(cube, fails);
  }

 private:
  Row rows(const Vector& v) const {
    Row out = at_;
    for (std::size_t i = 0; i < 4; ++i) {
      if (claim_.samples[i] && !claim_.samples[i]->is_direction) out[i] = minus(at_[i], v);
    }
    return out;
  }
  bool moves(std::size_t i) const { return !claim_.samples[i]->is_direction; }
  Vector box(const Cube& cube) const {
    const Interval spread(-cube.half, cube.half);
    return {cube.middle[0] + spread, cube.middle[1] + spread, cube.middle[2] + spread};
  }

  // det of rows i, j, k, and its gradient.
  static Interval determinant(const Row& x, std::size_t i, std::size_t j, std::size_t k) {
    return dot(x[i], cross(x[j], x[k]));
  }
  Vector slope(const Row& x, std::size_t i, std::size_t j, std::size_t k) const {
    Vector out{0, 0, 0};
    if (moves(i)) out = minus(out, cross(x[j], x[k]));
    if (moves(j)) out = minus(out, cross(x[k], x[i]));
    if (moves(k)) out = minus(out, cross(x[i], x[j]));
    return out;
  }

  // Samples p, a, b.
  void prepare_separation() {
    const Row x = rows(center_);
    det_ = determinant(x, 0, 1, 2);
    slope_ = slope(x, 0, 1, 2);
    to_p_ = length(x[0]);
    normal_ = length(cross(x[1], x[2]));
    growth_ = 0;
    if (moves(1) && moves(2)) growth_ = length(minus(at_[1], at_[2]));
    if (moves(1) != moves(2)) growth_ = length(moves(1) ? at_[2] : at_[1]);
    sine_ = CGAL::sqrt(Interval(claim_.sigma));
  }

  bool separated(const Cube& cube, bool& fails) const {
    const Row x = rows({cube.middle[0], cube.middle[1], cube.middle[2]});
    const Interval here = determinant(x, 0, 1, 2);
    const Interval in_cube = here - sum_of_sizes(slope_) * cube.half;
    const Interval in_ball = det_ - length(slope_) * radius_;
    const double least = std::max(in_cube.inf(), in_ball.inf());
    const Interval reach = CGAL::sqrt(Interval(3)) * cube.half;
    const Interval p_here = length(x[0]), normal_here = length(cross(x[1], x[2]));
    const double p_most = moves(0) ? std::min((p_here + reach).sup(), (to_p_ + radius_).sup()) : to_p_.sup();
    const double normal_most = std::min((normal_here + growth_ * reach).sup(), (normal_ + growth_ * radius_).sup());
    fails = (here - sine_ * p_here * normal_here).sup() < 0;
    return least >= 0 && least >= (sine_ * Interval(p_most) * Interval(normal_most)).sup();
  }

  // Of four points: differences against d, so that small quadrangles do not drown in rounding.
  void prepare_delaunay() {
    const Row x = rows(center_);
    for (std::size_t i = 0; i < 4; ++i) nearest_[i] = (length(x[i]) - (moves(i) ? radius_ : Interval(0))).inf();
    if (!all_points_) return;
    for (std::size_t i = 0; i < 3; ++i) e_[i] = minus(at_[i], at_[3]);
    for (std::size_t i = 0; i < 3; ++i) k_[i] = cross(e_[(i + 1) % 3], e_[(i + 2) % 3]);
    volume_ = dot(e_[0], k_[0]);
  }

  // From a cube; or, `cut`, from the part of it that is in the ball.
  Interval length_from(const Row& x, std::size_t i, bool cut) const {
    const Interval l = length(x[i]);
    return cut && l.inf() < nearest_[i] && nearest_[i] <= l.sup() ? Interval(nearest_[i], l.sup()) : l;
  }

  struct Value {
    Interval g;
    Vector gradient;
  };

  Value of_four_points(const Vector& v, bool cut) const {
    const Row x = rows(v);
    const Interval l_d = length_from(x, 3, cut);
    const Vector u_d = times(Interval(1) / l_d, x[3]);
    Value out{volume_ * l_d, times(-volume_, u_d)};
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval l = length_from(x, i, cut);
      const Interval difference = dot(e_[i], plus(x[i], x[3])) / (l + l_d);              // l_i - l_d
      const Vector turn = times(Interval(1) / l, minus(e_[i], times(difference, u_d)));  // u_i - u_d
      const Interval height = -dot(k_[i], x[3]);
      out.g += height * difference;
      out.gradient = plus(out.gradient, minus(times(difference, k_[i]), times(height, turn)));
    }
    return out;
  }

  Value of_any_samples(const Vector& v, bool cut) const {
    const Row x = rows(v);
    Value out{0, {0, 0, 0}};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = i == 0 ? 1 : 0, k = i <= 1 ? 2 : 1, m = i <= 2 ? 3 : 2;
      const Interval sign = i % 2 == 0 ? -1 : 1;
      const Interval factor = sign * determinant(x, j, k, m);
      const Interval l = length_from(x, i, cut);
      out.g += factor * l;
      out.gradient = plus(out.gradient, times(sign * l, slope(x, j, k, m)));
      if (moves(i)) out.gradient = minus(out.gradient, times(factor / l, x[i]));
    }
    return out;
  }

  bool delaunay(const Cube& cube, bool& fails) const {
    const Vector middle{cube.middle[0], cube.middle[1], cube.middle[2]};
    const Vector whole = box(cube);
    const Row x = rows(whole);
    // The mean value theorem goes along the segment from the middle: only where that is in the ball, all of the segment to a point of
    // the ball is.
    const bool cut = in_ball(cube.middle);
    for (std::size_t i = 0; i < 4; ++i) {
      if (length_from(x, i, cut).inf() <= 0) return false;  // a sample may be in the cube: no directions to speak of
    }
    const auto value_at = [&](const Vector& v) {
      return all_points_ ? of_four_points(v, cut) : of_any_samples(v, cut);
    };
    const Interval here = value_at(middle).g;
    fails = here.sup() < 0;
    const Vector gradient = value_at(whole).gradient;
    if ((here - sum_of_sizes(gradient) * cube.half).inf() >= 0) return true;
    for (const auto& part : gradient) {
      if (!std::isfinite(part.inf()) || !std::isfinite(part.sup())) return false;
    }
    Vector main, rest;
    for (std::size_t i = 0; i < 3; ++i) {
      main[i] = gradient[i].inf() / 2 + gradient[i].sup() / 2;
      main[i] = Interval(main[i].inf());  // any number will do, if it is one
      rest[i] = gradient[i] - main[i];
    }
    const Interval least =
        here + dot(main, minus(center_, middle)) - length(main) * radius_ - sum_of_sizes(rest) * cube.half;
    return least.inf() >= 0;
  }

  BallClaim claim_;
  Interval radius_;
  Vector center_;
  Row at_{};
  bool all_points_ = true;
  Interval det_, to_p_, normal_, growth_, sine_, volume_;
  Vector slope_;
  std::array<double, 4> nearest_{};
  std::array<Vector, 3> e_, k_;
};

// x * 2^exponent where that is exact; otherwise `exact` becomes false.
double scaled(double x, int exponent, bool& exact) {
  const double out = std::ldexp(x, exponent);
  exact = exact && std::ldexp(out, -exponent) == x;
  return out;
}

// The same claim in other units, a power of two times the given ones, so that neither large nor small scenes leave the range of doubles.
// Directions have units of their own. False where that would round.
bool to_own_units(BallClaim& claim, double& radius, std::array<scene::DepthSample, 4>& samples, int& exponent) {
  const auto size_of = [](const scene::MotionPoint& p) {
    return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  };
  double size = std::max(size_of(claim.center), radius);
  for (const auto* sample : claim.samples) {
    if (sample && !sample->is_direction) size = std::max(size, size_of(sample->at));
  }
  exponent = -std::ilogb(size);
  bool exact = true;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!claim.samples[i]) continue;
    samples[i] = *claim.samples[i];
    const int own = samples[i].is_direction ? -std::ilogb(size_of(samples[i].at)) : exponent;
    for (double& x : samples[i].at) x = scaled(x, own, exact);
    claim.samples[i] = &samples[i];
  }
  for (double& x : claim.center) x = scaled(x, exponent, exact);
  radius = scaled(radius, exponent, exact);
  return exact;
}

}  // namespace

BallProof prove_in_ball(const BallClaim& given, double radius, std::uint64_t most_cubes) {
  BallClaim claim = given;
  std::array<scene::DepthSample, 4> samples;
  int exponent = 0;
  if (!to_own_units(claim, radius, samples, exponent)) return {};
  const Interval::Protector rounding;
  const Prover prover(claim, radius);
  BallProof out;
  std::vector<Cube> open{{claim.center, radius}};
  while (!open.empty()) {
    const Cube cube = open.back();
    open.pop_back();
    if (prover.outside_ball(cube)) continue;
    if (++out.cubes > most_cubes) return out;
    bool fails = false;
    if (prover.shown(cube, fails)) continue;
    if (fails && prover.in_ball(cube.middle)) {
      out.suspect = true;
      for (std::size_t i = 0; i < 3; ++i) out.at[i] = std::ldexp(cube.middle[i], -exponent);
      return out;
    }
    // A little more than half, because middles are rounded: the eight cover the cube.
    const double half = cube.half / 2;
    for (int corner = 0; corner < 8; ++corner) {
      Cube part{cube.middle, half};
      double missing = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double step = (corner >> i & 1) != 0 ? half : -half;
        part.middle[i] += step;
        missing = std::max(missing, (CGAL::abs(Interval(cube.middle[i]) + step - part.middle[i])).sup());
      }
      part.half = (Interval(half) + missing).sup();
      if (!(part.half < cube.half)) return out;  // as fine as doubles are
      open.push_back(part);
    }
  }
  out.proved = true;
  return out;
}

}  // namespace clues::validate
