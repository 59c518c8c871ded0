// T9, form 3: how far the viewpoint may move before four samples can be cocircular. docs/motion.md has the theorem with its proof; here it is in doubles.
//
// With one of the four, k, as the base: 2 l_k G = sum over i != k of C_i Q_i, C_i the cofactors of the lengths, linear in the viewpoint with gradients m_i, and
//     Q_i = 2 (l_i l_k - x_i.x_k) = l_i l_k |u_i - u_k|^2.
// For any vector q let m'_i = m_i - C_i q, and |q| s < 1. Divided by 1 + q.w the sum has the same sign, and for |w| <= s it is at least
//     F + g.w + w^T A w - N(s),     F = 2 l_k G,  g = sum (C_i d_i + Q_i m'_i),  A = sum (C_i B_i + sym(m'_i d_i^T - Q_i m'_i q^T)),
//     N(s) = sum |C_i| r_i + |m'_i| s ((b_i + |q| |d_i| + |q|^2 Q_i) s^2 + r_i) / (1 - |q| s),
// where Q_i changes by d_i.w + w^T B_i w and a rest of at most r_i(s), and |w^T B_i w| <= b_i s^2. With D = u_i - u_k, L = l_i - l_k, e = x_i - x_k:
//   two points:               d = 2 L D, B = -D D^T - L E with E the second derivative of L, |E| <= c = min(2 |e| / (l_i l_k), 1 / min(l_i, l_k)), b = |D|^2 + |L| c,
//                             r = |D| c s^3 + c^2 s^4 / 4 + 2 p (|L| + |D| s + c s^2 / 2) + p^2, p = s^3 min(|e| / (2 (h - s)^3), K / (l_i - s)^2 + K / (l_k - s)^2),
//                             h the distance of the line from x_i to x_k, K = 1 / (3 sqrt 3) = 0.19245...
//   a point, a direction z:   d = 2 |z| (u_z - u), B = |z| (I - u u^T) / l, b = |z| / l, r = 2 K |z| s^3 / (l - s)^2, l and u of the point.
//   two directions:           nothing changes.
// For every t >= 0 such that M = 2 A + t I is positive definite, g.w + w^T A w >= -g^T M^-1 g / 2 - t s^2 / 2 (complete the square). The best t is that for which the
// minimum, -M^-1 g, is as long as s; any is sound. N(s) / s^3 grows with s: with N(s0) / s0^3 in its place, what comes out is sound up to s0.
//
// Rounding. All points are scaled by one power of two and directions by one each, so that lengths are below 2; the bound is 0 where one is below 2^-40.
// Errors are absolute ones of C, m, Q, d and B, next to each; they are carried through the sums, and what is added up in doubles on the way is made up for by
// 2^-48 of the sum of the absolute values. N and its like are sums of numbers of one sign (bounds.h: kDown).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "fastpath/motion/bounds/bounds.h"
#include "fastpath/motion/bounds/delaunay_model.h"
#include "fastpath/motion/bounds/predicates.h"

namespace clues::fastpath::motion {
namespace {

constexpr double kThird = 0.192451;  // > 1 / (3 sqrt 3): a sixth of the largest 3 c (1 - c^2)
constexpr double kLeastScaled = 0x1p-40;

// Q of one i and the base as the viewpoint moves. Numbers without a sign are rounded up by their errors.
struct Change {
  double value = 0, value_error = 0;       // Q
  Vec slope;                               // d
  double slope_up = 0, slope_error = 0;    // |d|
  double second_up = 0, second_error = 0;  // b; error of B as a matrix
  bool points = false, moves = false;
  double turn = 0, difference = 0, curvature = 0, chord = 0, clear = 0;  // |D|, |L|, c, |e|, h (rounded down)
  // Lengths of points, rounded down; with one point only li, and lk is the length of the direction, rounded up.
  double li = 0, lk = 0;

  // r(s); infinite where the viewpoint may reach a sample.
  double rest(double s) const {
    if (!moves) return 0;
    const double ri = li - s;
    if (!(ri > 0x1p-4 * li)) return kInfinity;
    const double cube = s * s * s;
    if (!points) return 2 * kThird * lk * cube / (ri * ri);
    const double rk = lk - s, rh = clear - s;
    if (!(rk > 0x1p-4 * lk)) return kInfinity;
    double p = rh > 0 ? chord / (2 * rh * rh * rh) : kInfinity;
    if (p * std::min(ri * ri, rk * rk) > kThird) p = std::min(p, kThird * (1 / (ri * ri) + 1 / (rk * rk)));
    p *= cube;
    const double first = turn * s, second = 0.5 * curvature * s * s;
    return 2 * first * second + second * second + 2 * p * (difference + first + second) + p * p;
  }
};

struct Unit {
  const Row* row;
  double inverse;  // 1 / l
  Vec u;           // each coordinate within 8u, u = 2^-53
};

// D within 18u; Q = li lk |D|^2 within li lk (2^-47 |D| + 2^-94); L within 5u (li + lk); u u^T within 17u.
Change change_of(const Unit& i, const Unit& k, const Vec& product) {
  const Row &p = *i.row, &q = *k.row;
  Change c;
  const Vec d = i.u - k.u;
  const double d_norm = norm(d), lengths = p.length * q.length;
  c.turn = d_norm + 0x1p-48;
  c.value = lengths * dot(d, d);
  c.value_error = lengths * (0x1p-46 * d_norm + 0x1p-93);
  c.moves = p.moves || q.moves;
  c.points = p.moves && q.moves;
  if (c.points) {
    const double l = p.length - q.length, error = 0x1p-50 * (p.length + q.length);
    const Vec e = p.x - q.x;
    c.difference = std::fabs(l) + error;
    c.chord = norm(e) + error;
    c.curvature = std::min(2 * c.chord * (i.inverse * k.inverse), std::max(i.inverse, k.inverse)) * kUp;
    // The nearest point of the chord is an end of it, or that of the line.
    const double margin = 0x1p-46 * (p.length + q.length) * (p.length + q.length);
    const bool at_an_end = dot(p.x, e) < -margin || dot(q.x, e) > margin;
    c.clear = (at_an_end ? std::min(p.length, q.length) : (norm(product) - kCrossError * lengths) / c.chord) * kDown;
    c.slope = (2 * l) * d;
    c.slope_error = 2 * error * c.turn + 0x1p-47 * c.difference;
    c.slope_up = 2 * c.difference * c.turn;
    c.second_up = c.turn * c.turn + c.difference * c.curvature;
    c.second_error = 0x1p-46 * c.turn + error * c.curvature + 0x1p-46 * c.difference * (i.inverse + k.inverse);
    c.li = p.length * kDown;
    c.lk = q.length * kDown;
  } else if (c.moves) {
    const Row &point = p.moves ? p : q, &direction = p.moves ? q : p;
    c.slope = (p.moves ? -2 * direction.length : 2 * direction.length) * d;
    c.slope_error = 0x1p-46 * direction.length;
    c.slope_up = 2 * direction.length * c.turn * kUp;
    c.second_up = direction.length * (p.moves ? i : k).inverse * kUp;
    c.second_error = 0x1p-47 * c.second_up;
    c.li = point.length * kDown;
    c.lk = direction.length * kUp;
  }
  return c;
}

// B into the sum, times a cofactor.
void add_second(Symmetric& sum, double factor, const Unit& i, const Unit& k) {
  const Row &p = *i.row, &q = *k.row;
  if (p.moves && q.moves) {
    const double l = factor * (p.length - q.length);
    sum.add(-factor, i.u - k.u);
    sum.add_identity(l * (k.inverse - i.inverse));
    sum.add(l * i.inverse, i.u);
    sum.add(-l * k.inverse, k.u);
  } else if (p.moves || q.moves) {
    const Unit &point = p.moves ? i : k, &direction = p.moves ? k : i;
    const double f = factor * direction.row->length * point.inverse;
    sum.add_identity(f);
    sum.add(-f, point.u);
  }
}

// By a power of two: exact, below 2 for what is at most the largest.
Row scaled(const Row& r, double factor) {
  Row out = r;
  out.x = factor * r.x;
  out.length = factor * r.length;
  return out;
}

double power_of_two_below(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000ULL);
}

struct Term {
  Change change;
  double cofactor, own;  // |C|, |m'|, rounded up
};

// What is left of the sum after a way w of length at most s: F + g.w + w^T A w - N(s). Scaled.
struct Remainder {
  double unit = 1;     // 1 of a length here is this
  double nearest = 0;  // length of a row that moves
  double value = 0;    // F, rounded down; nothing is known where it is not positive, and infinite where nothing moves
  Vec g;
  double g_error = 0;
  Symmetric a;
  double a_error = 0, q = 0;  // |q|, rounded up
  std::array<Term, 3> terms;

  double rest(double s) const {  // N(s)
    const double remains = 1 - q * s;
    if (!(remains > 0x1p-10)) return kInfinity;
    double sum = 0;
    for (const Term& t : terms) {
      const double r = t.change.rest(s);
      const double q_value = q * (t.change.value + t.change.value_error);
      sum +=
          t.cofactor * r + t.own * s * ((t.change.second_up + q * (t.change.slope_up + q_value)) * s * s + r) / remains;
    }
    return sum;
  }
};

// The largest s for which it stays positive, nearly, from below.
double largest_ball(const Remainder& f, double farthest) {
  const double slope = norm(f.g), size = 2 * f.a.frobenius();
  const double along = slope > 0 ? f.a.form((1 / slope) * f.g) : 0;
  // A first trial, from what happens along g alone.
  const double four = slope * slope - 4 * along * f.value;
  double s = farthest;
  if (slope > 0) s = std::min(s, 2 * f.value / (slope + std::sqrt(std::max(0.0, four))));
  double t = s > 0 ? std::max(slope / s - 2 * along, 0.0) : 0, best = 0;
  double third = kInfinity, third_up_to = 0;  // N(s) <= third * s^3 for s so far
  for (int round = 0; round < 4; ++round) {
    if (s > third_up_to || s < 0.7 * third_up_to) {
      third = f.rest(s) / (s * s * s) * kUp;
      third_up_to = s;
      if (!(third < kInfinity)) {
        s *= 0.5;
        continue;
      }
    }
    // Positive definite by its leading minors, with room for rounding; else more t.
    Symmetric m, adjugate;
    double det = 0, norm_up = 0;
    for (int more = 0;; ++more) {
      t = std::max(t, 0x1p-240);
      m = {2 * f.a.xx + t, 2 * f.a.yy + t, 2 * f.a.zz + t, 2 * f.a.xy, 2 * f.a.xz, 2 * f.a.yz};
      norm_up = size + 2 * t;
      adjugate = {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
                  m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.xx * m.yz};
      det = m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz;
      if (m.xx > 0x1p-30 * norm_up && adjugate.zz > 0x1p-30 * norm_up * norm_up &&
          det > 0x1p-30 * norm_up * norm_up * norm_up) {
        break;
      }
      if (more == 6) return best;
      t = std::max(2 * t, 0.25 * (more + 1) * size);
    }
    const double inverse = 1 / det;
    const Vec w{(adjugate.xx * f.g.x + adjugate.xy * f.g.y + adjugate.xz * f.g.z) * inverse,
                (adjugate.xy * f.g.x + adjugate.yy * f.g.y + adjugate.yz * f.g.z) * inverse,
                (adjugate.xz * f.g.x + adjugate.yz * f.g.y + adjugate.zz * f.g.z) * inverse};
    // g^T M^-1 g, rounded up: the adjugate is within 2^-48 of norm^2, the determinant of norm^3.
    const double fall = (adjugate.form(f.g) + 0x1p-45 * (slope * slope) * (norm_up * norm_up)) /
                        (det - 0x1p-46 * norm_up * norm_up * norm_up);
    const double left = f.value - 0.5 * fall * kUp;
    const double second = 0.5 * t + (third * s + f.a_error + 0x1p-50 * norm_up);
    if (left > 0) {
      const double root = 2 * left / (f.g_error + std::sqrt(f.g_error * f.g_error + 4 * second * left));
      best = std::max(best, std::min(root, s));
    }
    // The next trial by Newton's method for the whole, and its t by Newton's method for the length of w.
    const double next = s + (left - (second * s + f.g_error) * s) / ((t + 3 * third * s) * s + f.g_error);
    s = std::min(std::clamp(next, 0.25 * s, 1.5 * s), farthest);
    if (!(s > 1.01 * best)) break;
    const double length = norm(w);
    t = std::max(0.0, t + (length / s - 1) * length * length / (adjugate.form(w) * inverse));
  }
  return best;
}

Remainder remainder_of(const Row& a_seen, const Row& b_seen, const Row& c_seen, const Row& d_seen) {
  Remainder f;
  const std::array<const Row*, 4> seen{&a_seen, &b_seen, &c_seen, &d_seen};
  double largest = 0;
  for (const Row* r : seen) {
    if (!fits(*r)) return f;
    if (r->moves) largest = std::max(largest, r->length);
  }
  const double unit = power_of_two_below(largest);
  std::array<Row, 4> rows;
  double nearest = kInfinity;
  for (std::size_t i = 0; i < 4; ++i) {
    const Row& r = *seen[i];
    rows[i] = scaled(r, 1 / (r.moves ? unit : power_of_two_below(r.length)));
    if (rows[i].length < kLeastScaled) return f;
    if (r.moves) nearest = std::min(nearest, rows[i].length);
  }
  const auto& [a, b, c, d] = rows;
  const double la = a.length, lb = b.length, lc = c.length, ld = d.length;
  const double value = delaunay_value(a, b, c, d) - kDelaunayError * ((la * lb) * (lc * ld));
  if (!(value > 0)) return f;
  if (largest == 0) {  // four directions
    f.value = kInfinity;
    return f;
  }
  f.unit = unit;
  f.nearest = nearest;

  const Vec ab = cross(a.x, b.x), ac = cross(a.x, c.x), ad = cross(a.x, d.x), bc = cross(b.x, c.x),
            bd = cross(b.x, d.x), cd = cross(c.x, d.x);
  // C = (-det(b,c,d), det(a,c,d), -det(a,b,d), det(a,b,c)); its gradient is minus the sum of the products, each where the third row moves.
  const std::array<double, 4> cofactor{-dot(b.x, cd), dot(a.x, cd), -dot(a.x, bd), dot(a.x, bc)};
  const auto fall = [](const Row& p, const Row& q, const Row& r, const Vec& pq, const Vec& qr, const Vec& pr) {
    Vec sum;
    if (p.moves) sum = sum - qr;
    if (q.moves) sum = sum + pr;  // r x p = -(p x r)
    if (r.moves) sum = sum - pq;
    return sum;
  };
  std::array<Vec, 4> m{fall(b, c, d, bc, cd, bd), fall(a, c, d, ac, cd, ad), fall(a, b, d, ab, bd, ad),
                       fall(a, b, c, ab, bc, ac)};
  m[0] = -1.0 * m[0];
  m[2] = -1.0 * m[2];
  // A product of two rows is within 7.2u of the product of their lengths, and there are three: 2^-48. A cofactor: predicates.h.
  const std::array<double, 4> triple{lb * lc * ld, la * lc * ld, la * lb * ld, la * lb * lc};
  const std::array<double, 4> twice{lb * lc + lc * ld + lb * ld, la * lc + lc * ld + la * ld,
                                    la * lb + lb * ld + la * ld, la * lb + lb * lc + la * lc};
  // q takes what all cofactors have in common, the distance of the plane if the four lie in one. Any is sound. Where gradients have little in common, or
  // what they have is gone after a short way, none is better.
  Vec q;
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q = q + cofactor[i] * m[i];
    squares += cofactor[i] * cofactor[i];
  }
  q = (squares > 0 ? 1 / squares : 0) * q;
  double before = 0, after = 0;
  std::array<Vec, 4> own;
  for (std::size_t i = 0; i < 4; ++i) {
    own[i] = m[i] - cofactor[i] * q;
    before += dot(m[i], m[i]);
    after += dot(own[i], own[i]);
  }
  if (!(after < 0.1 * before) || !(norm(q) * nearest < 4)) {
    q = {};
    own = m;
  }
  const double q_up = norm(q) * kUp;
  f.q = q_up;

  // The base: the one with the largest cofactor, which drops out.
  std::size_t k = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (std::fabs(cofactor[i]) * rows[i].length > std::fabs(cofactor[k]) * rows[k].length) k = i;
  }
  std::array<Unit, 4> units;
  for (std::size_t i = 0; i < 4; ++i) {
    const double inverse = 1 / rows[i].length;
    units[i] = {&rows[i], inverse, inverse * rows[i].x};
  }
  const std::array<const Vec*, 6> products{&ab, &ac, &ad, &bc, &bd, &cd};
  constexpr std::array<std::array<std::size_t, 4>, 4> at{{{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};

  f.value = 2 * rows[k].length * value * kDown;
  for (std::size_t i = 0, n = 0; i < 4; ++i) {
    if (i == k) continue;
    const double c_error = kDeterminantError * triple[i];
    const double m_error = 0x1p-48 * twice[i] + q_up * (c_error + 0x1p-50 * std::fabs(cofactor[i]));
    const Change change = change_of(units[i], units[k], *products[at[i][k]]);
    const double c_up = std::fabs(cofactor[i]) + c_error, m_up = norm(own[i]) + m_error;
    f.g = f.g + cofactor[i] * change.slope + change.value * own[i];
    f.g_error += c_up * change.slope_error + c_error * change.slope_up + m_up * change.value_error +
                 m_error * change.value + 0x1p-48 * (c_up * change.slope_up + m_up * change.value);
    add_second(f.a, cofactor[i], units[i], units[k]);
    f.a.add(own[i], change.slope - change.value * q);
    const double with_m = change.slope_up + q_up * (change.value + change.value_error);
    f.a_error += c_up * change.second_error + c_error * change.second_up +
                 m_up * (change.slope_error + q_up * change.value_error) + m_error * with_m +
                 0x1p-48 * (c_up * change.second_up + m_up * with_m);
    f.terms[n++] = {change, c_up, m_up};
  }
  return f;
}

}  // namespace

double delaunay_bound(const Row& a, const Row& b, const Row& c, const Row& d) {
  const Remainder f = remainder_of(a, b, c, d);
  if (!(f.value > 0) || f.value == kInfinity) return std::max(f.value, 0.0);
  return largest_ball(f, 0.9 * f.nearest) * f.unit * kDown;
}

DelaunayModel delaunay_model(const Row& a, const Row& b, const Row& c, const Row& d) {
  const Remainder f = remainder_of(a, b, c, d);
  DelaunayModel model;
  model.value = f.value;
  if (!(f.value > 0) || f.value == kInfinity) return model;
  // About where the rest is as large as the value: ways beyond are of no use. Any power near a third will do, and roots are the same everywhere.
  double third = 0;
  for (const Term& t : f.terms) third += t.cofactor * t.change.turn * t.change.curvature + t.own * t.change.second_up;
  const double fourth = std::sqrt(std::sqrt(f.value / (third + 0x1p-60 * f.value)));
  double up_to = std::min(fourth * std::sqrt(std::sqrt(fourth)), 0.5 * f.nearest), rest = f.rest(up_to);
  for (int halved = 0; halved < 4 && !(rest < kInfinity); ++halved) rest = f.rest(up_to *= 0.5);
  const double per = 1 / f.unit, squared = per * per;
  model.slope = per * f.g;
  model.second = f.a;
  model.second.scale(squared);
  model.slope_error = per * f.g_error;
  model.second_error = squared * f.a_error;
  model.third = squared * per * (rest / (up_to * up_to * up_to) * kUp);
  model.up_to = up_to * f.unit;
  return model;
}

}  // namespace clues::fastpath::motion
