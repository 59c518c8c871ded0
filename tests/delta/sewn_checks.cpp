#include "sewn_checks.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace clues::test {

using reference::SewnMesh;

std::string SewnFlaws::text() const {
  return fmt::format("{} points in sides, {} unmatched edges, {} reversed triangles", points_in_sides, unmatched_edges,
                     reversed_triangles);
}

SewnFlaws flaws_of(const SewnMesh& mesh) {
  SewnFlaws flaws;
  using Step = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>;  // region, from, to
  std::map<Step, int> steps;
  std::map<std::uint64_t, exact::Vector3> normal;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++steps[{t.region, t.corners[i], t.corners[(i + 1) % 3]}];
    const auto &a = mesh.points[t.corners[0]], &b = mesh.points[t.corners[1]], &c = mesh.points[t.corners[2]];
    const exact::Vector3 n = CGAL::cross_product(b - a, c - a);
    const auto [at, fresh] = normal.emplace(t.region, n);
    if (!fresh && !CGAL::is_positive(at->second * n)) ++flaws.reversed_triangles;
    if (n == CGAL::NULL_VECTOR) ++flaws.reversed_triangles;
  }
  std::set<std::pair<std::uint64_t, std::uint64_t>> borders;
  for (const auto& [step, times] : steps) {
    const auto& [region, from, to] = step;
    if (times != 1) ++flaws.unmatched_edges;
    if (!steps.contains({region, to, from})) borders.insert(std::minmax(from, to));
  }
  for (const auto& [from, to] : borders) {
    const auto &a = mesh.points[from], &b = mesh.points[to];
    for (const auto& p : mesh.points) {
      if (CGAL::collinear(a, b, p) && CGAL::collinear_are_strictly_ordered_along_line(a, p, b)) ++flaws.points_in_sides;
    }
  }
  return flaws;
}

int euler_characteristic(const SewnMesh& mesh, std::uint64_t region) {
  std::set<std::uint64_t> corners;
  std::set<std::pair<std::uint64_t, std::uint64_t>> edges;
  int faces = 0;
  for (const auto& t : mesh.triangles) {
    if (t.region != region) continue;
    ++faces;
    for (std::size_t i = 0; i < 3; ++i) {
      corners.insert(t.corners[i]);
      edges.insert(std::minmax(t.corners[i], t.corners[(i + 1) % 3]));
    }
  }
  return static_cast<int>(corners.size()) - static_cast<int>(edges.size()) + faces;
}

}  // namespace clues::test
