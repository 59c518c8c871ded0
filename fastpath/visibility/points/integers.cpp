#include "fastpath/visibility/points/integers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace clues::fastpath {

namespace {

constexpr unsigned kLongest = 448;  // bits of numbers that points keep, without an allocation

Integer imported(const mpz_class& z) {
  Integer out;
  const mpz_srcptr raw = z.get_mpz_t();
  if (mpz_size(raw) > 0)
    import_bits(out, mpz_limbs_read(raw), mpz_limbs_read(raw) + mpz_size(raw), GMP_NUMB_BITS, false);
  return sgn(z) < 0 ? Integer(-out) : out;
}

mpz_class exported(const Integer& x) {
  std::vector<mp_limb_t> limbs;
  export_bits(abs(x), std::back_inserter(limbs), GMP_NUMB_BITS, false);
  mpz_class out;
  mpz_import(out.get_mpz_t(), limbs.size(), -1, sizeof(mp_limb_t), 0, 0, limbs.data());
  return x.sign() < 0 ? mpz_class(-out) : out;
}

// m 2^e, m a whole number of at most 53 bits.
std::pair<std::int64_t, int> parts(double x) {
  int e = 0;
  const double m = std::frexp(x, &e);
  return {static_cast<std::int64_t>(std::ldexp(m, 53)), e - 53};
}

Homogeneous homogeneous_of(const ExactPoint& p) {
  Homogeneous out;
  if (p.is_double()) {
    const Vec3<Interval>& at = p.approximate();
    const auto x = parts(at.x.inf()), y = parts(at.y.inf()), z = parts(at.z.inf());
    int least = 0;
    bool any = false;
    for (const auto* c : {&x, &y, &z}) {
      if (c->first == 0) continue;
      least = any ? std::min(least, c->second) : c->second;
      any = true;
    }
    const auto at_least = [&](const std::pair<std::int64_t, int>& c) {
      return c.first == 0 ? Integer(0) : Integer(Integer(c.first) << static_cast<unsigned>(c.second - least));
    };
    out.v = {at_least(x), at_least(y), at_least(z)};
    out.e = -least;
    out.w = 1;
    out.whole = true;
    return out;
  }
  const Exact3& q = p.exact();
  mpz_class w;
  mpz_lcm(w.get_mpz_t(), q.x.get_den_mpz_t(), q.y.get_den_mpz_t());
  mpz_lcm(w.get_mpz_t(), w.get_mpz_t(), q.z.get_den_mpz_t());
  const auto times_w = [&](const Rational& c) { return imported(mpz_class(c.get_num() * (w / c.get_den()))); };
  out.v = {times_w(q.x), times_w(q.y), times_w(q.z)};
  out.w = imported(w);
  out.whole = w == 1;
  return out;
}

unsigned bits(const Integer3& v) {
  unsigned most = 0;
  for (const Integer* c : {&v.x, &v.y, &v.z}) {
    if (c->sign() != 0) most = std::max(most, static_cast<unsigned>(msb(abs(*c))) + 1);
  }
  return most;
}

// Of all coordinates that are not 0; if there is none it is ~0U.
unsigned trailing_zeros(const Integer3& v) {
  unsigned zeros = ~0U;
  for (const Integer* c : {&v.x, &v.y, &v.z}) {
    if (c->sign() != 0) zeros = std::min(zeros, static_cast<unsigned>(lsb(abs(*c))));
  }
  return zeros;
}

// Without the common power of two.
void shorten(Integer3& v) {
  const unsigned zeros = trailing_zeros(v);
  if (zeros == 0 || zeros == ~0U) return;
  for (Integer* c : {&v.x, &v.y, &v.z}) *c >>= zeros;
}

Integer3 shifted(const Integer3& v, unsigned by) {
  return {Integer(v.x << by), Integer(v.y << by), Integer(v.z << by)};
}

Integer shifted(const Integer& x, int by) { return Integer(x << static_cast<unsigned>(by)); }

double size_of(const Vec3<Interval>& v) {
  double most = 0;
  for (const Interval* c : {&v.x, &v.y, &v.z}) most = std::max({most, std::fabs(c->inf()), std::fabs(c->sup())});
  return most;
}

}  // namespace

// With h(x) = n . (x - c), for points x = v / (w 2^e), let H(x) = h(x) w 2^e times what is the same for all x. Then (H(a) v(b) - H(b) v(a)) / (H(a) w(b) 2^e(b) - H(b) w(a) 2^e(a)).
std::optional<Homogeneous> ExactPoint::crossing_in_whole_numbers() const {
  const Integer3& n = plane_->normal_direction();
  const Homogeneous &a = a_->homogeneous(), &b = b_->homogeneous(), &c = plane_->base().homogeneous();
  if (std::max({bits(a.v), bits(b.v), bits(c.v), bits(n)}) > kLongest) return std::nullopt;
  const int least = std::min({a.e, b.e, c.e});
  const Integer at_c = dot(n, c.v);
  const auto height = [&](const Homogeneous& x) {
    return Integer(shifted(dot(n, x.v) * c.w, c.e - least) - shifted(at_c * x.w, x.e - least));
  };
  const Integer at_a = height(a), at_b = height(b);
  Homogeneous out;
  out.v = at_a * b.v - at_b * a.v;
  out.w = shifted(at_a * b.w, b.e - least) - shifted(at_b * a.w, a.e - least);
  out.e = least;
  if (out.w.sign() < 0) {
    out.v = Integer(-1) * out.v;
    out.w = -out.w;
  }
  const unsigned zeros = std::min(trailing_zeros(out.v), static_cast<unsigned>(lsb(out.w)));
  for (Integer* x : {&out.v.x, &out.v.y, &out.v.z, &out.w}) *x >>= zeros;
  out.whole = out.w == 1;
  if (std::max(bits(out.v), static_cast<unsigned>(msb(out.w)) + 1) > kLongest) return std::nullopt;
  return out;
}

// (1 - t) a + t b; t is m 2^e, or -1 for the point that is reflected.
std::optional<Homogeneous> ExactPoint::combination_in_whole_numbers() const {
  constexpr int kFinest = 128;
  auto [m, e] = parts(kind_ == Kind::reflected ? -1 : t_);
  for (; m != 0 && m % 2 == 0; ++e) m /= 2;
  if (m == 0) e = 0;
  const Homogeneous &a = a_->homogeneous(), &b = b_->homogeneous();
  const unsigned longest = std::max({bits(a.v), bits(b.v), bits({a.w, b.w, 0})});
  if (e < -kFinest || e > kFinest || longest > kLongest) return std::nullopt;
  // 2^below (1 - t) and 2^below t
  const int below = std::max(-e, 0), least = std::min(a.e, b.e);
  const Integer of_b = shifted(Integer(m), std::max(e, 0)), of_a = shifted(Integer(1), below) - of_b;
  Homogeneous out;
  out.v = shifted(of_a * b.w, b.e - least) * a.v + shifted(of_b * a.w, a.e - least) * b.v;
  out.w = a.w * b.w;
  out.e = a.e + b.e - least + below;
  out.whole = out.w == 1;
  if (std::max(bits(out.v), static_cast<unsigned>(msb(out.w)) + 1) > kLongest) return std::nullopt;
  return out;
}

const Homogeneous& ExactPoint::homogeneous() const {
  if (const Homogeneous* known = homogeneous_.load(std::memory_order_acquire)) return *known;
  // Whether or not another thread has already asked for the fractions: directions are multiples that depend on these numbers, and what is chosen by their sizes must not hang on that.
  if (kind_ != Kind::given && !is_double()) {
    if (auto whole = kind_ == Kind::on_plane ? crossing_in_whole_numbers() : combination_in_whole_numbers())
      return keep_first(homogeneous_, *std::move(whole));
  }
  return keep_first(homogeneous_, homogeneous_of(*this));
}

int compare_exactly(const ExactPoint& p, const ExactPoint& q, int axis) {
  const Homogeneous &a = p.homogeneous(), &b = q.homogeneous();
  const int least = std::min(a.e, b.e);
  const Integer left = shifted(coordinate(a.v, axis) * b.w, b.e - least),
                right = shifted(coordinate(b.v, axis) * a.w, a.e - least);
  return (left > right) - (left < right);
}

template <>
Vec3<Integer> direction<Integer>(const ExactPoint& from, const ExactPoint& to) {
  const Homogeneous &a = from.homogeneous(), &b = to.homogeneous();
  // (b.v a.w 2^a.e - a.v b.w 2^b.e) / (a.w b.w 2^(a.e + b.e)): the smaller power of two cancels.
  const int least = std::min(a.e, b.e);
  const auto scaled = [&](const Homogeneous& p, const Homogeneous& other) {
    Integer3 v = shifted(p.v, static_cast<unsigned>(other.e - least));
    return other.whole ? v : other.w * v;
  };
  Integer3 out = scaled(b, a) - scaled(a, b);
  shorten(out);
  return out;
}

const Integer3& Plane::normal_direction() const {
  if (const Integer3* known = direction_.load(std::memory_order_acquire)) return *known;
  Integer3 n = cross(direction<Integer>(*a_, *b_), direction<Integer>(*a_, *c_));
  shorten(n);
  return keep_first(direction_, std::move(n));
}

template <>
Vec3<Interval> balanced_sum<Interval>(const Vec3<Interval>& a, const Vec3<Interval>& b) {
  const auto weight = [](const Vec3<Interval>& v) {
    const double size = size_of(v);
    // Of the smallest doubles the inverse is none.
    return Interval(size > 0 && std::isfinite(size) ? std::ldexp(1.0, std::min(-std::ilogb(size), 1000)) : 1.0);
  };
  return weight(a) * a + weight(b) * b;
}

template <>
Vec3<Integer> balanced_sum<Integer>(const Vec3<Integer>& a, const Vec3<Integer>& b) {
  const unsigned at_a = bits(a), at_b = bits(b), most = std::max(at_a, at_b);
  return shifted(a, most - at_a) + shifted(b, most - at_b);
}

template <>
Vec3<Interval> moved_by<Interval>(const Vec3<Interval>& limit, const Vec3<Interval>& aside, const Vec3<Interval>& off,
                                  int exponent) {
  if (exponent > 500) throw Unsure{};
  const Interval step(std::ldexp(1.0, -exponent));
  return limit + step * aside + Interval(step * step) * off;
}

template <>
Vec3<Integer> moved_by<Integer>(const Vec3<Integer>& limit, const Vec3<Integer>& aside, const Vec3<Integer>& off,
                                int exponent) {
  const unsigned most = std::max({bits(limit), bits(aside), bits(off)});
  const auto e = static_cast<unsigned>(exponent);
  const auto as_long = [&](const Integer3& v, unsigned by) { return shifted(v, most - bits(v) + by); };
  return as_long(limit, 2 * e) + as_long(aside, e) + as_long(off, 0);
}

Vec3<Interval> around_multiple(const Vec3<Integer>& v) {
  constexpr unsigned kDigits = 53;
  const unsigned n = bits(v), cut = n > kDigits ? n - kDigits : 0;
  const auto around = [&](const Integer& c) {
    const auto low = static_cast<double>(static_cast<std::int64_t>(Integer(abs(c) >> cut)));
    const Interval size(low, cut > 0 && c.sign() != 0 ? low + 1 : low);
    return c.sign() < 0 ? -size : size;
  };
  return {around(v.x), around(v.y), around(v.z)};
}

ExactPoint point_towards(const ExactPoint& x, const Vec3<Integer>& d, double distance) {
  // x may be a corner of V, in doubles even the point that is asked for; and twice the largest double is none.
  using Limits = std::numeric_limits<double>;
  const long shift = std::ilogb(std::clamp(distance, Limits::min(), Limits::max())) - static_cast<long>(bits(d));
  const auto scaled = [&](const Integer& c) {
    Rational q(exported(c));
    (shift >= 0 ? mpq_mul_2exp : mpq_div_2exp)(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(std::abs(shift)));
    return q;
  };
  return ExactPoint(x.exact() + Exact3{scaled(d.x), scaled(d.y), scaled(d.z)});
}

}  // namespace clues::fastpath
