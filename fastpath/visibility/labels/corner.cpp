#include "fastpath/visibility/labels/corner.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "fastpath/visibility/wedges/star.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

namespace {

using V = Vec3<Integer>;

int side(const V& f, const V& d) { return dot(f, d).sign(); }

// f with f * n > 0 for all of the first and f * v <= 0 for all of the second: the sum of the extreme ones among those that satisfy both weakly, each normal to two of the vectors.
std::optional<V> separating(const std::vector<V>& positive, const std::vector<V>& others) {
  std::vector<V> all = positive;
  all.insert(all.end(), others.begin(), others.end());
  V sum{Integer(0), Integer(0), Integer(0)};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const V n = cross(all[i], all[j]);
      for (const V& f : {n, -n}) {
        if (std::all_of(positive.begin(), positive.end(), [&](const V& p) { return side(f, p) >= 0; }) &&
            std::all_of(others.begin(), others.end(), [&](const V& v) { return side(f, v) <= 0; }))
          sum = sum + f;
      }
    }
  }
  if (!std::all_of(positive.begin(), positive.end(), [&](const V& p) { return side(sum, p) > 0; })) return std::nullopt;
  return sum;
}

}  // namespace

bool is_dark_corner(const LocalScene& scene, std::uint32_t point, const ExactPoint& q) {
  const ExactPoint& y = scene.points[point];
  const std::vector<LocalArc> arcs = arcs_around(scene, false, point);
  const Star<Integer> star(scene, false, point, &y, arcs);
  try {
    const std::vector<int> face = star.face_of(star.to(q));
    std::vector<V> to_cell;
    for (const ExactPoint& s : scene.cell.vertices) to_cell.push_back(star.to(s));
    const std::optional<V> f = separating(star.border_of(face), to_cell);
    // All arcs of the border are on the positive side. So is the face, or else it holds all of the other side.
    return f && star.face_of(-*f) != face;
  } catch (const scene::Error& error) {
    if (error.code() != scene::ErrorCode::internal) throw;
    return false;
  }
}

}  // namespace clues::fastpath
