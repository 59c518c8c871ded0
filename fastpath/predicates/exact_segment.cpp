// D3, D5 exactly. All points of one question are multiples of one power of two: as whole numbers their signs need no fractions.
#include "fastpath/predicates/exact_segment.h"

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "fastpath/predicates/exact_cell.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

using Whole = std::array<mpz_class, 3>;

// Points times a common power of two, as whole numbers. Signs, and parameters along a segment, do not depend on the power.
template <std::size_t N>
std::array<Whole, N> whole_numbers(const std::array<const Point*, N>& points) {
  constexpr int kBits = std::numeric_limits<double>::digits;
  std::array<std::array<double, 3>, N> mantissas{};
  std::array<std::array<int, 3>, N> exponents{};
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      mantissas[i][k] = std::ldexp(std::frexp((*points[i])[k], &exponents[i][k]), kBits);
      if (mantissas[i][k] != 0) least = std::min(least, exponents[i][k]);
    }
  }
  std::array<Whole, N> out;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (mantissas[i][k] == 0) continue;
      out[i][k] = mantissas[i][k];
      out[i][k] <<= static_cast<mp_bitcnt_t>(exponents[i][k] - least);
    }
  }
  return out;
}

Whole operator-(const Whole& a, const Whole& b) {
  return {mpz_class(a[0] - b[0]), mpz_class(a[1] - b[1]), mpz_class(a[2] - b[2])};
}

Whole cross(const Whole& a, const Whole& b) {
  return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
          mpz_class(a[0] * b[1] - a[1] * b[0])};
}

mpz_class dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_zero(const Whole& v) { return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0; }

__extension__ using Wide = __int128;
// Of 1024 bits, in place: no memory is asked for.
using Long = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    1024, 1024, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
template <class Number>
using Numbers3 = std::array<Number, 3>;

// The same when the points are multiples of one power of two by whole numbers below 2^kBits, none of them subnormal. O(1), no memory: the usual way of being degenerate is cheap.
template <class Number, int kBits, std::size_t N>
std::optional<std::array<Numbers3<Number>, N>> short_numbers(const std::array<const Point*, N>& points) {
  std::array<Numbers3<std::int64_t>, N> mantissas{};
  std::array<Numbers3<int>, N> exponents{};
  int least = std::numeric_limits<int>::max(), most = std::numeric_limits<int>::min();
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = (*points[i])[k];
      if (x == 0) continue;
      const auto bits = std::bit_cast<std::uint64_t>(x);
      const int exponent = static_cast<int>((bits >> 52U) & 0x7ffU);
      if (exponent == 0) return std::nullopt;  // subnormal
      auto mantissa = static_cast<std::int64_t>((bits & 0xfffffffffffffU) | 0x10000000000000U);
      const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
      mantissa >>= zeros;
      mantissas[i][k] = x < 0 ? -mantissa : mantissa;
      exponents[i][k] = exponent + zeros;
      least = std::min(least, exponent + zeros);
      most = std::max(most, exponent + 53);
    }
  }
  std::array<Numbers3<Number>, N> out{};
  if (most < least) return out;
  if (most - least > kBits) return std::nullopt;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (mantissas[i][k] == 0) continue;
      out[i][k] = Number(mantissas[i][k]) * (Number(1) << static_cast<unsigned>(exponents[i][k] - least));
    }
  }
  return out;
}

// Whole numbers below 2^40, as on grids and in meshes of floats, and twice the determinant of three differences of them: these are below 2^41, products of
// two below 2^82, their differences below 2^83, times 2^41, three of those: below 2^126.
constexpr int kSmallBits = 40;
// And those below 2^110, as nearly all points of scenes are: the determinant is below 2^336, a product of two sums of two below 2^675.
constexpr int kLongBits = 110;

template <class Wider, class Number>
Wider determinant(const Numbers3<Number>& a, const Numbers3<Number>& b, const Numbers3<Number>& c,
                  const Numbers3<Number>& d) {
  std::array<std::array<Wider, 3>, 3> m{};
  for (std::size_t k = 0; k < 3; ++k) {
    m[0][k] = b[k] - a[k];
    m[1][k] = c[k] - a[k];
    m[2][k] = d[k] - a[k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) + m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

template <class Number>
int sign_of(const Number& value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

// Unsure only in the plane of the triangle.
template <class Wider, class Number>
Meets meets_short(const std::array<Numbers3<Number>, 5>& p) {
  const auto orientation = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return sign_of(determinant<Wider>(p[a], p[b], p[c], p[d]));
  };
  const int at_a = orientation(0, 1, 2, 3), at_b = orientation(0, 1, 2, 4);
  if (at_a == 0 && at_b == 0) return Meets::unsure;
  if (at_a * at_b >= 0) return Meets::no;
  bool left = false, right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = orientation(3, 4, i, (i + 1) % 3);
    left = left || side > 0;
    right = right || side < 0;
  }
  return left && right ? Meets::no : Meets::yes;
}

// As CGAL::orientation; none where points are too long.
std::optional<int> side_of(const Corners& t, const Point& p) {
  const FilteredSign sign = orient3d_filtered(t[0], t[1], t[2], p);
  if (sign.certain) return static_cast<int>(sign.sign);
  const std::array<const Point*, 4> points{&t[0], &t[1], &t[2], &p};
  const auto side = [](const auto& n, auto wider) {
    return sign_of(determinant<decltype(wider)>(n[0], n[1], n[2], n[3]));
  };
  if (const auto small = short_numbers<std::int64_t, kSmallBits>(points)) return side(*small, Wide{});
  if (const auto longer = short_numbers<Long, kLongBits>(points)) return side(*longer, Long{});
  return std::nullopt;
}

// Where two planes are crossed, each between the ends: a point each, so whatever the cell is.
std::optional<int> compare_crossings(const Segment& s, const Corners& x, const Corners& y) {
  const auto p = short_numbers<Long, kLongBits, 8>({&x[0], &x[1], &x[2], &y[0], &y[1], &y[2], &s.a, &s.b});
  if (!p) return std::nullopt;
  struct Crossing {
    Long before, all;  // of the way, as a fraction
  };
  const auto crossing = [&](std::size_t first) -> std::optional<Crossing> {
    Long at_a = determinant<Long>((*p)[first], (*p)[first + 1], (*p)[first + 2], (*p)[6]);
    Long at_b = determinant<Long>((*p)[first], (*p)[first + 1], (*p)[first + 2], (*p)[7]);
    if (sign_of(at_a) * sign_of(at_b) >= 0) return std::nullopt;
    if (at_a < 0) {
      at_a = -at_a;
    } else {
      at_b = -at_b;
    }
    return Crossing{at_a, at_a + at_b};
  };
  const auto at_x = crossing(0), at_y = crossing(3);
  if (!at_x || !at_y) return std::nullopt;
  const Long left = at_x->before * at_y->all, right = at_y->before * at_x->all;
  return left < right ? -1 : left > right ? 1 : 0;
}

// A set of parameters: an interval with or without its ends.
struct Interval {
  mpq_class low = 0, high = 1;
  bool low_in = false, high_in = false;

  bool empty() const { return low > high || (low == high && !(low_in && high_in)); }
  void raise(const mpq_class& x, bool in) {
    if (x > low || (x == low && !in)) {
      low_in = x > low ? in : low_in && in;
      low = x;
    }
  }
  void lower(const mpq_class& x, bool in) {
    if (x < high || (x == high && !in)) {
      high_in = x < high ? in : high_in && in;
      high = x;
    }
  }
};

mpq_class quotient(const mpz_class& a, const mpz_class& b) {
  mpq_class q(a, b);
  q.canonicalize();
  return q;
}

// The parameters in (0,1) at which the segment is in the closed triangle; nullopt when there are none.
std::optional<Interval> met_part(const Segment& s, const Corners& t) {
  const auto p = whole_numbers<5>({&t[0], &t[1], &t[2], &s.a, &s.b});
  const Whole normal = cross(p[1] - p[0], p[2] - p[0]), along = p[4] - p[3];
  if (is_zero(along)) return std::nullopt;
  const mpz_class at_a = dot(normal, p[3] - p[0]), at_b = dot(normal, p[4] - p[0]);
  Interval part;
  if (sgn(at_a) == 0 && sgn(at_b) == 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Whole inward = cross(normal, p[(i + 1) % 3] - p[i]);
      const mpz_class start = dot(inward, p[3] - p[i]), slope = dot(inward, along);
      if (sgn(slope) == 0) {
        if (sgn(start) < 0) return std::nullopt;
      } else if (sgn(slope) > 0) {
        part.raise(quotient(-start, slope), true);
      } else {
        part.lower(quotient(-start, slope), true);
      }
    }
    return part.empty() ? std::nullopt : std::optional(part);
  }
  if (sgn(at_a) * sgn(at_b) >= 0) return std::nullopt;
  const Whole moment = cross(p[3], p[4]);
  bool left = false, right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Whole &x = p[i], &y = p[(i + 1) % 3];
    const int side = sgn(mpz_class(dot(along, cross(x, y)) + dot(moment, y - x)));
    left = left || side > 0;
    right = right || side < 0;
  }
  if (left && right) return std::nullopt;
  part.low = part.high = quotient(at_a, at_a - at_b);
  part.low_in = part.high_in = true;
  return part;
}

// The parameters in [0,1] at which the segment is in int V; nullopt when there are none.
std::optional<Interval> inside_part(const Segment& s, const ExactCell& cell) {
  const auto value = [](const ExactCell::Plane& plane, const Point& p) {
    return mpq_class(plane.normal[0] * mpq_class(p[0]) + plane.normal[1] * mpq_class(p[1]) +
                     plane.normal[2] * mpq_class(p[2]) - plane.offset);
  };
  Interval part;
  part.low_in = part.high_in = true;
  for (const auto& plane : cell.bounds) {
    const mpq_class at_a = value(plane, s.a), at_b = value(plane, s.b);
    if (at_a == at_b) {
      if (sgn(at_a) >= 0) return std::nullopt;
      continue;
    }
    const mpq_class where = at_a / (at_a - at_b);
    if (at_b < at_a) {
      part.raise(where, false);
    } else {
      part.lower(where, false);
    }
  }
  return part.empty() ? std::nullopt : std::optional(part);
}

// Where the part of the segment in the triangle and outside int V begins (an infimum); nullopt when there is no such part.
std::optional<mpq_class> first_block(const Segment& s, const Corners& t, const Cell* cell) {
  const std::optional<Interval> met = met_part(s, t);
  if (!met) return std::nullopt;
  const std::optional<Interval> inside = cell == nullptr ? std::nullopt : inside_part(s, cell->exact());
  if (!inside) return met->low;
  // What lies before the inside part, then what lies after it.
  Interval before = *met, after = *met;
  before.lower(inside->low, !inside->low_in);
  if (!before.empty()) return before.low;
  after.raise(inside->high, !inside->high_in);
  if (!after.empty()) return after.low;
  return std::nullopt;
}

mpq_class surely(const std::optional<mpq_class>& x) {
  if (!x) throw scene::Error(scene::ErrorCode::internal, "a triangle that was said to block a segment does not");
  return *x;
}

}  // namespace

bool degenerate_exact(const Corners& t) {
  const auto p = whole_numbers<3>({&t[0], &t[1], &t[2]});
  return is_zero(cross(p[1] - p[0], p[2] - p[0]));
}

bool meets_exact(const Segment& s, const Corners& t) {
  const std::array<const Point*, 5> points{&t[0], &t[1], &t[2], &s.a, &s.b};
  Meets meets = Meets::unsure;
  if (const auto small = short_numbers<std::int64_t, kSmallBits>(points)) {
    meets = meets_short<Wide>(*small);
  } else if (const auto longer = short_numbers<Long, kLongBits>(points)) {
    meets = meets_short<Long>(*longer);
  }
  if (meets != Meets::unsure) return meets == Meets::yes;
  return met_part(s, t).has_value();
}

// int V is the inside of the hull of the vertices.
bool misses_inside_of(const Corners& t, const Cell& cell) {
  bool negative = false, positive = false;
  for (const Point& v : cell.vertices()) {
    const auto side = side_of(t, v);
    if (!side) return false;
    negative = negative || *side < 0;
    positive = positive || *side > 0;
    if (negative && positive) return false;
  }
  return true;
}

bool blocks_exact(const Segment& s, const Corners& t, const Cell& cell) { return first_block(s, t, &cell).has_value(); }

int compare_first_exact(const Segment& s, const Corners& x, const Corners& y, const Cell* cell) {
  if (const auto order = compare_crossings(s, x, y)) return *order;
  const int order = cmp(surely(first_block(s, x, cell)), surely(first_block(s, y, cell)));
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

}  // namespace clues::fastpath
