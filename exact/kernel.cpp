// Exact numbers as text, and lazy numbers without their history (D1: coordinates are exact rationals).
#include "exact/kernel.h"

#include <CGAL/Fraction_traits.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace clues::exact {

std::string to_string_exact(const FT& x) {
  using Value = FT::Exact_type;
  using Traits = CGAL::Fraction_traits<Value>;
  Value value = x.exact();
  Traits::Numerator_type numerator;
  Traits::Denominator_type denominator;
  Traits::Decompose()(value, numerator, denominator);
  std::ostringstream text;
  text << numerator;
  if (denominator != Traits::Denominator_type(1)) {
    text << '/' << denominator;
  }
  return text.str();
}

double unit_of(const std::vector<Point3>& points) {
  double most = 0;
  for (const Point3& p : points) {
    const CGAL::Bbox_3 b = p.bbox();
    for (int i = 0; i < 3; ++i) most = std::max({most, std::fabs(b.min(i)), std::fabs(b.max(i))});
  }
  if (!(most > 0) || !std::isfinite(most)) return 1;
  const int exponent = std::ilogb(most);
  return std::abs(exponent) <= 64 ? 1 : std::ldexp(1.0, exponent);
}

// What knows its exact value has let go of its operands.
FT collapsed(const FT& x) {
  x.exact();
  return x;
}

Point3 collapsed(const Point3& p) {
  p.exact();
  return p;
}

namespace {

using Exact = Kernel::Exact_kernel;

Point3 leaf(Exact::Point_3&& p) {
  return Point3(new CGAL::Lazy_rep_0<Kernel::Approximate_kernel::Point_3, Exact::Point_3, Kernel::E2A>(std::move(p)));
}

Point3 zero_on_line(const Exact::Point_3& a, const Exact::Point_3& b, const Exact::FT& at_a, const Exact::FT& at_b) {
  const Exact::FT t = at_a / (at_a - at_b);
  return leaf(a + t * (b - a));
}

}  // namespace

Point3 rational_point(const FT::Exact_type& x, const FT::Exact_type& y, const FT::Exact_type& z) {
  return leaf({x, y, z});
}

Point3 crossing(const Plane3& h, const Point3& a, const Point3& b) {
  const Exact::Plane_3& plane = h.exact();
  const auto at = [&](const Exact::Point_3& p) -> Exact::FT {
    return plane.a() * p.x() + plane.b() * p.y() + plane.c() * p.z() + plane.d();
  };
  return zero_on_line(a.exact(), b.exact(), at(a.exact()), at(b.exact()));
}

Point3 zero_on_line(const Point3& a, const Point3& b, const FT& at_a, const FT& at_b) {
  return zero_on_line(a.exact(), b.exact(), at_a.exact(), at_b.exact());
}

}  // namespace clues::exact
