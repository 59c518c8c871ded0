#include "validate/area.h"

#include <cmath>

#include "exact/kernel.h"

namespace clues::validate {

double area_estimate(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto corner = [&](std::uint32_t i) { return exact::to_exact(mesh.points[i]); };
  return std::sqrt(CGAL::to_double(CGAL::squared_area(corner(a), corner(b), corner(c))));
}

}  // namespace clues::validate
