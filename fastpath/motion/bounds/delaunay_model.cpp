// With g the slope and A the second order, for w = d u + e in t B, that is 0 <= d <= t and |e| <= y = t tail + d (head - tail):
//     g.w + w^T A w >= d (g.u) + d^2 min(0, u^T A u) - 2 d |A u| y - sinks y^2 - |g| y,     -sinks <= 0 below all eigenvalues of A.
// As y is linear in d, this is concave in d, and its least value is at d = 0 or at d = t. What is returned was put into this inequality, with the rest and
// with room for rounding: nothing hangs on how it was found.
#include "fastpath/motion/bounds/delaunay_model.h"

#include <algorithm>

#include "fastpath/motion/bounds/bounds.h"

namespace clues::fastpath::motion {
namespace {

// The least positive root of value - b t - c t^2; value > 0, c >= 0.
double root_of(double value, double b, double c) {
  const double root = std::sqrt(b * b + 4 * c * value);
  return b + root > 0 ? 2 * value / (b + root) : kInfinity;
}

}  // namespace

// Each coordinate of step - d u is within 3 * 2^-53 of |step|, or of the least double, and the step as computed within 2^-53 of it. Where squares underflow 2^-500 makes
// up for it.
double gauge_up(const Gauge& gauge, const Vec& step) {
  const double length = norm(step) * kUp;
  const double d = std::max(0.0, dot(step, gauge.u));
  const double away = norm(step - d * gauge.u) * kUp + 0x1p-49 * length + 0x1p-500;
  return std::max(d, (away - (gauge.head - gauge.tail) * d * kDown) / gauge.tail) * kUp;
}

Reaches::Reaches(const DelaunayModel& model)
    : model_(model), slope_(norm(model.slope)), size_(model.second.frobenius()) {
  // Of three numbers with the sum 0 and the sum of squares x^2, none is below -sqrt(2/3) x.
  const double third = (model.second.xx + model.second.yy + model.second.zz) / 3;
  Symmetric rest = model.second;
  rest.add_identity(-third);
  sinks_ = std::max(0.0, 0.81649659 * rest.frobenius() - third);
}

Reaches::Falls Reaches::falls(const Gauge& gauge) const {
  const Vec by_u = model_.second.times(gauge.u);
  const double along = dot(model_.slope, gauge.u), bend = std::min(0.0, dot(by_u, gauge.u)), twist = norm(by_u);
  return {gauge.tail * slope_, gauge.tail * gauge.tail * sinks_, gauge.head * slope_ - along,
          gauge.head * (gauge.head * sinks_ + 2 * twist) - bend};
}

double Reaches::guess(const Gauge& gauge) const {
  const Falls f = falls(gauge);
  return std::min({model_.up_to, root_of(model_.value, f.b_tail, f.c_tail), root_of(model_.value, f.b_head, f.c_head)});
}

double Reaches::of(const Gauge& gauge) const {
  const DelaunayModel& m = model_;
  if (m.value == kInfinity) return kInfinity;
  if (!(m.value > 0)) return 0;
  const Falls f = falls(gauge);
  const double length = gauge.u.x == 0 && gauge.u.y == 0 && gauge.u.z == 0 ? 1 : 1 + gauge.head;
  // What is left is concave in t. Newton's method comes down to its root; the chord of the rest up to there gives a t below it.
  double most =
      std::min({m.up_to / length, root_of(m.value, f.b_tail, f.c_tail), root_of(m.value, f.b_head, f.c_head)});
  for (int round = 0; round < 3; ++round) {
    const double s = most * length, slower = m.value - rest(s);
    const double grows = length * (m.slope_error + s * (2 * m.second_error + 3 * s * m.third));
    const double tail = slower - most * (f.b_tail + most * f.c_tail);
    const double head = slower - most * (f.b_head + most * f.c_head);
    if (std::min(tail, head) >= 0) break;
    most +=
        tail < head ? tail / (f.b_tail + 2 * most * f.c_tail + grows) : head / (f.b_head + 2 * most * f.c_head + grows);
  }
  if (!(most > 0)) return 0;
  const double chord = rest(most * length) / most;
  const double t = (1 - 0x1p-20) * std::min({most, root_of(m.value, f.b_tail + chord, f.c_tail),
                                             root_of(m.value, f.b_head + chord, f.c_head)});
  // Sums in doubles are within 2^-47 of the sum of the absolute values.
  const double s = t * length * kUp, sum = m.value + slope_ * s + 4 * size_ * s * s;
  const double lost = rest(s) * kUp + 0x1p-44 * sum;
  const double tail = m.value - t * (f.b_tail + t * f.c_tail), head = m.value - t * (f.b_head + t * f.c_head);
  return t > 0 && s <= m.up_to && std::min(tail, head) > lost ? t : 0;
}

}  // namespace clues::fastpath::motion
