// What a contour vertex x sees of the cell, by one sight line for each part that incident pieces cut it into.
//
// Let C be the directions from x to the inside of V, an open convex set. No wedge piece through x divides the space next to x along C, because V is on one side of its
// plane: so all of a part of C between arcs has one label. Arcs meet in their ends only. If none meets C there is one part. Otherwise a part is not all of
// C, so inside C there is a border of it: a stretch of an arc that it is on one side of. An arc meets C in one interval, because C is convex, and along
// the inside of that interval either side is in one part. So every part is on some side of an arc that meets C, and one direction beside the arc stands for it.
//
// If V is flat and x in its plane, C is an interval of a great circle instead. Where it is cut it has two sides: at arcs that cross it, and at the ends of arcs.
#include <algorithm>
#include <cmath>

#include "fastpath/visibility/wedges/apex.h"
#include "fastpath/visibility/wedges/star.h"

namespace clues::fastpath {

namespace {

using V = Vec3<Integer>;

bool is_zero(const V& v) { return v.x.sign() == 0 && v.y.sign() == 0 && v.z.sign() == 0; }

Integer absolute(const Integer& x) { return x.sign() < 0 ? Integer(-x) : x; }

// Where the way from a to b, on different sides of the plane through x with this normal, crosses it.
V crossing(const V& a, const V& b, const V& normal) {
  return absolute(dot(normal, b)) * a + absolute(dot(normal, a)) * b;
}

// Whether m lies strictly between two of the directions, less than a half turn apart; all in the plane with this normal.
bool inside(const V& m, const std::vector<V>& directions, const V& normal) {
  const auto ccw = [&](const V& u, const V& w) { return det_sign(normal, u, w) > 0; };
  return std::any_of(directions.begin(), directions.end(), [&](const V& u) {
    return ccw(u, m) &&
           std::any_of(directions.begin(), directions.end(), [&](const V& w) { return ccw(m, w) && ccw(u, w); });
  });
}

// The directions from x to V.
struct Cone {
  Cone(const LocalScene& scene, const ExactPoint& x) : edges(&scene.cell.edges) {
    for (const ExactPoint& s : scene.cell.vertices) corners.push_back(direction<Integer>(x, s));
    for (std::size_t i = 1; i < corners.size() && is_zero(normal); ++i) {
      for (std::size_t j = 0; j < i && is_zero(normal); ++j) normal = cross(corners[j], corners[i]);
    }
    flat = std::all_of(corners.begin(), corners.end(), [&](const V& c) { return dot(normal, c).sign() == 0; });
  }

  // What spans the part in a plane through x: corners in it, and where it crosses edges.
  std::vector<V> section(const V& plane) const {
    std::vector<V> found;
    for (const V& c : corners) {
      if (dot(plane, c).sign() == 0 && !is_zero(c)) found.push_back(c);
    }
    for (const auto& [i, j] : *edges) {
      const V &a = corners[static_cast<std::size_t>(i)], &b = corners[static_cast<std::size_t>(j)];
      if (dot(plane, a).sign() * dot(plane, b).sign() < 0) found.push_back(crossing(a, b, plane));
    }
    return found;
  }

  const std::vector<std::array<int, 2>>* edges;
  std::vector<V> corners;
  V normal{Integer(0), Integer(0), Integer(0)};  // of the plane that holds all of it, if it is flat
  bool flat = false;
};

// A direction strictly inside the arc from a to b and inside the cone, if there is one.
std::optional<V> common(const V& a, const V& b, const Cone& cone) {
  const V normal = cross(a, b);
  const auto side = [&](int s) {
    return std::any_of(cone.corners.begin(), cone.corners.end(),
                       [&](const V& c) { return dot(normal, c).sign() == s; });
  };
  if (!side(1) || !side(-1)) return std::nullopt;
  const std::vector<V> section = cone.section(normal), arc{a, b};
  // The common part is an interval between two of these. The sum of directions inside it keeps away from both.
  std::vector<V> ends = section;
  ends.insert(ends.end(), arc.begin(), arc.end());
  std::optional<V> found;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const V m = balanced_sum(ends[i], ends[j]);
      if (inside(m, arc, normal) && inside(m, section, normal)) found = found ? balanced_sum(*found, m) : m;
    }
  }
  return found;
}

}  // namespace

std::vector<ExactPoint> Apex::views_of_cell(const ExactPoint& inside_cell) const {
  const auto star = this->star<Integer>();
  const Cone cone(*scene_, *x_);
  const V nothing{Integer(0), Integer(0), Integer(0)};
  std::vector<V> bounds;
  for (const ApexSector& s : sectors_) bounds.push_back(normal_direction<Integer>(*s.plane));
  std::vector<V> found;
  // Beside a direction inside the cone, and still inside: for that matter on the same sides of the planes that bound it.
  const auto add = [&](const V& limit, const V& aside) {
    found.push_back(star.moved({limit, aside, nothing, {}}, [&](const V& m) {
      if (cone.flat) return inside(m, cone.corners, cone.normal);
      return std::all_of(bounds.begin(), bounds.end(),
                         [&](const V& h) { return dot(h, m).sign() == dot(h, limit).sign(); });
    }));
  };
  const auto cut = [&](const V& at) {  // of a flat cone
    if (!inside(at, cone.corners, cone.normal)) return;
    const V along = cross(cone.normal, at);
    add(at, along);
    add(at, -along);
  };
  // Sides that meet around a node inside the cone are of one part of it.
  const std::vector<int> part = star.joined_sides([&](const V& node) {
    return !cone.flat && std::all_of(bounds.begin(), bounds.end(), [&](const V& h) { return dot(h, node).sign() < 0; });
  });
  std::vector<bool> done(part.size(), false);
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const auto left = static_cast<std::size_t>(part[2 * i]), right = static_cast<std::size_t>(part[2 * i + 1]);
    if ((done[left] && done[right]) || !may_meet_cone(arcs_[i])) continue;
    const V a = star.to(scene_->points[arcs_[i].a]), b = star.to(scene_->points[arcs_[i].b]), normal = cross(a, b);
    if (!cone.flat) {
      const std::optional<V> m = common(a, b, cone);
      if (!m) continue;
      if (!done[left]) add(*m, normal);
      done[left] = true;
      if (!done[right]) add(*m, -normal);
      done[right] = true;
      continue;
    }
    const int at_a = dot(cone.normal, a).sign(), at_b = dot(cone.normal, b).sign();
    if (at_a == 0) cut(a);
    if (at_b == 0) cut(b);
    if (at_a * at_b < 0) cut(crossing(a, b, cone.normal));
  }
  if (found.empty()) found.push_back(star.to(inside_cell));
  // On an arc that lies in a flat cone nothing is seen.
  std::erase_if(found, [&](const V& d) { return star.is_on_arc(d); });

  std::vector<ExactPoint> points;
  const Point x = x_->estimate(), s = inside_cell.estimate();
  const double distance = std::max({std::abs(s[0] - x[0]), std::abs(s[1] - x[1]), std::abs(s[2] - x[2])});
  for (const V& d : found) points.push_back(point_towards(*x_, d, distance));
  return points;
}

// The directions into int V are those strictly in H+ of the facets of A(x), and convex: so what is free between two of them is in one part.
bool Apex::in_one_part(const ExactPoint& p, const ExactPoint& q) const {
  if (!flat_ &&
      std::any_of(sectors_.begin(), sectors_.end(), [&](const ApexSector& s) { return s.plane->side(p) >= 0; }))
    return false;
  return decide<Integer>([&]<class NT>() {
    const auto star = this->star<NT>();
    return star.is_free(star.to(p), star.to(q));
  });
}

bool Apex::may_meet_cone(const LocalArc& arc) const {
  // Not if its plane leaves V on one side, or both ends point away from V.
  const ExactPoint &a = scene_->points[arc.a], &b = scene_->points[arc.b];
  const auto& cell = scene_->cell.vertices;
  int above = 0, below = 0;
  for (const ExactPoint& s : cell) {
    const int o = orientation(*x_, a, b, s);
    above += o >= 0;
    below += o <= 0;
  }
  if (above == 0 || below == 0) return false;
  const Vec3<Interval> x = x_->approximate();
  Vec3<Interval> towards = cell.front().approximate() - x;
  for (std::size_t i = 1; i < cell.size(); ++i) towards = towards + (cell[i].approximate() - x);
  const bool away = dot(towards, a.approximate() - x).sup() < 0 && dot(towards, b.approximate() - x).sup() < 0;
  return !(away && std::all_of(cell.begin(), cell.end(),
                               [&](const ExactPoint& s) { return dot(towards, s.approximate() - x).inf() > 0; }));
}

bool Apex::sees_cell_in_one_part() const {
  return std::none_of(arcs_.begin(), arcs_.end(), [&](const LocalArc& arc) { return may_meet_cone(arc); });
}

}  // namespace clues::fastpath
