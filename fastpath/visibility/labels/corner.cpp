#include "fastpath/visibility/labels/corner.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "fastpath/visibility/points/integers.h"
#include "fastpath/visibility/wedges/star.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

namespace {

using V = Vec3<Integer>;

int side(const V& f, const V& d) { return dot(f, d).sign(); }

// f with f * n > 0 for all of the first and f * v <= 0 for all of the second: the sum of the extreme ones among those that satisfy both weakly, each normal to two of the vectors. Of most,
// intervals say that they do not.
std::optional<V> separating(const std::vector<V>& positive, const std::vector<V>& others) {
  std::vector<V> all = positive;
  all.insert(all.end(), others.begin(), others.end());
  std::vector<Vec3<Interval>> about;
  for (const V& v : all) about.push_back(around_multiple(v));
  const auto may_satisfy = [&](const Vec3<Interval>& f) {
    for (std::size_t i = 0; i < about.size(); ++i) {
      const Interval at = dot(f, about[i]);
      if (i < positive.size() ? at.sup() < 0 : at.inf() > 0) return false;
    }
    return true;
  };
  V sum{Integer(0), Integer(0), Integer(0)};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3<Interval> about_n = cross(about[i], about[j]);
      for (const int s : {1, -1}) {
        if (!may_satisfy(s > 0 ? about_n : -about_n)) continue;
        const V n = cross(all[i], all[j]), f = s > 0 ? n : -n;
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

bool closes_groove(const LocalScene& scene, std::span<const GrooveEnd> ends, const ExactPoint& q) {
  struct At {
    Star<Integer> star;
    std::vector<int> face;
  };
  std::vector<At> all;
  std::vector<V> positive, others;
  try {
    for (const GrooveEnd& end : ends) {
      const ExactPoint& y = scene.points[end.point];
      const LocalEdge& e = scene.edges[end.edge];
      const Star<Integer> star(scene, false, end.point, &y, arcs_around(scene, false, end.point));
      const V along = star.to(scene.points[e.a == end.point ? e.b : e.a]);
      const std::vector<int> face = star.face_of(star.moved({along, star.to(q), {}, {}}));
      if (star.sides_at(along, face) != 2) return false;  // it comes to the chain outside of the groove, too
      for (const V& n : star.border_of(face)) {
        if (!same_direction(n, along)) positive.push_back(n);
      }
      others.insert(others.end(), {along, -along});
      for (const ExactPoint& s : scene.cell.vertices) others.push_back(star.to(s));
      all.push_back({star, face});
    }
    const std::optional<V> f = separating(positive, others);
    return f && std::none_of(all.begin(), all.end(), [&](const At& at) { return at.star.face_of(-*f) == at.face; });
  } catch (const scene::Error& error) {
    if (error.code() != scene::ErrorCode::internal) throw;
    return false;
  }
}

}  // namespace clues::fastpath
