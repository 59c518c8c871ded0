// T9, in a tighter form: how far the viewpoint may move before four samples can be cocircular.
//
// THE FORM. G = det4 of rows (x_i, l_i). Take u_k = x_k / l_k of one of the four rows, and from the last column u_k times the first three: the
// determinant stays, the entry of k becomes 0, and those of the others mu_i = l_i - u_k . x_i = l_i (1 - cos t_i), t_i the angle between i and k:
//     G = sum over i != k of C_i mu_i,    C_i the cofactors of the last column: linear in the viewpoint, with gradient m_i.
// C_i is of the order of the square of the angles and so is mu_i, and so are their changes: nothing is left to cancel, where the four
// l_i of T9 cancel to the second order.
//
// THE COMMON FACTOR. For any vector q let m'_i = m_i - C_i q, the part of each gradient that is not a change of all C_i by one factor, and |w| <= s, |q| s < 1.
// C_i(v+w) = C_i (1 + q.w) + m'_i.w, so that G(v+w) / (1 + q.w) has the sign of G and is
//     F(w) = sum_i C_i mu_i(v+w) + sum_i (m'_i.w) mu_i(v+w) / (1 + q.w),
// with F(0) = G(v) and the gradient g - G q there. By Taylor's theorem for the first sum, and |mu_i(v+w) - mu_i(v)| <= M_i s for the second,
//     F(w) >= G - |g - G q| s - Q(s) s^2,   Q(s) = sum_i ( |C_i| H_i(s) / 2 + |m'_i| (M_i(s) + |q| mu_i(v)) / (1 - |q| s) ),
// with g the gradient of G at v, and M_i, H_i bounds of the gradient and of the second derivatives of mu_i within s. Four samples of one plane have
// m'_i = 0 for one q: C_i is then the distance of the plane times an area. q is the one that makes sum |m'_i|^2 least.
//
// M AND H. Let e = |p_i - p_k| be how fast x_i x x_k can change, N = |x_i x x_k| at v, S = (N + e s) / ((l_i - s)(l_k - s)): the sine of t_i stays at
// most S, and t_i acute if it is at v and S < 1. Here S <= 1/2, so 1 - cos t_i <= V = 0.536 S^2 and |u_i - u_k| = 2 sin(t_i/2) <= 1.0353 S.
// Let T = (|l_i - l_k| + 1.0353 S s) / (l_k - s) >= |l_i / l_k - 1|, as the gradient of l_i - l_k is u_k - u_i. Then
//   two points:      grad mu = (u_k - u_i) + y / l_k for y the part of x_i across u_k: sin t (l_i/l_k - 1) across, 1 - cos t along: M = S T + V.
//                    For a unit vector w, c = u_k.w, b = w - c u_k, h = b.u_i, a = l_i / l_k:
//                    l_k mu'' = (1 - (c cos t + h)^2) / a - (1 - c^2)(2 - a cos t) + 2 c a h
//                             = (1-c^2) ((1-a)^2/a - a (1 - cos t)) + c^2 sin^2 t / a + 2 c h ((a-1)(a+1) + 1 - cos t) / a - h^2 / a
//                    with |h| <= |b| sin t, 2 |c| |b| <= 1, c^2 + |b|^2 = 1; what has 1 - c^2 or c^2 is a mean of its three values, two of one sign:
//                    H = (max(T^2 A, S^2 A + (1 + T) V) + S (T (2 + T) + V) A) / (l_k - s),  A = (l_k + s) / (l_i - s) >= 1/a.
//   k a direction:   mu = l_i - u_k.x_i, its gradient u_k - u_i, M = 1.0353 S; mu'' = (1 - (u_i.w)^2) / l_i: H = 1 / (l_i - s).
//   i a direction:   mu = l_i (1 - cos t) with l_i fixed: M = l_i S / (l_k - s), and u_k'' = -((1-c^2) u_k + 2 c b) / l_k^2: H = l_i (1 + S) / (l_k - s)^2.
//   two directions:  0. mu_i(v) = l_i (1 - cos t_i) <= l_i V in all cases.
// In S a row that is a direction has its length, N is |x_i x x_k|, and e is the length of the direction: how fast the product changes.
//
// THE BOUND. Q grows with s. So for any trial s0 the root r of G - |g - G q| s - Q(s0) s^2 is sound if r <= s0, and s0 is if r > s0. Trials come down from
// the root for less.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fastpath/motion/bounds.h"
#include "fastpath/motion/predicates.h"

namespace clues::fastpath::motion {
namespace {

// One i of the sum, as seen from the base k.
struct Term {
  bool i_moves, k_moves;
  double li, lk;              // lengths; used below with their errors of 4u (kUp, kDown)
  double cross, e;            // N and how fast it changes, rounded up
  double difference;          // |l_i - l_k|, rounded up
  double cofactor, gradient;  // |C_i|, |m'_i|, rounded up
};

// |C_i| H_i / 2 + |m'_i| (M_i + |q| l_i V) / (1 - |q| s); infinite where the angle may be above 30 degrees, or the viewpoint may reach a sample.
double remainder_of(const Term& t, double q, double s) {
  const double li = t.li * kDown - (t.i_moves ? s : 0), lk = t.lk * kDown - (t.k_moves ? s : 0);
  if (!(li > 0) || !(lk > 0)) return kInfinity;
  const double sine = (t.cross + t.e * s) / (li * lk);
  if (!(sine * kUp <= 0.5)) return kInfinity;
  const double versine = 0.536 * sine * sine;
  double m = 0, h = 0;
  if (t.i_moves && t.k_moves) {
    const double ratio = (t.difference + 1.0353 * sine * s) / lk;
    m = sine * ratio + versine;
    const double a = (t.lk * kUp + s) / li;
    h = (std::max(ratio * ratio * a, sine * sine * a + (1 + ratio) * versine) +
         sine * (ratio * (2 + ratio) + versine) * a) /
        lk;
  } else if (t.i_moves) {
    m = 1.0353 * sine;
    h = 1 / li;
  } else if (t.k_moves) {
    m = t.li * sine / lk;
    h = t.li * (1 + sine) / (lk * lk);
  }
  const double rest = 1 - q * s;
  if (!(rest > 0x1p-10)) return kInfinity;
  return 0.5 * t.cofactor * h + t.gradient * (m + q * (t.li * kUp) * versine) / rest;
}

// What both directions of a pair have in common.
struct PairOf {
  double cross, e, difference;
};

PairOf pair_of(const Row& i, const Row& k, const Vec& product) {
  const double error = 0x1p-50 * (i.length + k.length);
  PairOf p{norm(product) + kCrossError * (i.length * k.length), 0, std::fabs(i.length - k.length) + error};
  if (i.moves && k.moves) {
    p.e = norm(i.x - k.x) + error;
  } else if (i.moves || k.moves) {
    p.e = (i.moves ? k.length : i.length) * kUp;
  }
  return p;
}

double remainder_of(const std::array<Term, 3>& terms, double q, double s) {
  return ((remainder_of(terms[0], q, s) + remainder_of(terms[1], q, s)) + remainder_of(terms[2], q, s)) * kUp;
}

using Rows = std::array<const Row*, 4>;

// Cofactors of the last column and what they come from, in doubles. Pairs: ab ac ad bc bd cd.
struct Cofactors {
  std::array<Vec, 6> pair;       // x_i x x_j
  std::array<double, 4> value;   // C_i
  std::array<Vec, 4> gradient;   // m_i
  std::array<double, 4> triple;  // the other three lengths: their product,
  std::array<double, 4> twice;   // and the sum of those of two
};

Cofactors cofactors_of(const Row& a, const Row& b, const Row& c, const Row& d) {
  const Vec ab = cross(a.x, b.x), ac = cross(a.x, c.x), ad = cross(a.x, d.x), bc = cross(b.x, c.x),
            bd = cross(b.x, d.x), cd = cross(c.x, d.x);
  // C = (-det(b,c,d), det(a,c,d), -det(a,b,d), det(a,b,c)); its gradient is minus the sum of the products, each where the third row moves.
  const auto fall = [](const Row& p, const Row& q, const Row& r, const Vec& pq, const Vec& qr, const Vec& pr) {
    Vec sum;
    if (p.moves) sum = sum - qr;
    if (q.moves) sum = sum + pr;  // r x p = -(p x r)
    if (r.moves) sum = sum - pq;
    return sum;
  };
  Cofactors out{
      {ab, ac, ad, bc, bd, cd},
      {-dot(b.x, cd), dot(a.x, cd), -dot(a.x, bd), dot(a.x, bc)},
      {fall(b, c, d, bc, cd, bd), fall(a, c, d, ac, cd, ad), fall(a, b, d, ab, bd, ad), fall(a, b, c, ab, bc, ac)},
      {},
      {}};
  out.gradient[0] = -1.0 * out.gradient[0];
  out.gradient[2] = -1.0 * out.gradient[2];
  const double la = a.length, lb = b.length, lc = c.length, ld = d.length;
  out.triple = {lb * lc * ld, la * lc * ld, la * lb * ld, la * lb * lc};
  out.twice = {lb * lc + lc * ld + lb * ld, la * lc + lc * ld + la * ld, la * lb + lb * ld + la * ld,
               la * lb + lb * lc + la * lc};
  return out;
}

// The gradient of G.
Vec gradient_of(const Rows& rows, const Cofactors& c) {
  Vec g;
  for (std::size_t i = 0; i < 4; ++i) {
    g = g + rows[i]->length * c.gradient[i];
    if (rows[i]->moves) g = g - (c.value[i] / rows[i]->length) * rows[i]->x;
  }
  return g;
}

// q. Any is sound. Where gradients have little in common, or what they have is gone after a short way, none is better.
Vec common_factor(const Cofactors& c, double nearest) {
  Vec q;
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q = q + c.value[i] * c.gradient[i];
    squares += c.value[i] * c.value[i];
  }
  q = (squares > 0 ? 1 / squares : 0) * q;
  double before = 0, after = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec left = c.gradient[i] - c.value[i] * q;
    before += dot(c.gradient[i], c.gradient[i]);
    after += dot(left, left);
  }
  if (!(after < 0.1 * before) || !(norm(q) * nearest < 4)) q = {};
  return q;
}

// What is added up for Q, from the base with the least of it for short ways; `least` is infinite where there is none.
struct Remainder {
  std::array<Term, 3> terms{};
  double least = kInfinity;
};

Remainder least_remainder(const Rows& rows, const Cofactors& of, const Vec& q, double q_up, double near) {
  std::array<double, 4> cofactor_up{}, gradient_up{};
  for (std::size_t i = 0; i < 4; ++i) {
    cofactor_up[i] = std::fabs(of.value[i]) + kDeterminantError * of.triple[i];
    gradient_up[i] = norm(of.gradient[i] - of.value[i] * q) + 0x1p-48 * of.twice[i] +
                     q_up * (kDeterminantError * of.triple[i] + 0x1p-50 * std::fabs(of.value[i]));
  }
  const auto& [a, b, c, d] = rows;
  const std::array<PairOf, 6> pairs{pair_of(*a, *b, of.pair[0]), pair_of(*a, *c, of.pair[1]),
                                    pair_of(*a, *d, of.pair[2]), pair_of(*b, *c, of.pair[3]),
                                    pair_of(*b, *d, of.pair[4]), pair_of(*c, *d, of.pair[5])};
  constexpr std::array<std::array<std::size_t, 4>, 4> at{{{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
  Remainder out;
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<Term, 3> at_k{};
    bool acute = true;
    for (std::size_t i = 0, n = 0; i < 4; ++i) {
      if (i == k) continue;
      const Row &p = *rows[i], &base = *rows[k];
      const PairOf& pair = pairs[at[i][k]];
      acute = acute && dot(p.x, base.x) > kCrossError * (p.length * base.length);
      at_k[n++] = {p.moves, base.moves,      p.length,       base.length,   pair.cross,
                   pair.e,  pair.difference, cofactor_up[i], gradient_up[i]};
    }
    const double remainder = acute ? remainder_of(at_k, q_up, near) : kInfinity;
    if (remainder < out.least) {
      out.least = remainder;
      out.terms = at_k;
    }
  }
  return out;
}

// Where `value` falls to nothing, by trials that come down from the root for less; at most `most`.
double root_by_trials(const Remainder& q_of, double q_up, double value, double slope, double near, double most) {
  const auto root_for = [&](double remainder) {
    return 2 * value / (slope + std::sqrt(slope * slope + 4 * remainder * value));
  };
  const double first = root_for(q_of.least);
  double best = std::min(first, near), trial = std::min(first, most);
  for (int round = 0; round < 5 && trial > 1.05 * best; ++round) {
    const double root = root_for(remainder_of(q_of.terms, q_up, trial));
    best = std::max(best, std::min(root, trial));
    if (root >= trial) break;
    trial = std::sqrt(trial * std::max(best, 0.25 * trial));
  }
  return best;
}

}  // namespace

double delaunay_bound(const Row& a, const Row& b, const Row& c, const Row& d) {
  if (!fits(a) || !fits(b) || !fits(c) || !fits(d)) return 0;
  const Rows rows{&a, &b, &c, &d};
  const double computed = delaunay_value(a, b, c, d), all = (a.length * b.length) * (c.length * d.length);
  const double value = computed - kDelaunayError * all;
  if (!(value > 0)) return 0;
  if (!a.moves && !b.moves && !c.moves && !d.moves) return kInfinity;
  double nearest = kInfinity;
  for (const Row* r : rows) {
    if (r->moves) nearest = std::min(nearest, r->length);
  }
  const Cofactors cofactors = cofactors_of(a, b, c, d);
  const Vec g = gradient_of(rows, cofactors), q = common_factor(cofactors, nearest);
  const double q_up = norm(q) * kUp;
  // Errors: a product of two lengths times 16u for a gradient, of three times 9.3u for a cofactor (predicates.h). In g, each l_i m_i has products of three
  // lengths times 16u + 6u, each C_i u_i such with 10u + 8u, and there are six sums: below 48u for each of the products that
  // occur, each in three of the l_i m_i and one C_i u_i, 2^-46 altogether.
  // In g - G q: G as computed is wrong by kDelaunayError at most, the product and the difference by 4u of their terms; in m' = m - C q likewise.
  const std::array<double, 4>& triple = cofactors.triple;
  const double slope = (norm(g - computed * q) + 0x1p-46 * ((triple[0] + triple[1]) + (triple[2] + triple[3])) +
                        q_up * (kDelaunayError * all + 0x1p-50 * std::fabs(computed))) *
                           kUp +
                       0x1p-50 * norm(g);
  const double most = std::min(value / slope, 0.5 * nearest), near = std::min(most, 0x1p-5 * nearest);
  const Remainder remainder = least_remainder(rows, cofactors, q, q_up, near);
  if (!(remainder.least < kInfinity)) return 0;
  return root_by_trials(remainder, q_up, value, slope, near, most) * kDown;
}

}  // namespace clues::fastpath::motion
