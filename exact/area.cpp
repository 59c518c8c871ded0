#include "exact/area.h"

#include <cmath>

namespace clues::exact {

double area_estimate(const Point3& a, const Point3& b, const Point3& c) {
  const double unit = unit_of({a, b, c});  // so that the square is a double too
  const Vector3 twice = CGAL::cross_product((b - a) / unit, (c - a) / unit);
  return std::sqrt(CGAL::to_double(twice.squared_length())) / 2 * unit * unit;
}

}  // namespace clues::exact
