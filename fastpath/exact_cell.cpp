// D2 in rationals. A flat cell lies in the planes `flats`; within them the bounds cut out its relative interior.
#include "fastpath/exact_cell.h"

#include <algorithm>

namespace clues::fastpath {
namespace {

using Vector = std::array<mpq_class, 3>;

Vector between(const Point& from, const Point& to) {
  return {mpq_class(to[0]) - mpq_class(from[0]), mpq_class(to[1]) - mpq_class(from[1]),
          mpq_class(to[2]) - mpq_class(from[2])};
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

ExactCell::Plane through(const Vector& normal, const Point& p) {
  return {normal, normal[0] * mpq_class(p[0]) + normal[1] * mpq_class(p[1]) + normal[2] * mpq_class(p[2])};
}

}  // namespace

std::shared_ptr<const ExactCell> make_exact_cell(int dimension, const std::vector<Point>& vertices,
                                                 const std::vector<std::vector<Point>>& polygons) {
  auto cell = std::make_shared<ExactCell>();
  const auto normal_of = [](const std::vector<Point>& p) { return cross(between(p[0], p[1]), between(p[0], p[2])); };
  if (dimension == 3) {
    for (const auto& polygon : polygons) cell->bounds.push_back(through(normal_of(polygon), polygon[0]));
  } else if (dimension == 2) {
    const std::vector<Point>& polygon = polygons[0];
    const Vector normal = normal_of(polygon);
    cell->flats.push_back(through(normal, polygon[0]));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point& p = polygon[i];
      cell->bounds.push_back(through(cross(between(p, polygon[(i + 1) % polygon.size()]), normal), p));
    }
  } else {
    const Vector along = between(vertices.front(), vertices.back());
    for (std::size_t i = 0; i < 3; ++i) {
      Vector axis;
      axis[i] = 1;
      cell->flats.push_back(through(dimension == 0 ? axis : cross(along, axis), vertices.front()));
    }
    if (dimension == 1) {
      const Vector back{mpq_class(-along[0]), mpq_class(-along[1]), mpq_class(-along[2])};
      cell->bounds = {through(back, vertices.front()), through(along, vertices.back())};
    }
  }
  return cell;
}

}  // namespace clues::fastpath
