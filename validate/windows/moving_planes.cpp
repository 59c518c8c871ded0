// Signs of moving triples of planes, and the roots at which they change.
#include "validate/windows/moving_planes.h"

#include <CGAL/Gmpz.h>
#include <CGAL/Sqrt_extension.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clues::validate {
namespace {

using Interval = MovingPlanes::Interval;

// Encloses an integer, also one too long for a double's mantissa.
Interval enclose(const Integer& x) {
  if (mpz_sizeinbase(x.get_mpz_t(), 2) <= 53) return Interval(x.get_d());
  return Interval(CGAL::to_interval(CGAL::Gmpz(x.get_mpz_t())));
}

Interval enclose(const Rational& x) { return Interval(CGAL::to_interval(CGAL::Gmpq(x.get_mpq_t()))); }

CGAL::Gmpq to_gmpq(const Integer& x) { return CGAL::Gmpq(CGAL::Gmpz(x.get_mpz_t())); }

std::uint64_t key_of(int i, int j, int k) {
  return (static_cast<std::uint64_t>(i) << 42U) | (static_cast<std::uint64_t>(j) << 21U) |
         static_cast<std::uint64_t>(k);
}

// det(a_i + s b_i): c[0] + c[1] s + c[2] s^2; the term in s^3 is zero and left out.
template <class T>
std::array<T, 3> determinant(const std::array<T, 3>& a0, const std::array<T, 3>& b0, const std::array<T, 3>& a1,
                             const std::array<T, 3>& b1, const std::array<T, 3>& a2, const std::array<T, 3>& b2) {
  const auto aa = cross(a0, a1), bb = cross(b0, b1), ab = sum(cross(a0, b1), cross(b0, a1));
  return {T(dot(aa, a2)), T(dot(ab, a2) + dot(aa, b2)), T(dot(bb, a2) + dot(ab, b2))};
}

bool surely_not_zero(const Interval& x) { return x.inf() > 0 || x.sup() < 0; }
bool surely_zero(const Interval& x) { return x.inf() == 0 && x.sup() == 0; }

// Whether the polynomial surely has no root in [low, high], by the signs of its Bernstein coefficients.
bool surely_no_root(const std::array<Interval, 3>& c, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return false;
  const Interval l(low), h(high);
  const Interval at_l = c[0] + l * (c[1] + l * c[2]), at_h = c[0] + h * (c[1] + h * c[2]);
  const Interval middle = c[0] + c[1] * (l + h) / Interval(2) + c[2] * l * h;
  return (at_l.inf() > 0 && at_h.inf() > 0 && middle.inf() > 0) ||
         (at_l.sup() < 0 && at_h.sup() < 0 && middle.sup() < 0);
}

// How far from s the nearest root seems to be: only an order in which to look.
double distance_estimate(const std::array<Interval, 3>& near, double s) {
  const double c0 = (near[0].inf() + near[0].sup()) / 2, c1 = (near[1].inf() + near[1].sup()) / 2,
               c2 = (near[2].inf() + near[2].sup()) / 2;
  const double value = c0 + s * (c1 + s * c2), slope = c1 + 2 * s * c2;
  const double d = slope * slope - 4 * c2 * value;
  if (d < 0) return std::numeric_limits<double>::max();
  const double q = std::abs(slope) + std::sqrt(d);
  return q == 0 ? std::numeric_limits<double>::max() : 2 * std::abs(value) / q;
}

}  // namespace

Root to_root(const Rational& x) { return Root(CGAL::Gmpq(x.get_mpq_t())); }

Rational between(const Root& low, const Root& high) {
  Rational below(static_cast<long>(std::floor(CGAL::to_interval(low).first)) - 1),
      above(static_cast<long>(std::ceil(CGAL::to_interval(high).second)) + 1);
  for (;;) {
    const Rational middle = (below + above) / 2;
    const Root at = to_root(middle);
    if (at <= low) {
      below = middle;
    } else if (at >= high) {
      above = middle;
    } else {
      return middle;
    }
  }
}

MovingPlanes::MovingPlanes(RVector origin, RVector direction)
    : origin_(std::move(origin)), direction_(std::move(direction)) {}

int MovingPlanes::add(const RVector& a, const RVector& b) {
  Plane plane;
  make_primitive(a, b, plane.a, plane.b);
  for (std::size_t i = 0; i < 3; ++i) {
    plane.near_a[i] = enclose(plane.a[i]);
    plane.near_b[i] = enclose(plane.b[i]);
  }
  planes_.push_back(std::move(plane));
  return static_cast<int>(planes_.size()) - 1;
}

int MovingPlanes::add_constant(const RVector& normal) { return add(normal, RVector{}); }

int MovingPlanes::add_line(const RVector& a, const RVector& b) {
  const RVector along = minus(b, a);
  return add(cross(minus(a, origin_), along), times(cross(direction_, along), Rational(-1)));
}

int MovingPlanes::add_value(const RVector& normal, const RVector& at) {
  IVector a, b;
  make_primitive({dot(normal, minus(origin_, at)), dot(normal, direction_), 0}, RVector{}, a, b);
  Polynomial p;
  p.exact = std::make_unique<std::array<Integer, 3>>(std::array<Integer, 3>{a[0], a[1], 0});
  p.near = {enclose(a[0]), enclose(a[1]), Interval(0)};
  values_.push_back(std::move(p));
  return static_cast<int>(values_.size()) - 1;
}

void MovingPlanes::move_to(const Rational& s) {
  s_ = s;
  near_s_ = enclose(s);
  ++visit_;
  on_event_ = false;
  remembered_.clear();
}

const IVector& MovingPlanes::normal(int i) {
  Plane& plane = planes_[static_cast<std::size_t>(i)];
  if (plane.here_for != visit_) {
    plane.here = sum(times(plane.a, Integer(s_.get_den())), times(plane.b, Integer(s_.get_num())));
    plane.here_for = visit_;
  }
  return plane.here;
}

MovingPlanes::Polynomial& MovingPlanes::triple(int i, int j, int k) {
  const auto [at, fresh] = triples_.try_emplace(key_of(i, j, k));
  Polynomial& p = at->second;
  if (fresh) {
    const auto &x = planes_[static_cast<std::size_t>(i)], &y = planes_[static_cast<std::size_t>(j)],
               &z = planes_[static_cast<std::size_t>(k)];
    p.near = determinant(x.near_a, x.near_b, y.near_a, y.near_b, z.near_a, z.near_b);
    p.planes = {i, j, k};
  }
  return p;
}

const std::array<Integer, 3>& MovingPlanes::exact_of(const Polynomial& p) const {
  if (!p.exact) {
    const auto &x = planes_[static_cast<std::size_t>(p.planes[0])], &y = planes_[static_cast<std::size_t>(p.planes[1])],
               &z = planes_[static_cast<std::size_t>(p.planes[2])];
    p.exact = std::make_unique<std::array<Integer, 3>>(determinant(x.a, x.b, y.a, y.b, z.a, z.b));
  }
  return *p.exact;
}

int MovingPlanes::sign_here(Polynomial& p) {
  if (p.sign_for == visit_) return p.sign;
  p.sign_for = visit_;
  const Interval near = p.near[0] + near_s_ * (p.near[1] + near_s_ * p.near[2]);
  if (surely_not_zero(near)) {
    p.sign = near.inf() > 0 ? 1 : -1;
  } else if (surely_zero(p.near[0]) && surely_zero(p.near[1]) && surely_zero(p.near[2])) {
    p.sign = 0;
  } else {
    const auto& c = exact_of(p);
    const Integer &n = s_.get_num(), &d = s_.get_den();
    p.sign = sgn(Integer(c[0] * d * d + c[1] * n * d + c[2] * n * n));
  }
  return p.sign;
}

void MovingPlanes::remember(Polynomial& p, int sign) {
  if (p.remembered_for == visit_) return;
  p.remembered_for = visit_;
  if (sign == 0) {
    const auto& c = exact_of(p);
    if (sgn(c[0]) != 0 || sgn(c[1]) != 0 || sgn(c[2]) != 0) on_event_ = true;
    return;
  }
  remembered_.push_back(&p);
}

int MovingPlanes::sign(int i, int j, int k, bool certain) {
  if (i == j || j == k || i == k) return 0;
  int parity = 1;
  if (i > j) std::swap(i, j), parity = -parity;
  if (j > k) std::swap(j, k), parity = -parity;
  if (i > j) std::swap(i, j), parity = -parity;
  Polynomial& p = triple(i, j, k);
  const int here = sign_here(p);
  if (certain) remember(p, here);
  return parity * here;
}

int MovingPlanes::value_sign(int value, bool certain) {
  Polynomial& p = values_[static_cast<std::size_t>(value)];
  const int here = sign_here(p);
  if (certain) remember(p, here);
  return here;
}

void MovingPlanes::shrink(const Polynomial& p, OpenRange& range) const {
  const auto& c = exact_of(p);
  std::vector<Root> roots;
  if (sgn(c[2]) != 0) {
    if (sgn(Integer(c[1] * c[1] - 4 * c[2] * c[0])) < 0) return;
    for (const bool smaller : {true, false}) {
      roots.push_back(CGAL::make_root_of_2(to_gmpq(c[2]), to_gmpq(c[1]), to_gmpq(c[0]), smaller));
    }
  } else if (sgn(c[1]) != 0) {
    roots.emplace_back(-to_gmpq(c[0]) / to_gmpq(c[1]));
  }
  const Root here = to_root(s_);
  for (const Root& root : roots) {
    if (root < here) {
      if (range.low < root) range.low = root;
    } else if (root < range.high) {
      range.high = root;
    }
  }
}

OpenRange MovingPlanes::valid_range(const OpenRange& range) const {
  std::vector<std::pair<double, const Polynomial*>> order;
  const double s = s_.get_d();
  for (const Polynomial* p : remembered_) order.emplace_back(distance_estimate(p->near, s), p);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  OpenRange valid = range;
  for (const auto& [distance, p] : order) {
    if (surely_no_root(p->near, CGAL::to_interval(valid.low).first, CGAL::to_interval(valid.high).second)) continue;
    shrink(*p, valid);
  }
  return valid;
}

}  // namespace clues::validate
