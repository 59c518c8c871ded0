// D2 in rationals.
#include "fastpath/predicates/exact_cell.h"

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

std::shared_ptr<const ExactCell> make_exact_cell(const std::vector<std::vector<Point>>& facets) {
  auto cell = std::make_shared<ExactCell>();
  for (const auto& p : facets) cell->bounds.push_back(through(cross(between(p[0], p[1]), between(p[0], p[2])), p[0]));
  return cell;
}

}  // namespace clues::fastpath
