// Exact numbers as text, and lazy numbers without their history (D1: coordinates are exact rationals).
#include "exact/kernel.h"

#include <CGAL/Fraction_traits.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

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

Point3 to_lazy(const RationalKernel::Point_3& p) {
  using Leaf = CGAL::Lazy_rep_0<Kernel::Approximate_kernel::Point_3, RationalKernel::Point_3, Kernel::E2A>;
  return Point3(new Leaf(p));
}

namespace {

using Rational = RationalKernel::FT;

Point3 zero_on_line(const RationalKernel::Point_3& a, const RationalKernel::Point_3& b, const Rational& at_a,
                    const Rational& at_b) {
  const Rational t = at_a / (at_a - at_b);
  return to_lazy(a + t * (b - a));
}

}  // namespace

Point3 crossing(const Plane3& h, const Point3& a, const Point3& b) {
  const RationalKernel::Plane_3& plane = h.exact();
  const auto at = [&](const RationalKernel::Point_3& p) -> Rational {
    return plane.a() * p.x() + plane.b() * p.y() + plane.c() * p.z() + plane.d();
  };
  return zero_on_line(a.exact(), b.exact(), at(a.exact()), at(b.exact()));
}

Point3 zero_on_line(const Point3& a, const Point3& b, const FT& at_a, const FT& at_b) {
  return zero_on_line(a.exact(), b.exact(), at_a.exact(), at_b.exact());
}

}  // namespace clues::exact
