#include "reference/visibility/labels/corner.h"

#include <algorithm>
#include <vector>

#include "reference/visibility/wedges/local_star.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Vector3;

namespace {

// f with f * n > 0 for all of the first and f * v <= 0 for all of the second: the sum of the extreme ones among those that satisfy both, weakly. Each of these is normal to two of the
// vectors. Zero if there is none.
Vector3 separating(const std::vector<Vector3>& positive, const std::vector<Vector3>& others) {
  std::vector<Vector3> all = positive;
  all.insert(all.end(), others.begin(), others.end());
  Vector3 sum = CGAL::NULL_VECTOR;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3 n = CGAL::cross_product(all[i], all[j]);
      for (const Vector3& f : {n, -n}) {
        const bool weakly =
            std::none_of(positive.begin(), positive.end(),
                         [&](const Vector3& p) { return CGAL::is_negative(f * p); }) &&
            std::none_of(others.begin(), others.end(), [&](const Vector3& v) { return CGAL::is_positive(f * v); });
        if (weakly) sum = sum + f;
      }
    }
  }
  const bool strictly =
      std::all_of(positive.begin(), positive.end(), [&](const Vector3& p) { return CGAL::is_positive(sum * p); });
  return strictly ? sum : Vector3(CGAL::NULL_VECTOR);
}

}  // namespace

bool is_dark_corner(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t point,
                    const Vector3& d) {
  const LocalStar star = LocalStar::around_vertex(complex, point);
  try {
    const std::vector<int> face = star.face_of(d);
    std::vector<Vector3> to_cell;
    for (const exact::Point3& s : cell.vertices()) to_cell.push_back(s - complex.points[point]);
    const Vector3 f = separating(star.border_of(face), to_cell);
    // All arcs of the border are on the positive side. So is the face, or else it holds all of the other side.
    return f != CGAL::NULL_VECTOR && star.face_of(-f) != face;
  } catch (const scene::Error&) {  // no clean way to a piece: not known
    return false;
  }
}

bool closes_groove(const exact::Complex& complex, const exact::ConvexCell& cell, const std::vector<GrooveEnd>& ends,
                   const exact::Point3& q) {
  struct At {
    LocalStar star;
    std::vector<int> face;
  };
  std::vector<At> all;
  std::vector<Vector3> positive, others;
  try {
    for (const GrooveEnd& end : ends) {
      const exact::Point3& y = complex.points[end.point];
      const exact::Edge& e = complex.edges[end.edge];
      const Vector3 along = complex.points[e.a == end.point ? e.b : e.a] - y;
      const LocalStar star = LocalStar::around_vertex(complex, end.point);
      const std::vector<int> face = star.face_of(star.nudged(along, q - y));
      if (star.sides_at(along, face) != 2) return false;  // it comes to the chain outside of the groove, too
      for (const Vector3& n : star.border_of(face)) {
        if (!same_direction(n, along)) positive.push_back(n);
      }
      others.insert(others.end(), {along, -along});
      for (const exact::Point3& s : cell.vertices()) others.push_back(s - y);
      all.push_back({star, face});
    }
    const Vector3 f = separating(positive, others);
    return f != CGAL::NULL_VECTOR &&
           std::none_of(all.begin(), all.end(), [&](const At& at) { return at.star.face_of(-f) == at.face; });
  } catch (const scene::Error&) {  // as above
    return false;
  }
}

}  // namespace clues::reference
