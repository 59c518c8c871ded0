#include "validate/verdicts/area.h"

#include "exact/area.h"

namespace clues::validate {

double area_estimate(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto corner = [&](std::uint32_t i) { return exact::to_exact(mesh.points[i]); };
  return exact::area_estimate(corner(a), corner(b), corner(c));
}

}  // namespace clues::validate
