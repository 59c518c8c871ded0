// Every proposal is confirmed by check_witness: what is proposed cannot be wrong, only useless.
#include "validate/vectors/short_witness.h"

#include <array>
#include <vector>

#include "exact/complex/simple_point.h"
#include "exact/sight/witness.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Point3;

std::array<Point3, 3> corners_of(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {exact::to_exact(mesh.points[a]), exact::to_exact(mesh.points[b]), exact::to_exact(mesh.points[c])};
}

// The centre, and points three quarters and 15/16 of the way from it to each cell vertex.
std::vector<Point3> viewpoints(const exact::ConvexCell& cell) {
  std::vector<Point3> points{cell.center()};
  if (cell.dimension() == 0) return points;
  for (const int weight : {3, 15}) {
    for (const Point3& vertex : cell.vertices()) {
      points.push_back(exact::collapsed(CGAL::barycenter(cell.center(), FT(1), vertex, FT(weight))));
    }
  }
  return points;
}

std::vector<Point3> targets(const std::array<Point3, 3>& corners) {
  constexpr std::array<std::array<int, 3>, 10> weights{
      {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}, {6, 1, 1}, {1, 6, 1}, {1, 1, 6}, {7, 8, 1}, {1, 7, 8}, {8, 1, 7}, {5, 6, 5}}};
  std::vector<Point3> points;
  for (const auto& [i, j, k] : weights) {
    points.push_back(exact::collapsed(CGAL::barycenter(corners[0], FT(i), corners[1], FT(j), corners[2], FT(k))));
  }
  return points;
}

}  // namespace

std::optional<Witness> short_witness(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                     std::uint32_t triangle, bool fronts_only) {
  const auto corners = corners_of(mesh, triangle);
  const exact::Plane3 plane(corners[0], corners[1], corners[2]);
  const auto ends = targets(corners);
  for (const Point3& v : viewpoints(cell)) {
    const auto side = plane.oriented_side(v);
    const bool front = side == CGAL::ON_POSITIVE_SIDE;
    if (side == CGAL::ON_ORIENTED_BOUNDARY || (fronts_only && !front)) continue;
    for (const Point3& p : ends) {
      if (exact::check_witness(mesh, cell, triangle, front, v, p).valid) return Witness{triangle, front, v, p};
    }
  }
  return std::nullopt;
}

Witness shortened(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Witness& witness) {
  const auto corners = corners_of(mesh, witness.triangle);
  Witness best = witness;
  const auto valid = [&](const Point3& v, const Point3& p) {
    return exact::check_witness(mesh, cell, witness.triangle, witness.front, v, p).valid;
  };
  for (int level = 0; level < exact::kSimpleLevels; ++level) {
    const auto p = exact::simple_in_triangle(witness.p, corners, level);
    if (p && valid(best.v, *p)) {
      best.p = *p;
      break;
    }
  }
  if (cell.dimension() != 3) return best;  // rounding would leave the flat
  for (int level = 0; level < exact::kSimpleLevels; ++level) {
    const Point3 v(exact::simple_near(witness.v.x(), level), exact::simple_near(witness.v.y(), level),
                   exact::simple_near(witness.v.z(), level));
    if (valid(v, best.p)) {
      best.v = v;
      break;
    }
  }
  return best;
}

}  // namespace clues::validate
