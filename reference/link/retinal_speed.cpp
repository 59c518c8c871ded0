#include "reference/link/retinal_speed.h"

#include <algorithm>
#include <array>
#include <optional>

namespace clues::reference {

using exact::FT;
using exact::Point3;
using exact::Vector3;

namespace {

FT squared_distance(const Point3& from, const Point3& a, const Point3& b) {
  const Vector3 along = b - a;
  const FT length = along.squared_length(), at = along * (from - a);
  if (at <= 0 || length == 0) return (from - a).squared_length();
  if (at >= length) return (from - b).squared_length();
  return CGAL::cross_product(along, from - a).squared_length() / length;
}

// The error that goes unseen at this speed; none: below the first row.
std::optional<double> error_at(const std::vector<scene::PerceptionRow>& curve, const FT& squared_speed) {
  std::optional<double> error;
  for (const scene::PerceptionRow& row : curve) {
    if (FT(row.speed) * FT(row.speed) <= squared_speed) error = row.error;
  }
  return error;
}

std::array<Point3, 3> corners_of(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  std::array<Point3, 3> out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = exact::to_exact(mesh.points[mesh.triangles[triangle][i]]);
  return out;
}

}  // namespace

FT squared_distance(const Point3& from, const Point3& a, const Point3& b, const Point3& c) {
  const Vector3 normal = CGAL::cross_product(b - a, c - a);
  const FT square = normal.squared_length();
  if (square > 0) {
    const auto inside = [&](const Point3& p, const Point3& q) {
      return CGAL::cross_product(q - p, from - p) * normal >= 0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) {
      const FT height = normal * (from - a);
      return exact::collapsed(height * height / square);
    }
  }
  return exact::collapsed(
      std::min({squared_distance(from, a, b), squared_distance(from, b, c), squared_distance(from, c, a)}));
}

FT squared_speed_bound(const MovingEye& eye, const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  std::array<Point3, 3> across;
  FT farthest(0);
  const auto corners = corners_of(mesh, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 r = corners[i] - eye.at;
    farthest = std::max(farthest, r.squared_length());
    across[i] = CGAL::ORIGIN + CGAL::cross_product(eye.velocity, r);
  }
  if (farthest == 0) return FT(0);
  return exact::collapsed(squared_distance(Point3(CGAL::ORIGIN), across[0], across[1], across[2]) /
                          (farthest * farthest));
}

std::size_t detail_unseen(const std::vector<scene::PerceptionRow>& curve, const MovingEye& eye,
                          const scene::TriangleMesh& mesh, std::uint32_t triangle, const std::vector<double>& errors) {
  const auto error = error_at(curve, squared_speed_bound(eye, mesh, triangle));
  if (!error) return 0;
  const FT t(*error), sine = t - t * t * t / 6;
  const auto corners = corners_of(mesh, triangle);
  const FT most = exact::collapsed(squared_distance(eye.at, corners[0], corners[1], corners[2]) * sine * sine);
  for (std::size_t detail = errors.size(); detail-- > 1;) {
    if (FT(errors[detail]) * FT(errors[detail]) <= most) return detail;
  }
  return 0;
}

}  // namespace clues::reference
