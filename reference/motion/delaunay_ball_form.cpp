// T9, form 3 (docs/motion.md has the theorem). With one of the four samples, k, as the base
//   2 l_k G = sum over i != k of C_i Q_i,   C_i = C_i + m_i.w exactly,   Q_i = l_i l_k |u_i - u_k|^2 -> Q_i + d_i.w + w^T B_i w + r,  |r| <= r_i(s).
// For any q, m'_i = m_i - C_i q, the sum divided by 1 + q.w is at least F + g.w + w^T A w - N(s) for |w| <= s; and for every t >= 0 with M = 2 A + t I positive
// definite that is at least F - g^T M^-1 g / 2 - t s^2 / 2 - N(s).
//
// q and t are found in doubles: any will do. What is said with them is computed in enclosures.
#include "reference/motion/delaunay_ball_form.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "reference/motion/enclosure.h"
#include "reference/motion/largest_double.h"

namespace clues::reference {
namespace {

using Matrix = std::array<EnclosedVector, 3>;

Enclosure dot(const EnclosedVector& a, const EnclosedVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// factor times the symmetric part of left right^T.
void add(Matrix& sum, const Enclosure& factor, const EnclosedVector& left, const EnclosedVector& right) {
  const Enclosure half = Enclosure(mpq_class(1, 2)) * factor;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] = sum[i][j] + half * (left[i] * right[j] + left[j] * right[i]);
  }
}

void add_identity(Matrix& sum, const Enclosure& factor) {
  for (std::size_t i = 0; i < 3; ++i) sum[i][i] = sum[i][i] + factor;
}

Enclosure power(const Enclosure& a, int n) { return n == 1 ? a : a * power(a, n - 1); }

// One of the four.
struct Seat {
  const DepthSample* sample;
  exact::RationalVector x;
  Enclosure l;
  EnclosedVector u;
  mpq_class cofactor;
  exact::RationalVector gradient;
};

// Q of a pair: what the theorem's table says of it. Numbers without a sign are absolute values.
struct Pair {
  bool points = false, moves = false;
  Enclosure value, slope_length, second;  // Q, |d|, a bound of |B|
  EnclosedVector slope;
  Enclosure turn, difference, curvature, chord, clear;  // |D|, |L|, c, |e|, h
  Enclosure li, lk;  // of two points; of a point and a direction first that of the point

  // r(s), for s less than the lengths of points.
  Enclosure rest(const Enclosure& s) const {
    if (!moves) return 0;
    static const Enclosure third = Enclosure(1) / (Enclosure(3) * root(Enclosure(3)));
    const Enclosure cube = s * s * s;
    if (!points) return Enclosure(2) * third * lk * cube / square(li - s);
    Enclosure p = third * cube * (Enclosure(1) / square(li - s) + Enclosure(1) / square(lk - s));
    if (sgn((clear - s).low) > 0) {
      const Enclosure other = chord * cube / (Enclosure(2) * power(clear - s, 3));
      if (other.high < p.high) p = other;
    }
    const Enclosure first = turn * s, half = Enclosure(mpq_class(1, 2)) * curvature * s * s;
    return Enclosure(2) * first * half + square(half) + Enclosure(2) * p * (difference + first + half) + square(p);
  }
};

// The distance of the segment between two points from the viewpoint.
Enclosure distance_of_chord(const exact::RationalVector& a, const exact::RationalVector& b) {
  const auto e = exact::minus(a, b);
  const bool foot_between = exact::dot(a, e) > 0 && exact::dot(b, e) < 0;
  if (foot_between) return length(enclosed(exact::cross(a, b))) / length(enclosed(e));
  const mpq_class square_a = exact::dot(a, a), square_b = exact::dot(b, b);
  return root(Enclosure(std::min(square_a, square_b)));
}

// And factor * B into the sum.
Pair pair_of(const Seat& i, const Seat& k, Matrix& sum) {
  const bool i_moves = !i.sample->is_direction, k_moves = !k.sample->is_direction;
  const auto d = i.u - k.u;
  const Enclosure factor(i.cofactor);
  Pair p;
  p.moves = i_moves || k_moves;
  p.points = i_moves && k_moves;
  p.turn = length(d);
  p.li = i_moves ? i.l : k.l;
  p.lk = i_moves ? k.l : i.l;
  if (!p.points) {
    p.value = i.l * k.l * dot(d, d);
    if (!p.moves) return p;
    const Seat& point = i_moves ? i : k;
    p.slope = Enclosure(i_moves ? -2 : 2) * p.lk * d;
    p.second = p.lk / p.li;
    add_identity(sum, factor * p.second);
    add(sum, Enclosure(-1) * factor * p.second, point.u, point.u);
  } else {
    const auto e = exact::minus(i.x, k.x);
    // (x_i + x_k).e / (l_i + l_k): without the cancellation of l_i - l_k.
    const Enclosure l = Enclosure(exact::dot(exact::plus(i.x, k.x), e)) / (i.l + k.l);
    p.chord = length(enclosed(e));
    p.difference = absolute(l);
    p.value = Enclosure(exact::dot(e, e)) - square(l);
    p.slope = Enclosure(2) * l * d;
    const Enclosure flat = Enclosure(2) * p.chord / (i.l * k.l), round = Enclosure(1) / (i.l.low < k.l.low ? i.l : k.l);
    p.curvature = flat.high < round.high ? flat : round;
    p.clear = distance_of_chord(i.x, k.x);
    p.second = square(p.turn) + p.difference * p.curvature;
    add(sum, Enclosure(-1) * factor, d, d);
    add_identity(sum, Enclosure(-1) * factor * l * (Enclosure(1) / i.l - Enclosure(1) / k.l));
    add(sum, factor * l / i.l, i.u, i.u);
    add(sum, Enclosure(-1) * factor * l / k.l, k.u, k.u);
  }
  p.slope_length = length(p.slope);
  return p;
}

// Least squares of m_i - C_i q, in doubles; nothing where doubles cannot say it.
std::optional<exact::RationalVector> common_factor(const std::array<Seat, 4>& seats) {
  mpq_class squares = 0;
  exact::RationalVector sum;
  for (const Seat& s : seats) {
    squares += s.cofactor * s.cofactor;
    sum = exact::plus(sum, exact::times(s.gradient, s.cofactor));
  }
  if (sgn(squares) == 0) return std::nullopt;
  exact::RationalVector q;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = mpq_class(sum[i] / squares).get_d();
    if (!std::isfinite(x)) return std::nullopt;
    q[i] = x;
  }
  return q;
}

class BallForm {
 public:
  BallForm(const std::array<Seat, 4>& seats, std::size_t base, const exact::RationalVector& q)
      : q_(enclosed(q)), q_length_(length(q_)) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Seat& seat = seats[i];
      if (!seat.sample->is_direction && (!nearest_ || seat.l.low < *nearest_)) nearest_ = seat.l.low;
      if (i == base) continue;
      Term& t = terms_[n++];
      t.pair = pair_of(seat, seats[base], a_);
      const Enclosure factor(seat.cofactor);
      const auto own = enclosed(exact::minus(seat.gradient, exact::times(q, seat.cofactor)));
      t.cofactor = absolute(factor);
      t.own = length(own);
      value_ = value_ + factor * t.pair.value;
      g_ = g_ + factor * t.pair.slope + t.pair.value * own;
      add(a_, 1, own, t.pair.slope);
      add(a_, Enclosure(-1) * t.pair.value, own, q_);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      about_g_[i] = g_[i].low.get_d();
      for (std::size_t j = 0; j < 3; ++j) about_a_[i][j] = 2 * a_[i][j].low.get_d();
    }
  }

  bool holds(const mpq_class& radius) const {
    const Enclosure s(radius);
    if (!nearest_ || s.high >= *nearest_ || sgn((Enclosure(1) - q_length_ * s).low) <= 0) return false;
    const double t = best_t(radius.get_d());
    if (!(t >= 0) || !std::isfinite(t)) return false;
    Matrix m = a_;
    for (auto& row : m) row = Enclosure(2) * row;
    add_identity(m, Enclosure(mpq_class(t)));
    const auto minor = [&](std::size_t i, std::size_t j) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    EnclosedVector first_row{minor(0, 0), minor(0, 1), minor(0, 2)};
    const Enclosure det = dot(m[0], first_row);
    if (sgn(m[0][0].low) <= 0 || sgn(minor(2, 2).low) <= 0 || sgn(det.low) <= 0) return false;
    Enclosure fall;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) fall = fall + g_[i] * minor(i, j) * g_[j];
    }
    const Enclosure half(mpq_class(1, 2));
    return sgn((value_ - half * fall / det - half * Enclosure(mpq_class(t)) * s * s - rest(s)).low) >= 0;
  }

 private:
  struct Term {
    Pair pair;
    Enclosure cofactor, own;  // |C|, |m'|
  };

  // N(s).
  Enclosure rest(const Enclosure& s) const {
    Enclosure sum;
    for (const Term& t : terms_) {
      const Enclosure r = t.pair.rest(s), q = q_length_;
      sum = sum + t.cofactor * r +
            t.own * s * ((t.pair.second + q * t.pair.slope_length + square(q) * t.pair.value) * s * s + r) /
                (Enclosure(1) - q * s);
    }
    return sum;
  }

  // t for which -M^-1 g is as long as s: by halving, in doubles. It gets shorter with more t.
  double best_t(double s) const {
    double size = 0, slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      slope += about_g_[i] * about_g_[i];
      for (std::size_t j = 0; j < 3; ++j) size += about_a_[i][j] * about_a_[i][j];
    }
    double low = 0, high = 2 * std::sqrt(size) + std::sqrt(slope) / s;
    for (int n = 0; n < 60; ++n) {
      const double t = 0.5 * (low + high);
      auto m = about_a_;
      for (std::size_t i = 0; i < 3; ++i) m[i][i] += t;
      const auto minor = [&](std::size_t i, std::size_t j) {
        const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return m[a][c] * m[b][d] - m[a][d] * m[b][c];
      };
      const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double w = (minor(i, 0) * about_g_[0] + minor(i, 1) * about_g_[1] + minor(i, 2) * about_g_[2]) / det;
        square += w * w;
      }
      const bool enough = m[0][0] > 0 && minor(2, 2) > 0 && det > 0 && square <= s * s;
      (enough ? high : low) = t;
    }
    return high;
  }

  EnclosedVector q_;
  Enclosure q_length_, value_;
  EnclosedVector g_;
  Matrix a_;
  std::array<Term, 3> terms_;
  std::optional<mpq_class> nearest_;
  std::array<double, 3> about_g_{};
  std::array<std::array<double, 3>, 3> about_a_{};  // 2 A
};

}  // namespace

double ball_form(const Quadrangle& samples, const ExactViewpoint& v, double known) {
  std::array<Seat, 4> seats;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<const DepthSample*, 3> others{};  // by number: a sample may be there twice
    for (std::size_t j = 0; j < 3; ++j) others[j] = samples[j < i ? j : j + 1];
    const auto minor = exact::affine_determinant(others, v);
    const mpq_class sign = i % 2 == 0 ? -1 : 1;
    Seat& seat = seats[i];
    seat.sample = samples[i];
    seat.x = exact::seen(*samples[i], v);
    seat.l = length(enclosed(seat.x));
    seat.u = (Enclosure(1) / seat.l) * enclosed(seat.x);
    seat.cofactor = sign * minor.value;
    seat.gradient = exact::times(minor.gradient, sign);
  }
  double best = known;
  const auto factor = common_factor(seats);
  for (std::size_t base = 0; base < 4; ++base) {
    for (const bool with_factor : {true, false}) {
      if (with_factor && !factor) continue;
      const BallForm form(seats, base, with_factor ? *factor : exact::RationalVector{});
      // What is better by less than a 64th is not worth its questions.
      if (best > 0 && !form.holds(mpq_class(best) * mpq_class(65, 64))) continue;
      best = largest_short_double([&](const mpq_class& radius) { return form.holds(radius); }, best);
    }
  }
  return best;
}

}  // namespace clues::reference
