// The exact bounds, and T8: the separation bound.
//
// T8. Let P = p - v, N = a(v) x b(v) and C = det(a, b, p), all at v. If p is seen less than eps from the edge, it is seen less than eps from the
// great circle of the edge, so |C| < sin(eps) |P| |N|. Moving v by w with |w| = s changes C by gradient.w, |P| by at most s (not at all when p
// is a direction), and N by w x (a - b) (by w x D when one end is a direction, not at all when both are). So while
//   C - |gradient| s >= sin(eps) (|P| + p1 s) (|N| + n1 s),    p1 = 0 or 1, n1 = |b - a|, |D| or 0,
// there is no violation. Left falls and right grows with s, so that what holds for s holds for all that is smaller.
#include "reference/motion/bounds.h"

#include "reference/motion/enclosure.h"
#include "reference/motion/largest_double.h"

namespace clues::reference {

double facing_bound(const DepthSample& a, const DepthSample& b, const DepthSample& c, const ExactViewpoint& v) {
  return largest_double(
      [&](const mpq_class& radius) { return exact::compare_facing_bound(a, b, c, v, radius * radius) >= 0; });
}

double edge_bound(const DepthSample& a, const DepthSample& b, const ExactViewpoint& v,
                  const ExactThresholds& thresholds) {
  return largest_double(
      [&](const mpq_class& radius) { return exact::compare_edge_bound(a, b, v, thresholds, radius * radius) >= 0; });
}

double separation_bound(const DepthSample& a, const DepthSample& b, const DepthSample& p, const ExactViewpoint& v,
                        const ExactThresholds& thresholds) {
  const auto height = exact::affine_determinant({&a, &b, &p}, v);
  if (sgn(height.value) <= 0) return 0;
  const auto to_a = exact::seen(a, v), to_b = exact::seen(b, v);
  const Enclosure steepness = length(enclosed(height.gradient));
  const Enclosure sine = root(Enclosure(thresholds.sigma));
  const Enclosure to_p = length(enclosed(exact::seen(p, v)));
  const Enclosure normal = length(enclosed(exact::cross(to_a, to_b)));
  Enclosure normal_growth;
  if (!a.is_direction && !b.is_direction) normal_growth = length(enclosed(exact::minus(to_b, to_a)));
  if (a.is_direction && !b.is_direction) normal_growth = length(enclosed(to_a));
  if (b.is_direction && !a.is_direction) normal_growth = length(enclosed(to_b));
  return largest_double([&](const mpq_class& radius) {
    const Enclosure s{radius};
    const Enclosure farthest = p.is_direction ? to_p : to_p + s;
    return sgn((height.value - steepness * s - sine * farthest * (normal + normal_growth * s)).low) >= 0;
  });
}

}  // namespace clues::reference
