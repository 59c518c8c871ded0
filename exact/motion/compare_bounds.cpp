// The distances to the nearest violation, compared with sqrt(s^2). Facing: the determinant is affine in the viewpoint. Edge length: the
// boundary is the outer or inner sheet of a spindle torus (in the half plane through the edge: an arc of the circle on which the edge is seen
// under phi), or a cone when one end is a direction.
#include "exact/motion/compare_bounds.h"

#include "exact/motion/rational_vector.h"

namespace clues::exact {
namespace {

// What the comparison and the name of the branch both need.
struct Edge {
  RationalVector a, b;
  mpq_class a_square, b_square, p, area;  // area = |a x b|^2
  EdgeBranch branch = EdgeBranch::violated;

  Edge(const scene::DepthSample& first, const scene::DepthSample& second, const ExactViewpoint& v,
       const mpq_class& kappa)
      : a(seen(first, v)), b(seen(second, v)), a_square(dot(a, a)), b_square(dot(b, b)), p(dot(a, b)) {
    area = a_square * b_square - p * p;
    if (sgn(a_square) == 0 || sgn(b_square) == 0) return;
    if (sign_of_sum({root_of(kappa, area), as_root(-p)}) < 0) return;
    if (first.is_direction && second.is_direction) {
      branch = EdgeBranch::never_changes;
    } else if (first.is_direction || second.is_direction) {
      branch = sign_of_sum({as_root(kappa * p), root_of(1, area)}) >= 0 ? EdgeBranch::cone_side : EdgeBranch::cone_apex;
    } else {
      branch = end_is_nearest(kappa) ? EdgeBranch::end_point : EdgeBranch::tube;
    }
  }

  mpq_class length_square() const { return a_square + b_square - 2 * p; }

 private:
  // Beyond the centre of the circle, in the cone from it over the edge, the foot on the circle is on the far side of the axis.
  bool end_is_nearest(const mpq_class& kappa) const {
    if (sgn(kappa) <= 0) return false;
    const mpq_class along = abs(mpq_class((b_square - a_square) / 2));  // |(v - m).(b - a)|
    const mpq_class limit = kappa * (length_square() / 2 - along);
    return sgn(limit) >= 0 && area <= limit * limit;
  }
};

}  // namespace

int compare_facing_bound(const scene::DepthSample& a, const scene::DepthSample& b, const scene::DepthSample& c,
                         const ExactViewpoint& v, const mpq_class& s_squared) {
  const auto height = affine_determinant({&a, &b, &c}, v);
  if (sgn(height.value) <= 0) return -sgn(s_squared);
  const mpq_class steepness = dot(height.gradient, height.gradient);
  if (sgn(steepness) == 0) return 1;
  return cmp(mpq_class(height.value * height.value), mpq_class(s_squared * steepness));
}

int compare_edge_bound(const scene::DepthSample& a, const scene::DepthSample& b, const ExactViewpoint& v,
                       const ExactThresholds& thresholds, const mpq_class& s_squared) {
  const mpq_class& kappa = thresholds.kappa;
  const Edge edge(a, b, v, kappa);
  const mpq_class cosecant = 1 + kappa * kappa;  // 1 / sin^2(phi)
  switch (edge.branch) {
    case EdgeBranch::violated:
      return -sgn(s_squared);
    case EdgeBranch::never_changes:
      return 1;
    case EdgeBranch::end_point:
      return cmp(edge.a_square < edge.b_square ? edge.a_square : edge.b_square, s_squared);
    case EdgeBranch::tube: {
      // R - r against s: s against R first, then the squares of R - s and r.
      const mpq_class length = edge.length_square();
      if (4 * s_squared > length * cosecant) return -1;
      return sign_of_sum({as_root(s_squared - edge.p), root_of(kappa, edge.area),
                          root_of(-1, mpq_class(s_squared * length * cosecant))});
    }
    case EdgeBranch::cone_side: {
      // sin(phi) (kappa y_perp - y_par) against s, times |D|.
      const mpq_class& direction = a.is_direction ? edge.a_square : edge.b_square;
      return sign_of_sum(
          {root_of(kappa, edge.area), as_root(-edge.p), root_of(-1, mpq_class(s_squared * direction * cosecant))});
    }
    case EdgeBranch::cone_apex:
      return cmp(a.is_direction ? edge.b_square : edge.a_square, s_squared);
  }
  return -1;
}

EdgeBranch edge_branch(const scene::DepthSample& a, const scene::DepthSample& b, const ExactViewpoint& v,
                       const ExactThresholds& thresholds) {
  return Edge(a, b, v, thresholds.kappa).branch;
}

}  // namespace clues::exact
