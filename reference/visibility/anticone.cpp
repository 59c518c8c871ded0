// D12 by exact plane sides.
#include "reference/visibility/anticone.h"

#include <algorithm>

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

std::vector<AnticoneFacet> anticone_facets(const Point3& x, const exact::ConvexCell& cell) {
  std::vector<AnticoneFacet> facets;
  if (cell.contains(x)) return facets;
  const std::vector<Point3>& s = cell.vertices();
  std::vector<std::vector<int>> seen;  // touching sets already used: a cell facet seen edge-on is met once per edge
  for (const auto& [i, j] : cell.edges()) {
    const Point3 &p = s[static_cast<std::size_t>(i)], &q = s[static_cast<std::size_t>(j)];
    if (CGAL::collinear(x, p, q)) continue;
    std::vector<int> touching;
    bool above = false, below = false;
    for (std::size_t k = 0; k < s.size(); ++k) {
      const CGAL::Orientation o = CGAL::orientation(x, p, q, s[k]);
      above |= o == CGAL::POSITIVE;
      below |= o == CGAL::NEGATIVE;
      if (o == CGAL::COPLANAR) touching.push_back(static_cast<int>(k));
    }
    if (above && below) continue;
    if (std::find(seen.begin(), seen.end(), touching) != seen.end()) continue;
    seen.push_back(touching);
    // Plane3(x, p, q) has its positive side where orientation(x, p, q, .) is positive.
    std::vector<exact::Plane3> planes;
    if (!above) planes.emplace_back(x, p, q);
    if (!below) planes.emplace_back(x, q, p);
    for (const exact::Plane3& plane : planes) {
      // The extreme rays among the touching vertices; they span less than a half turn, because x is not in V.
      const Vector3 n = plane.orthogonal_vector();
      const auto turns_left = [&](const Vector3& u, const Vector3& w) {
        return CGAL::is_positive(n * CGAL::cross_product(u, w));
      };
      Vector3 first = x - s[static_cast<std::size_t>(touching.front())], last = first;
      for (const int k : touching) {
        const Vector3 w = x - s[static_cast<std::size_t>(k)];
        if (turns_left(w, first)) first = w;
        if (turns_left(last, w)) last = w;
      }
      facets.push_back({plane, first, last});
    }
  }
  return facets;
}

}  // namespace clues::reference
