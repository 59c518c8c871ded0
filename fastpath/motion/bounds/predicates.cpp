// D29: doubles first, whole numbers where they are unsure.
#include "fastpath/motion/bounds/predicates.h"

#include <cmath>

#include "exact/dials.h"
#include "exact/motion/constraints.h"
#include "scene/messages/error.h"

namespace clues::fastpath::motion {
namespace {

bool never_sure() { return exact::process_dials::is_on(exact::process_dials::unsure_doubles); }

exact::SightRow exact_row(const Seen& s, const MotionPoint& at) { return exact::sight_row(*s.sample, at); }

}  // namespace

Answer edge_length_filtered(const Row& a, const Row& b, double kappa) {
  if (!fits(a) || !fits(b)) return Answer::unsure;
  const double value = kappa * norm(cross(a.x, b.x)) - dot(a.x, b.x);
  return above(value, (kEdgeErrorOfKappa * std::fabs(kappa) + kEdgeError) * (a.length * b.length));
}

// The distance of p from the whole great circle is enough: det >= sine |a x b| |p|.
Answer separation_filtered(const Row& p, const Row& a, const Row& b, double sine) {
  if (!fits(p) || !fits(a) || !fits(b)) return Answer::unsure;
  const double all = a.length * b.length * p.length;
  const double low = determinant(a, b, p) - kDeterminantError * all;
  const double need = sine * ((norm(cross(a.x, b.x)) + kCrossError * (a.length * b.length)) * p.length);
  return low > need * (1 + 0x1p-40) ? Answer::yes : Answer::unsure;
}

void require_thresholds(const scene::MotionThresholds& thresholds) {
  if (!std::isfinite(thresholds.kappa) || !std::isfinite(thresholds.sigma)) {
    throw scene::Error(scene::ErrorCode::non_finite, "motion: a threshold is not finite");
  }
  if (thresholds.sigma < 0 || thresholds.sigma > 1) {
    throw scene::Error(scene::ErrorCode::bad_argument, "motion: sigma = sin^2(eps) has to be between 0 and 1");
  }
}

Constraints::Constraints(const scene::MotionThresholds& thresholds)
    : thresholds_(thresholds), sine_(std::sqrt(thresholds.sigma) * (1 + 0x1p-50)) {
  require_float_rules();
  require_thresholds(thresholds);
  if (std::fabs(thresholds.kappa) > 0x1p50) {
    throw scene::Error(scene::ErrorCode::bad_argument, "motion: kappa = cot(phi) is out of range; at most 2^50");
  }
}

int Constraints::facing(const Seen& a, const Seen& b, const Seen& c, const MotionPoint& at) {
  const Answer fast = never_sure() ? Answer::unsure : faces_filtered(*a.row, *b.row, *c.row);
  if (fast != Answer::unsure) return fast == Answer::yes ? 1 : -1;
  ++counts.exact;
  return exact::facing_sign(exact_row(a, at), exact_row(b, at), exact_row(c, at));
}

int Constraints::delaunay(const Seen& a, const Seen& b, const Seen& c, const Seen& d, const MotionPoint& at) {
  const Answer fast = never_sure() ? Answer::unsure : delaunay_filtered(*a.row, *b.row, *c.row, *d.row);
  if (fast != Answer::unsure) return fast == Answer::yes ? 1 : -1;
  ++counts.exact;
  return exact::delaunay_sign(exact_row(a, at), exact_row(b, at), exact_row(c, at), exact_row(d, at));
}

bool Constraints::edge_length(const Seen& a, const Seen& b, const MotionPoint& at) {
  const Answer fast = never_sure() ? Answer::unsure : edge_length_filtered(*a.row, *b.row, thresholds_.kappa);
  if (fast != Answer::unsure) return fast == Answer::yes;
  ++counts.exact;
  return exact::edge_length_holds(exact_row(a, at), exact_row(b, at), exact::ExactThresholds(thresholds_));
}

bool Constraints::separation(const Seen& p, const Seen& a, const Seen& b, const MotionPoint& at) {
  const Answer fast = never_sure() ? Answer::unsure : separation_filtered(*p.row, *a.row, *b.row, sine_);
  if (fast != Answer::unsure) return true;
  ++counts.exact;
  return exact::separation_holds(exact_row(p, at), exact_row(a, at), exact_row(b, at),
                                 exact::ExactThresholds(thresholds_));
}

bool Constraints::triangle(const Seen& a, const Seen& b, const Seen& c, const MotionPoint& at) {
  return facing(a, b, c, at) > 0 && edge_length(a, b, at) && edge_length(b, c, at) && edge_length(c, a, at) &&
         separation(a, b, c, at) && separation(b, c, a, at) && separation(c, a, b, at);
}

}  // namespace clues::fastpath::motion
