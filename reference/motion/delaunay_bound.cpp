// T9: how far the viewpoint may move before an edge can lose the local Delaunay property, from below. Three forms; all begin with the value
// at v and subtract what its derivatives can take away within distance s. The third one is in delaunay_ball_form.cpp.
//
// Form 1, for samples of any kind. G = sum C_i l_i over the four rows, C_i the signed determinant of the other three. C_i(v + w) = C_i + m_i.w
// exactly. For a point, u_i = x_i / l_i and  l_i - u_i.w <= l_i(v + w) <= l_i - u_i.w + |w|^2 / (2 l_i)  (square both sides); for a direction
// l_i stays, so that u_i and 1 / (2 l_i) are read as 0. Hence for |w| <= s
//   G(v + w) >= G - |g| s - (|M| + sum max(0, -C_i) / (2 l_i)) s^2 - sum |m_i| / (2 l_i) s^3,
// g = sum (l_i m_i - C_i u_i), |M| the Frobenius norm of the symmetric part of sum m_i u_i^T.
//
// Form 2, for four points. With x = p_d - v, e_i = p_i - p_d, the dual vectors k_a = e_b x e_c, k_b = e_c x e_a, k_c = e_a x e_b, K_i = -k_i.x and
// L_i = l_i - l_d:
//   2 l_d G = F = sum over a, b, c of K_i Q_i,   Q_i = |e_i|^2 - L_i^2 >= 0.
// For G = W l_d + sum K_i L_i with W = det(e_a, e_b, e_c) (subtract the row of d from the others), sum (k_i.x) e_i = W x because the k_i / W are the dual basis, so W l_d
// = u_d.(W x) = -sum K_i u_d.e_i, and (l_d + L_i)^2 = |x + e_i|^2 gives L_i - u_d.e_i = Q_i / (2 l_d). F has the sign of G, and its terms are as
// small as the quadrangle: no cancellation between large ones, so that the bound keeps its proportions when quadrangles get small.
// At v + w: K_i becomes K_i + k_i.w, and L_i becomes L_i - D_i.w + R, D_i = u_i - u_d, |R| <= rho_i = |e_i| s^2 / ((l_i - s)(l_d - s)) while s is less than
// all l: the second derivative of l is (I - u u^T) / l, and for lengths l <= l' of two points the difference is at most
// |1/l - 1/l'| + |u u^T - u' u'^T| / l' <= |e| / (l l') + 2 |e| / ((l + l') l') <= 2 |e| / (l l'). Multiplied out,
//   F(v + w) >= F - |g| s - |M| s^2 - sum { |k_i| |D_i|^2 s^3 + (|K_i| + |k_i| s) (2 (|L_i| + |D_i| s) rho_i + rho_i^2) },
// g = sum (Q_i k_i + 2 K_i L_i D_i), |M| the Frobenius norm of the symmetric part of sum (2 L_i k_i D_i^T - K_i D_i D_i^T).
// Each of the four points may be d (orders of the four that differ evenly leave G as it is); the best counts.
#include <algorithm>
#include <limits>

#include "reference/motion/bounds.h"
#include "reference/motion/delaunay_ball_form.h"
#include "reference/motion/enclosure.h"
#include "reference/motion/largest_double.h"

namespace clues::reference {
namespace {

// The sum of matrices factor * left right^T.
class MatrixSum {
 public:
  void add(const Enclosure& factor, const EnclosedVector& left, const EnclosedVector& right) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) entries_[i][j] = entries_[i][j] + factor * left[i] * right[j];
    }
  }
  // The Frobenius norm of its symmetric part: not less than what w^T M w can be for |w| = 1.
  Enclosure symmetric_norm() const {
    Enclosure sum;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        sum = sum + square(Enclosure(mpq_class(1, 2)) * (entries_[i][j] + entries_[j][i]));
      }
    }
    return root(sum);
  }

 private:
  std::array<std::array<Enclosure, 3>, 3> entries_;
};

double general_form(const Quadrangle& q, const ExactViewpoint& v, double known) {
  Enclosure value, second, third;
  EnclosedVector gradient;
  MatrixSum matrix;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<const DepthSample*, 3> others{};  // by number: a sample may be there twice
    for (std::size_t j = 0; j < 3; ++j) others[j] = q[j < i ? j : j + 1];
    const auto minor = exact::affine_determinant(others, v);
    const mpq_class sign = i % 2 == 0 ? -1 : 1;
    const Enclosure factor = mpq_class(sign * minor.value);
    const auto slope = enclosed(exact::times(minor.gradient, sign));
    const auto x = enclosed(exact::seen(*q[i], v));
    const Enclosure l = length(x);
    value = value + factor * l;
    gradient = gradient + l * slope;
    if (q[i]->is_direction) continue;
    const auto u = (Enclosure(1) / l) * x;
    const Enclosure curvature = Enclosure(mpq_class(1, 2)) / l;
    gradient = gradient - factor * u;
    matrix.add(1, slope, u);
    if (sgn(factor.low) < 0) second = second + absolute(factor) * curvature;
    third = third + length(slope) * curvature;
  }
  const Enclosure first = length(gradient);
  second = second + matrix.symmetric_norm();
  const auto holds = [&](const mpq_class& radius) {
    const Enclosure s{radius};
    return sgn((value - s * (first + s * (second + s * third))).low) >= 0;
  };
  return largest_double(holds, known);
}

double quadrangle_form(const Quadrangle& q, const ExactViewpoint& v, double known) {
  const auto x = exact::seen(*q[3], v);
  const Enclosure l_d = length(enclosed(x));
  const auto u_d = (Enclosure(1) / l_d) * enclosed(x);
  std::array<exact::RationalVector, 3> e;
  for (std::size_t i = 0; i < 3; ++i) e[i] = exact::minus(exact::seen(*q[i], v), x);
  struct Side {
    Enclosure l, e, k, height, difference, turn;  // l_i, |e_i|, |k_i|, |K_i|, |L_i|, |D_i|
  };
  std::array<Side, 3> sides;
  Enclosure value;
  EnclosedVector gradient;
  MatrixSum matrix;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto dual = exact::cross(e[(i + 1) % 3], e[(i + 2) % 3]);
    const auto k = enclosed(dual);
    const Enclosure height = mpq_class(-exact::dot(dual, x));
    const auto to = enclosed(exact::plus(x, e[i]));
    const Enclosure l = length(to);
    // (2 x + e).e / (l_i + l_d): without the cancellation of l_i - l_d.
    const exact::RationalVector twice = exact::plus(exact::plus(x, x), e[i]);
    const Enclosure difference = Enclosure(exact::dot(twice, e[i])) / (l + l_d);
    const Enclosure gap = Enclosure(exact::dot(e[i], e[i])) - square(difference);
    const auto turn = (Enclosure(1) / l) * to - u_d;
    value = value + height * gap;
    gradient = gradient + gap * k + (Enclosure(2) * height * difference) * turn;
    matrix.add(Enclosure(2) * difference, k, turn);
    matrix.add(Enclosure(-1) * height, turn, turn);
    sides[i] = {l, length(enclosed(e[i])), length(k), absolute(height), absolute(difference), length(turn)};
  }
  const Enclosure first = length(gradient), second = matrix.symmetric_norm();
  const mpq_class nearest = std::min({l_d.low, sides[0].l.low, sides[1].l.low, sides[2].l.low});
  const auto holds = [&](const mpq_class& radius) {
    const Enclosure s{radius};
    if (s.high >= nearest) return false;
    Enclosure rest = value - s * (first + s * second);
    for (const auto& side : sides) {
      const Enclosure rho = side.e * s * s / ((side.l - s) * (l_d - s));
      rest = rest - side.k * square(side.turn) * s * s * s -
             (side.height + side.k * s) * rho * (Enclosure(2) * (side.difference + side.turn * s) + rho);
    }
    return sgn(rest.low) >= 0;
  };
  return largest_double(holds, known);
}

bool stands_on(const Quadrangle& q, const ExactViewpoint& v) {
  return std::any_of(q.begin(), q.end(), [&](const auto* s) { return sgn(exact::sight_row(*s, v).square) == 0; });
}

bool all_points(const Quadrangle& q) {
  return std::none_of(q.begin(), q.end(), [](const auto* sample) { return sample->is_direction; });
}

// All even orders: each of the four is last once.
double best_quadrangle_form(const Quadrangle& q, const ExactViewpoint& v, double best) {
  for (const Quadrangle& order : {q, Quadrangle{q[1], q[0], q[3], q[2]}, Quadrangle{q[2], q[3], q[0], q[1]},
                                  Quadrangle{q[3], q[2], q[1], q[0]}}) {
    best = quadrangle_form(order, v, best);
  }
  return best;
}

}  // namespace

DelaunayForms delaunay_forms(const DepthSample& a, const DepthSample& b, const DepthSample& c, const DepthSample& d,
                             const ExactViewpoint& v) {
  const Quadrangle q{&a, &b, &c, &d};
  DelaunayForms forms;
  if (stands_on(q, v)) return forms;
  forms.general = general_form(q, v, 0);
  if (all_points(q)) forms.quadrangle = best_quadrangle_form(q, v, 0);
  forms.ball = ball_form(q, v, 0);
  return forms;
}

double delaunay_bound(const DepthSample& a, const DepthSample& b, const DepthSample& c, const DepthSample& d,
                      const ExactViewpoint& v) {
  const Quadrangle q{&a, &b, &c, &d};
  if (stands_on(q, v)) return 0;
  const int sign = exact::delaunay_sign(exact::sight_row(a, v), exact::sight_row(b, v), exact::sight_row(c, v),
                                        exact::sight_row(d, v));
  if (sign < 0) return 0;
  if (a.is_direction && b.is_direction && c.is_direction && d.is_direction) {
    return std::numeric_limits<double>::infinity();
  }
  const double ball = ball_form(q, v, 0);
  return general_form(q, v, all_points(q) ? best_quadrangle_form(q, v, ball) : ball);
}

}  // namespace clues::reference
