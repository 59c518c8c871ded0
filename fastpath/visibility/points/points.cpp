#include "fastpath/visibility/points/points.h"

#include <climits>
#include <cmath>

#include "fastpath/visibility/points/integers.h"

namespace clues::fastpath {

namespace {

Interval near(const Rational& q) {
  // mpq's get_d rounds toward zero: one step outward on either side.
  const double d = q.get_d();
  if (q == d) return {d};
  return {std::nextafter(d, -HUGE_VAL), std::nextafter(d, HUGE_VAL)};
}

// About the binary logarithm of the largest coordinate; no double need hold it. LONG_MIN for the zero vector.
long magnitude(const Exact3& v) {
  long most = LONG_MIN;
  for (const Rational* x : {&v.x, &v.y, &v.z}) {
    if (sgn(*x) == 0) continue;
    most = std::max(most, static_cast<long>(mpz_sizeinbase(x->get_num_mpz_t(), 2)) -
                              static_cast<long>(mpz_sizeinbase(x->get_den_mpz_t(), 2)));
  }
  return most;
}

// x 2^exponent
Rational times_power(Rational x, long exponent) {
  (exponent >= 0 ? mpq_mul_2exp : mpq_div_2exp)(x.get_mpq_t(), x.get_mpq_t(),
                                                static_cast<mp_bitcnt_t>(std::abs(exponent)));
  return x;
}

// Down to a multiple of 2^exponent.
Rational rounded_down(const Rational& x, long exponent) {
  const Rational scaled = times_power(x, -exponent);
  mpz_class whole;
  mpz_fdiv_q(whole.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  return times_power(Rational(whole), exponent);
}

}  // namespace

std::uint64_t& exact_decisions() {
  thread_local std::uint64_t count = 0;
  return count;
}

ExactPoint::ExactPoint(const Point& p) : near_{Interval(p[0]), Interval(p[1]), Interval(p[2])} {}

ExactPoint::ExactPoint(const Exact3& p) : near_{near(p.x), near(p.y), near(p.z)}, exact_(new Exact3(p)) {}

ExactPoint ExactPoint::on_plane(const ExactPoint& a, const ExactPoint& b, const Plane& plane) {
  ExactPoint out;
  out.kind_ = Kind::on_plane;
  out.a_ = &a;
  out.b_ = &b;
  out.plane_ = &plane;
  const Interval at_a = plane.value_approximate(a), at_b = plane.value_approximate(b);
  // Between 0 and 1, whatever the quotient of two uncertain values says.
  const Interval quotient = at_a / (at_a - at_b);
  const Interval t(quotient.inf() >= 0 ? std::min(quotient.inf(), 1.0) : 0,
                   quotient.sup() <= 1 ? std::max(quotient.sup(), 0.0) : 1);
  const auto part = [&](const Interval& u, const Interval& w) {
    const Interval x = u + t * (w - u);
    return Interval(std::max(x.inf(), std::min(u.inf(), w.inf())), std::min(x.sup(), std::max(u.sup(), w.sup())));
  };
  out.near_ = {part(a.near_.x, b.near_.x), part(a.near_.y, b.near_.y), part(a.near_.z, b.near_.z)};
  return out;
}

ExactPoint ExactPoint::between(const ExactPoint& a, const ExactPoint& b, double t) {
  ExactPoint out;
  out.kind_ = Kind::between;
  out.a_ = &a;
  out.b_ = &b;
  out.t_ = t;
  out.near_ = a.near_ + Interval(t) * (b.near_ - a.near_);
  return out;
}

ExactPoint ExactPoint::lifted(const ExactPoint& from, const ExactPoint& to, double step, const Plane& plane,
                              double lift) {
  const Exact3& n = plane.normal_exact();
  const Exact3 way = to.exact() - from.exact();
  const Rational scale = times_power(Rational(1), magnitude(way) - magnitude(n));
  return ExactPoint(from.exact() + Rational(step) * (way + Rational(scale * Rational(lift)) * n));
}

ExactPoint ExactPoint::reflected(const ExactPoint& x, const ExactPoint& s) {
  ExactPoint out;
  out.kind_ = Kind::reflected;
  out.a_ = &x;
  out.b_ = &s;
  out.near_ = x.near_ + (x.near_ - s.near_);
  return out;
}

ExactPoint::ExactPoint(const ExactPoint& other) { *this = other; }

ExactPoint& ExactPoint::operator=(const ExactPoint& other) {
  if (this == &other) return *this;
  kind_ = other.kind_;
  near_ = other.near_;
  a_ = other.a_;
  b_ = other.b_;
  plane_ = other.plane_;
  t_ = other.t_;
  const Exact3* known = other.exact_.load(std::memory_order_acquire);
  delete exact_.exchange(known ? new Exact3(*known) : nullptr, std::memory_order_acq_rel);
  delete homogeneous_.exchange(nullptr, std::memory_order_acq_rel);
  return *this;
}

const Exact3& ExactPoint::exact() const {
  if (const Exact3* known = exact_.load(std::memory_order_acquire)) return *known;
  switch (kind_) {
    case Kind::given:
      return keep_first(exact_, Exact3{Rational(near_.x.inf()), Rational(near_.y.inf()), Rational(near_.z.inf())});
    case Kind::on_plane: {
      const Rational at_a = plane_->value_exact(*a_), at_b = plane_->value_exact(*b_);
      const Rational t = at_a / (at_a - at_b);
      return keep_first(exact_, a_->exact() + t * (b_->exact() - a_->exact()));
    }
    case Kind::between:
      return keep_first(exact_, a_->exact() + Rational(t_) * (b_->exact() - a_->exact()));
    case Kind::reflected:
      break;
  }
  return keep_first(exact_, a_->exact() + (a_->exact() - b_->exact()));
}

Point ExactPoint::estimate() const {
  const auto middle = [](const Interval& i) { return i.inf() + (i.sup() - i.inf()) / 2; };
  return {middle(near_.x), middle(near_.y), middle(near_.z)};
}

Plane::Plane(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) : a_(&a), b_(&b), c_(&c) {
  normal_ = cross(b.approximate() - a.approximate(), c.approximate() - a.approximate());
  first_look_ = LinearForm(normal_, a.approximate());
  int best = -1;
  double size = 0;
  for (int i = 0; i < 3; ++i) {
    const Interval& n = coordinate(normal_, i);
    const double least = std::max(n.inf(), -n.sup());
    if (least > size) {
      size = least;
      best = i;
    }
  }
  bool positive = best >= 0 && coordinate(normal_, best).inf() > 0;
  if (best < 0) {
    const Exact3& n = normal_exact();
    for (int i = 0; i < 3 && best < 0; ++i) {
      if (sgn(coordinate(n, i)) != 0) best = i;
    }
    if (best < 0) best = 0;
    positive = sgn(coordinate(n, best)) > 0;
  }
  axes_ = {static_cast<std::uint8_t>((best + 1) % 3), static_cast<std::uint8_t>((best + 2) % 3)};
  if (!positive) std::swap(axes_[0], axes_[1]);
}

const Exact3& Plane::normal_exact() const {
  if (const Exact3* known = exact_.load(std::memory_order_acquire)) return *known;
  return keep_first(exact_, cross(b_->exact() - a_->exact(), c_->exact() - a_->exact()));
}

namespace {

// Apart from their callers, which are flattened: the compiler would put all of GMP's expressions in line as well, and take
// minutes and gigabytes where nothing is gained.
[[gnu::noinline]] int side_exactly(const Plane& h, const ExactPoint& x) {
  ++exact_decisions();
  return sign_of(Integer(dot(normal_direction<Integer>(h), direction<Integer>(h.base(), x))));
}

template <class NT>
NT determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
  return NT(dot(cross(direction<NT>(a, b), direction<NT>(a, c)), direction<NT>(a, d)));
}

[[gnu::noinline]] int orientation_exactly(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                                          const ExactPoint& d) {
  ++exact_decisions();
  return sign_of(determinant<Integer>(a, b, c, d));
}

}  // namespace

[[gnu::flatten]] int Plane::side(const ExactPoint& x) const {
  if (&x == a_ || &x == b_ || &x == c_) return 0;
  if (const int sure = first_look_.sign(Around(x.approximate()))) return sure;
  const int s = filtered_sign(value_approximate(x));
  return s != kUnsure ? s : side_exactly(*this, x);
}

double length_estimate(const Point& v) {
  const double most = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  if (!(most > 0)) return 0;
  const int binary = std::ilogb(most);
  double sum = 0;
  for (const double x : v) sum += std::ldexp(x, -binary) * std::ldexp(x, -binary);
  return std::ldexp(std::sqrt(sum), binary);
}

ExactPoint point_near(const ExactPoint& x, const ExactPoint& to, int level) {
  constexpr int kDoubles = 3;
  if (level >= kDoubles) {
    // With numbers as short as the distance allows: they must not grow from leg to leg of a walk.
    const int bits = 24 * (level - kDoubles + 1);
    const Exact3& from = x.exact();
    const Exact3 way = to.exact() - from;
    const long size = magnitude(way);
    if (size == LONG_MIN) return ExactPoint(from);
    const Rational step = times_power(Rational(1), -5 - bits);
    const Exact3 p = from + step * way;
    const long grid = size - 5 - 2 * bits;
    return ExactPoint(Exact3{rounded_down(p.x, grid), rounded_down(p.y, grid), rounded_down(p.z, grid)});
  }
  const Point a = x.estimate(), b = to.estimate();
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + std::ldexp(b[k] - a[k], -5 - 8 * level);
  return ExactPoint(p);
}

[[gnu::flatten]] int orientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
  const int s = filtered_sign(determinant<Interval>(a, b, c, d));
  return s != kUnsure ? s : orientation_exactly(a, b, c, d);
}

int compare_coordinate(const ExactPoint& a, const ExactPoint& b, int axis) {
  if (&a == &b) return 0;
  const int s = filtered_sign(coordinate(a.approximate(), axis) - coordinate(b.approximate(), axis));
  if (s != kUnsure) return s;
  ++exact_decisions();
  return compare_exactly(a, b, axis);
}

bool equal(const ExactPoint& a, const ExactPoint& b) {
  for (int i = 0; i < 3; ++i) {
    const Interval &u = coordinate(a.approximate(), i), &w = coordinate(b.approximate(), i);
    if (u.inf() > w.sup() || w.inf() > u.sup()) return false;
  }
  for (int i = 0; i < 3; ++i) {
    if (compare_coordinate(a, b, i) != 0) return false;
  }
  return true;
}

bool collinear(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return decide([&]<class NT>() {
    const Vec3<NT> n = cross(coordinates<NT>(b) - coordinates<NT>(a), coordinates<NT>(c) - coordinates<NT>(a));
    // One component that is surely not zero is enough.
    bool unsure = false;
    for (const NT* x : {&n.x, &n.y, &n.z}) {
      const int s = filtered_sign(*x);
      if (s == 1 || s == -1) return false;
      unsure |= s == kUnsure;
    }
    if (unsure) throw Unsure{};
    return true;
  });
}

}  // namespace clues::fastpath
