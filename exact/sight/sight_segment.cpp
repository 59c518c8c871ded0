// One sight line against one closed triangle (D5).
#include "exact/sight/sight_segment.h"

#include <algorithm>

namespace clues::exact {
namespace {

// p + s (end - p) for 0 < s < 1 (s <= 1 when closed) against a triangle in the same plane: the line meets it in an interval of s.
bool blocks_in_plane(const std::array<Point3, 3>& t, const Point3& end, bool closed, const Point3& p) {
  const Vector3 normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  FT low(0), high(1);
  bool low_open = true, high_open = !closed;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 &a = t[i], &b = t[(i + 1) % 3];
    const Vector3 inward = CGAL::cross_product(normal, b - a);
    const FT at_p = CGAL::scalar_product(inward, p - a), slope = CGAL::scalar_product(inward, end - p);
    if (CGAL::is_zero(slope)) {
      if (CGAL::sign(at_p) == CGAL::NEGATIVE) return false;
      continue;
    }
    const FT s = -at_p / slope;
    if (CGAL::sign(slope) == CGAL::POSITIVE && s > low) {
      low = s;
      low_open = false;
    } else if (CGAL::sign(slope) == CGAL::NEGATIVE && s < high) {
      high = s;
      high_open = false;
    }
  }
  return low < high || (low == high && !low_open && !high_open);
}

}  // namespace

bool blocks(const std::array<Point3, 3>& t, const Point3& end, bool closed, const Point3& p) {
  const CGAL::Orientation at_p = CGAL::orientation(t[0], t[1], t[2], p);
  const CGAL::Orientation at_end = CGAL::orientation(t[0], t[1], t[2], end);
  if (at_p == CGAL::ZERO) return at_end == CGAL::ZERO && blocks_in_plane(t, end, closed, p);
  if (at_p == at_end || (at_end == CGAL::ZERO && !closed)) return false;
  bool left = false, right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const CGAL::Orientation o = CGAL::orientation(p, end, t[i], t[(i + 1) % 3]);
    left = left || o == CGAL::POSITIVE;
    right = right || o == CGAL::NEGATIVE;
  }
  return !(left && right);
}

}  // namespace clues::exact
