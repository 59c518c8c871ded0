#include "fastpath/contours/interval_drawing.h"

#include <algorithm>
#include <optional>

#include "fastpath/visibility/points/points.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

using scene::ContourPlane;
using scene::ContourPoint;

[[noreturn]] void refuse(const char* what) {
  throw scene::Error(scene::ErrorCode::malformed, std::string("contours: ") + what);
}

Interval hull_of(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}

Interval common(const Interval& a, const Interval& b) {
  const double low = std::max(a.inf(), b.inf()), high = std::min(a.sup(), b.sup());
  if (!(low <= high)) refuse("a point that is not in its triangle");
  return {low, high};
}

bool holds_zero(const Interval& x) { return !(x.inf() > 0) && !(x.sup() < 0); }

}  // namespace

Interval interval_of(const std::string& fraction) {
  Rational value;
  if (value.set_str(fraction, 10) != 0 || sgn(value.get_den()) == 0) refuse("a number that is no fraction p/q");
  value.canonicalize();
  const ExactPoint at(Exact3{value, Rational(0), Rational(0)});
  return at.approximate().x;
}

Box3 box_of(const scene::Point& p) { return {Interval(p[0]), Interval(p[1]), Interval(p[2])}; }

Box3 hull_of(const Box3& a, const Box3& b) { return {hull_of(a.x, b.x), hull_of(a.y, b.y), hull_of(a.z, b.z)}; }

SceneEdges::SceneEdges(const scene::TriangleMesh& mesh)
    : flat_(mesh.triangles.size(), false), edges_(mesh), users_(edges_.count()) {
  for (const std::uint32_t t : scene::degenerate_triangles(mesh)) flat_[t] = true;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3 && !flat_[t]; ++k) users_[edge(t, k)].push_back(t);
  }
}

SceneEdges::Beyond SceneEdges::beyond(std::uint32_t side, std::size_t k) const {
  const std::uint32_t triangle = side / 2;
  const auto& users = users_[edge(triangle, k)];
  if (users.size() != 2 || users[0] == users[1]) return {side, k};
  const std::uint32_t other = users[0] == triangle ? users[1] : users[0];
  std::size_t j = 0;
  while (edge(other, j) != edge(triangle, k)) ++j;
  const bool same_turn = runs_up(other, j) != runs_up(triangle, k);
  return {2 * other + (same_turn ? side % 2 : 1 - side % 2), j};
}

Box3 IntervalDrawings::corner(std::uint32_t point) const { return box_of(mesh_.points[point]); }

IntervalDrawings::PlaneBox IntervalDrawings::plane_of(const ContourPlane& plane, const scene::ContourCell& cell,
                                                      const std::vector<PlaneBox>& before) const {
  const auto point = [&](std::size_t i) { return corner(plane.points[i]); };
  const auto of_cell = [&](std::size_t i) { return box_of(cell.points[plane.cell[i]]); };
  const auto through = [](const Box3& a, const Box3& b, const Box3& c) { return PlaneBox{cross(b - a, c - a), a}; };
  switch (plane.kind) {
    case ContourPlane::Kind::edge:
      return through(point(0), point(1), of_cell(0));
    case ContourPlane::Kind::vertex:
      return through(point(0), of_cell(0), of_cell(1));
    case ContourPlane::Kind::triangle:
      return through(point(0), point(1), point(2));
    case ContourPlane::Kind::crossing:
      break;
  }
  const Box3 a = point(0), b = point(1);
  const Interval at_a = before[plane.crossed].value(a), at_b = before[plane.crossed].value(b);
  const Interval way = at_a - at_b;
  const Box3 x = holds_zero(way) ? hull_of(a, b) : a + Interval(at_a / way) * (b - a);
  return through(of_cell(0), of_cell(1), x);
}

Box3 IntervalDrawings::crossing_on(const Box3& a, const Box3& b, const PlaneBox& plane) {
  const Interval at_a = plane.value(a), at_b = plane.value(b), way = at_a - at_b;
  if (holds_zero(way)) {
    ++unbounded_;
    return hull_of(a, b);
  }
  const Interval part = at_a / way;
  return a + part * (b - a);
}

Box3 IntervalDrawings::place_of(const ContourPoint& point, const IntervalSide& side,
                                const std::vector<PlaneBox>& planes) {
  const auto at = [&](std::uint32_t p) { return side.points[p].at; };
  const Box3 triangle = hull_of(hull_of(at(0), at(1)), at(2));
  Box3 around = triangle, place = triangle;
  switch (point.kind) {
    case ContourPoint::Kind::on_edge: {
      const Box3 a = at(point.first), b = at((point.first + 1) % 3);
      around = hull_of(a, b);
      place = crossing_on(a, b, planes[point.second]);
      break;
    }
    case ContourPoint::Kind::on_segment: {
      const auto& ends = side.segments[point.first].ends;
      around = hull_of(at(ends[0]), at(ends[1]));
      place = crossing_on(at(ends[0]), at(ends[1]), planes[point.second]);
      break;
    }
    case ContourPoint::Kind::crossing: {
      // From corner 0: n . y = 0, one . y = p, other . y = q, by Cramer's rule.
      const Box3 from = at(0);
      const Vec3<Interval> n = cross(at(1) - from, at(2) - from);
      const PlaneBox &one = planes[point.first], &other = planes[point.second];
      const Vec3<Interval> across = cross(one.normal, other.normal);
      const Interval size = dot(n, across);
      if (holds_zero(size)) {
        ++unbounded_;
      } else {
        const Interval p = -one.value(from), q = -other.value(from);
        const Vec3<Interval> way = p * cross(other.normal, n) + q * cross(n, one.normal);
        place = from + Vec3<Interval>{way.x / size, way.y / size, way.z / size};
      }
      break;
    }
    case ContourPoint::Kind::again: {
      const auto& there = on_edges_[edges_.edge(side.side / 2, point.first)];
      if (point.second >= there.size()) refuse("a point that its edge of the scene does not have");
      place = there[point.second];
      break;
    }
    case ContourPoint::Kind::in_full:
      place = {interval_of(point.at[0]), interval_of(point.at[1]), interval_of(point.at[2])};
      break;
  }
  return {common(place.x, around.x), common(place.y, around.y), common(place.z, around.z)};
}

void IntervalDrawings::add(const scene::ContourCell& cell, int level) {
  std::vector<PlaneBox> planes;
  for (const ContourPlane& plane : cell.planes) planes.push_back(plane_of(plane, cell, planes));
  for (const scene::ContourSide& drawn : cell.sides) {
    const std::uint32_t triangle = drawn.side / 2;
    if (!edges_.has_area(triangle)) refuse("a side of a triangle that has no area");
    IntervalSide& side = sides_[drawn.side];
    side.side = drawn.side;
    for (std::size_t k = 0; k < 3 && side.points.size() < 3; ++k)
      side.points.push_back({corner(mesh_.triangles[triangle][k]), 0, 0});
    for (const ContourPoint& point : drawn.points) {
      DrawnBox box{place_of(point, side, planes), scene::lies_on(point), 0};
      if (box.lies_on != 0 && box.lies_on < 4) {
        auto& there = on_edges_[edges_.edge(triangle, box.lies_on - 1)];
        const auto known = scene::edge_that_gets(point) ? there.size() : point.second;
        box.place = static_cast<std::uint32_t>(2 + known);
        if (known == there.size()) there.push_back(box.at);
      }
      side.points.push_back(box);
    }
    for (const auto& ends : drawn.segments) side.segments.push_back({ends, level});
    side.bridges = drawn.bridges;
    for (const auto& block : drawn.blocks) side.blocks.push_back({block.edge, block.ends, level});
  }
}

}  // namespace clues::fastpath
