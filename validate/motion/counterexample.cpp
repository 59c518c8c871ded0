// Three ways, from sure to hopeful: the centre itself; the nearest violation of facing and edge length, which is known in closed form (with 512
// binary digits, and a little beyond it, where the ball allows); a descent in doubles of how well the constraint holds, from many directions.
#include "validate/motion/counterexample.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/motion/compare_bounds.h"
#include "exact/motion/rational_vector.h"

namespace clues::validate {
namespace {

using exact::ExactViewpoint;
using exact::RationalVector;
using scene::MotionConstraint;
using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }

class Search {
 public:
  Search(const BallQuestion& question, const exact::ExactThresholds& thresholds)
      : q_(question), thresholds_(thresholds), center_(exact::exact_viewpoint(question.center)) {
    if (std::isfinite(q_.radius)) radius_squared_ = mpq_class(q_.radius) * mpq_class(q_.radius);
    kappa_ = thresholds.kappa.get_d();
    sigma_ = thresholds.sigma.get_d();
  }

  // Whether center + w is a violation inside of the ball.
  std::optional<ExactViewpoint> confirmed(const RationalVector& w) const {
    if (std::isfinite(q_.radius) && exact::dot(w, w) >= radius_squared_) return {};
    const ExactViewpoint v = exact::plus(center_, w);
    if (holds_at(q_.constraint, q_.samples, v, thresholds_)) return {};
    return v;
  }

  std::optional<ExactViewpoint> nearest_known() const {
    if (q_.constraint == MotionConstraint::facing) {
      const auto height = exact::affine_determinant({q_.samples[0], q_.samples[1], q_.samples[2]}, center_);
      const mpq_class steepness = exact::dot(height.gradient, height.gradient);
      if (sgn(steepness) == 0) return {};
      return confirmed(exact::times(height.gradient, -height.value / steepness));
    }
    if (q_.constraint == MotionConstraint::edge_length) return nearest_of_edge();
    return {};
  }

  std::optional<ExactViewpoint> confirmed(const Point& w) const {
    // Far from the range of doubles a search may lead anywhere.
    if (!std::all_of(w.begin(), w.end(), [](double x) { return std::isfinite(x); })) return {};
    return confirmed(RationalVector{mpq_class(w[0]), mpq_class(w[1]), mpq_class(w[2])});
  }

  std::optional<ExactViewpoint> descent(const Point& start) const {
    const double size = std::isfinite(q_.radius) ? q_.radius : farthest();
    const double most = size * (1 - 0x1p-30);
    Point w = start;
    double step = size / 2;
    double value = margin(w);
    for (int round = 0; round < 80 && step > size * 0x1p-24; ++round) {
      if (value < 0) {
        if (auto found = confirmed(w)) return found;
      }
      Point gradient{};
      const double delta = size * 0x1p-20;
      for (std::size_t i = 0; i < 3; ++i) {
        Point to = w, from = w;
        to[i] += delta;
        from[i] -= delta;
        gradient[i] = margin(to) - margin(from);
      }
      const double steepness = length(gradient);
      if (!(steepness > 0)) break;
      Point next;
      for (std::size_t i = 0; i < 3; ++i) next[i] = w[i] - step * gradient[i] / steepness;
      if (const double far = length(next); far > most) {
        for (double& x : next) x *= most / far;
      }
      const double there = margin(next);
      if (there < value) {
        w = next;
        value = there;
      } else {
        step /= 2;
      }
    }
    return confirmed(w);
  }

  double farthest() const {
    double out = 1;
    for (const auto* sample : q_.samples) {
      if (sample && !sample->is_direction) out = std::max(out, 8 * length(sample->at - q_.center));
    }
    return out;
  }

 private:
  Point row(std::size_t i, const Point& w) const {
    const auto& sample = *q_.samples[i];
    if (sample.is_direction) return sample.at;
    return sample.at - q_.center - w;
  }

  // Negative where the constraint fails, about; without dimension.
  double margin(const Point& w) const {
    const Point a = row(0, w), b = row(1, w);
    const double sizes = length(a) * length(b);
    if (q_.constraint == MotionConstraint::edge_length) {
      const double dihedral = std::atan2(length(cross(a, b)), dot(a, b));
      return dihedral - std::atan2(1.0, kappa_);
    }
    const Point c = row(2, w);
    if (q_.constraint == MotionConstraint::facing) return dot(a, cross(b, c)) / (sizes * length(c));
    if (q_.constraint == MotionConstraint::separation) {
      const Point normal = cross(b, c);
      const double limit = std::asin(std::min(1.0, std::sqrt(sigma_)));
      if (dot(cross(normal, b), a) >= 0 && dot(cross(c, normal), a) >= 0) {
        return std::asin(std::min(1.0, std::abs(dot(normal, a)) / (length(normal) * length(a)))) - limit;
      }
      const auto angle = [&](const Point& x) { return std::atan2(length(cross(a, x)), dot(a, x)); };
      return std::min(angle(b), angle(c)) - limit;
    }
    const Point d = row(3, w);
    const double lengths[] = {length(a), length(b), length(c), length(d)};
    Point u[4] = {a, b, c, d};
    for (std::size_t i = 0; i < 4; ++i) {
      for (double& x : u[i]) x /= lengths[i];
    }
    return -dot(u[3] - u[0], cross(u[1] - u[0], u[2] - u[0]));
  }

  // The surface is met at right angles from the centre of the circle, away from it (or at an end of the edge, or on the cone).
  std::optional<ExactViewpoint> nearest_of_edge() const {
    const auto &first = *q_.samples[0], &second = *q_.samples[1];
    switch (exact::edge_branch(first, second, center_, thresholds_)) {
      case exact::EdgeBranch::violated:
      case exact::EdgeBranch::never_changes:
        return {};
      case exact::EdgeBranch::end_point:
      case exact::EdgeBranch::cone_apex:
        for (const auto* end : {&first, &second}) {
          if (end->is_direction) continue;
          if (auto found = confirmed(exact::seen(*end, center_))) return found;
        }
        return {};
      case exact::EdgeBranch::tube:
        return beyond(direction_from_tube(first, second));
      case exact::EdgeBranch::cone_side:
        return beyond(direction_from_cone(first, second));
    }
    return {};
  }

  static constexpr unsigned digits = 512;
  using Float = mpf_class;
  using FloatVector = std::array<Float, 3>;

  static FloatVector floats(const RationalVector& a) {
    return {Float(a[0], digits), Float(a[1], digits), Float(a[2], digits)};
  }
  static Float product(const FloatVector& a, const FloatVector& b) {
    Float sum(0, digits);
    for (std::size_t i = 0; i < 3; ++i) sum += a[i] * b[i];
    return sum;
  }
  static FloatVector combined(const Float& f, const FloatVector& a, const Float& g, const FloatVector& b) {
    FloatVector out = a;
    for (std::size_t i = 0; i < 3; ++i) out[i] = f * a[i] + g * b[i];
    return out;
  }
  static Float size(const FloatVector& a) { return Float(sqrt(product(a, a))); }
  static Float number(double x) { return Float(x, digits); }

  // Of a vector that is not 0.
  static FloatVector unit(const FloatVector& a) { return combined(Float(1 / size(a)), a, number(0), a); }

  // A unit vector at right angles to `axis`: of `a`, or any if a lies on the axis. What is left of a may be as small as it likes, so that only its
  // length is rounded. Of the three axes of the world, two at least are not along `axis`.
  static FloatVector across(const RationalVector& a, const RationalVector& axis) {
    const auto part = [&](const RationalVector& x) {
      return exact::minus(x, exact::times(axis, exact::dot(x, axis) / exact::dot(axis, axis)));
    };
    const RationalVector zero;
    RationalVector out = part(a);
    for (std::size_t i = 0; i < 3 && out == zero; ++i) {
      RationalVector along;
      along[i] = 1;
      out = part(along);
    }
    return unit(floats(out));
  }

  // Unit vector from v to the nearest point of the torus: along the radius of the circle, away from its centre. Ends that are far away and next to each
  // other are one point in any number of digits: they are rounded after they have been subtracted.
  FloatVector direction_from_tube(const scene::DepthSample& first, const scene::DepthSample& second) const {
    const auto a = exact::seen(first, center_), b = exact::seen(second, center_);
    const auto edge = exact::minus(b, a);
    const auto middle = floats(exact::times(exact::plus(a, b), mpq_class(1, 2)));  // m - v
    const Float length = size(floats(edge));
    // From the axis to v; where v is on it, any way out is as near.
    const auto out = across(exact::times(a, -1), edge);
    const Float height = Float(thresholds_.kappa, digits) * length / 2;
    const auto to_circle = combined(number(1), middle, height, out);  // circle's centre - v
    const Float r = size(to_circle);
    if (r < length * number(0x1p-200)) return unit(floats(edge));
    return combined(Float(-1 / r), to_circle, number(0), to_circle);
  }

  FloatVector direction_from_cone(const scene::DepthSample& first, const scene::DepthSample& second) const {
    const auto& direction = first.is_direction ? first : second;
    const auto& apex = first.is_direction ? second : first;
    const auto along = exact::seen(direction, center_);
    const auto axis = unit(floats(along));
    const auto out = across(exact::seen(apex, center_), along);
    // y moves against v: towards the side of the cone, that is by -(cos(phi) out - sin(phi) axis).
    const Float kappa(thresholds_.kappa, digits);
    const Float cosecant = Float(sqrt(Float(1 + kappa * kappa)));
    return combined(Float(kappa / cosecant), out, Float(-1 / cosecant), axis);
  }

  // A little beyond the nearest violation, as far as the ball goes.
  std::optional<ExactViewpoint> beyond(const FloatVector& direction) const {
    if (!std::isfinite(q_.radius)) return {};
    for (const int bits : {40, 120, 300, 450}) {
      Float shrink(1, digits), little(1, digits);
      mpf_div_2exp(little.get_mpf_t(), little.get_mpf_t(), static_cast<mp_bitcnt_t>(bits));
      shrink -= little;
      const Float far = Float(q_.radius, digits) * shrink;
      RationalVector w;
      for (std::size_t i = 0; i < 3; ++i) w[i] = mpq_class(Float(direction[i] * far));
      if (auto found = confirmed(w)) return found;
    }
    return {};
  }

  const BallQuestion& q_;
  const exact::ExactThresholds& thresholds_;
  ExactViewpoint center_;
  mpq_class radius_squared_;
  double kappa_ = 0, sigma_ = 0;
};

}  // namespace

std::optional<exact::ExactViewpoint> find_violation(const BallQuestion& question,
                                                    const exact::ExactThresholds& thresholds,
                                                    const std::vector<scene::MotionPoint>& hints) {
  const Search search(question, thresholds);
  if (auto found = search.confirmed(RationalVector{})) return found;
  if (auto found = search.nearest_known()) return found;
  for (const auto& hint : hints) {
    const auto w = hint - question.center;
    if (auto found = search.confirmed(w)) return found;
    if (auto found = search.descent(w)) return found;
  }
  const double size = std::isfinite(question.radius) ? question.radius : search.farthest();
  if (auto found = search.descent(Point{})) return found;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const double length = std::sqrt(static_cast<double>(x * x + y * y + z * z));
        const double far = 0.999 * size / length;
        if (auto found = search.descent({x * far, y * far, z * far})) return found;
      }
    }
  }
  return {};
}

}  // namespace clues::validate
