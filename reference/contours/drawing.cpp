#include "reference/contours/drawing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "scene/mesh/mesh_edges.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point2;
using exact::Point3;
using Segment2 = exact::Kernel::Segment_2;
using scene::ContourPoint;
using scene::PointPair;

[[noreturn]] void refuse(const std::string& what) {
  throw scene::Error(scene::ErrorCode::malformed, "contours: " + what);
}

FT fraction_of(const std::string& text) {
  mpq_class value;
  if (value.set_str(text, 10) != 0 || sgn(value.get_den()) == 0) refuse("a coordinate in full is no fraction p/q");
  value.canonicalize();
  return FT(FT::Exact_type(value.get_mpq_t()));
}

// Where a plane crosses the way from a to b.
Point3 crossing_on(const Point3& a, const Point3& b, const Plane3& plane) {
  const FT at_a = exact::value_at(plane, a), at_b = exact::value_at(plane, b);
  if (at_a == at_b || CGAL::sign(at_a) * CGAL::sign(at_b) > 0) refuse("a plane does not cross the line of its point");
  return exact::zero_on_line(a, b, at_a, at_b);
}

}  // namespace

DrawnSide::DrawnSide(const scene::TriangleMesh& mesh, std::uint32_t triangle)
    : frame_(frame_of(mesh, triangle)), plane_(frame_.corners()[0], frame_.corners()[1], frame_.corners()[2]) {
  for (const Point3& corner : frame_.corners()) points_.push_back({corner, frame_.frame()(corner), 0});
}

bool DrawnSide::on_edge(std::size_t k, const Point2& p) const {
  return CGAL::collinear(points_[k].flat, points_[(k + 1) % 3].flat, p);
}

std::uint32_t DrawnSide::add_point(const Point3& at, std::uint32_t lies_on) {
  points_.push_back({at, frame_.frame()(at), lies_on});
  return static_cast<std::uint32_t>(points_.size() - 1);
}

template <class Test>
bool DrawnSide::all_lines(const Test& test) const {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!test(Segment2(points_[k].flat, points_[(k + 1) % 3].flat))) return false;
  }
  return std::all_of(segments_.begin(), segments_.end(),
                     [&](const PointPair& s) { return test(Segment2(points_[s[0]].flat, points_[s[1]].flat)); });
}

bool DrawnSide::is_free(const Point2& p, const Point2& q) const {
  const Segment2 way(p, q);
  return all_lines([&](const Segment2& line) {
    if (!CGAL::do_intersect(way, line)) return true;
    // Where one end lies on the line, and the other not in its direction, they have that end in common.
    const bool along =
        CGAL::collinear(line.source(), line.target(), p) && CGAL::collinear(line.source(), line.target(), q);
    return !along && (line.has_on(p) || line.has_on(q));
  });
}

bool DrawnSide::is_clear(const Point2& p, const Point2& q) const {
  const Segment2 way(p, q);
  return all_lines([&](const Segment2& line) { return !CGAL::do_intersect(way, line); });
}

std::vector<PointPair> DrawnSide::bridges() const {
  std::vector<std::uint32_t> first(points_.size());
  std::iota(first.begin(), first.end(), 0U);
  const auto root = [&first](std::uint32_t i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    first[high] = low;
  };
  std::vector<bool> used(points_.size(), false);
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const std::uint32_t lies_on = points_[p].lies_on;
    used[p] = p < 3 || lies_on != 0;
    if (p < 3 || (lies_on != 0 && lies_on < 4)) join(0, p);
    if (lies_on >= 4) join(segments_[lies_on - 4][0], p);
  }
  for (const PointPair& s : segments_) {
    join(s[0], s[1]);
    used[s[0]] = used[s[1]] = true;
  }
  std::vector<PointPair> out;
  for (;;) {
    // From the first part that does not hang on the triangle, the shortest way to anything else that is free.
    std::uint32_t loose = 0;
    while (loose < points_.size() && (!used[loose] || root(loose) == 0)) ++loose;
    if (loose == points_.size()) return out;
    const std::uint32_t part = root(loose);
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> ways;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      if (!used[p] || root(p) != part) continue;
      for (std::uint32_t q = 0; q < points_.size(); ++q) {
        if (!used[q] || root(q) == part) continue;
        const auto d = points_[q].flat - points_[p].flat;
        ways.emplace_back(std::hypot(CGAL::to_double(d.x()), CGAL::to_double(d.y())), p, q);
      }
    }
    std::sort(ways.begin(), ways.end());
    const auto way = std::find_if(ways.begin(), ways.end(), [&](const auto& w) {
      return is_free(points_[std::get<1>(w)].flat, points_[std::get<2>(w)].flat);
    });
    // A triangulation of the drawing has such a way.
    if (way == ways.end()) throw scene::Error(scene::ErrorCode::internal, "contours: a drawing cannot be bridged");
    out.push_back({std::get<1>(*way), std::get<2>(*way)});
    join(out.back()[0], out.back()[1]);
  }
}

Drawings::Drawings(const scene::TriangleMesh& mesh)
    : mesh_(&mesh), number_(scene::numbers_of_places(mesh)), flat_(mesh.triangles.size(), false) {
  for (const std::uint32_t t : scene::degenerate_triangles(mesh)) flat_[t] = true;
}

DrawnSide& Drawings::on(std::uint32_t side) {
  if (const auto at = sides_.find(side); at != sides_.end()) return at->second;
  if (side / 2 >= flat_.size() || flat_[side / 2]) refuse("a side of a triangle that has no area");
  return sides_.emplace(side, DrawnSide(*mesh_, side / 2)).first->second;
}

std::vector<Point3>& Drawings::on_scene_edge(std::uint32_t triangle, std::size_t k) {
  const auto& corners = mesh_->triangles[triangle];
  return edges_[std::minmax({number_[corners[k]], number_[corners[(k + 1) % 3]]})];
}

Point3 Drawings::place_of(const ContourPoint& point, std::uint32_t side, const PlaneTable& planes) {
  const DrawnSide& drawn = on(side);
  switch (point.kind) {
    case ContourPoint::Kind::on_edge:
      return crossing_on(drawn.points()[point.first].at, drawn.points()[(point.first + 1) % 3].at,
                         planes.plane(point.second));
    case ContourPoint::Kind::crossing: {
      const auto met = CGAL::intersection(drawn.plane(), planes.plane(point.first), planes.plane(point.second));
      const auto* p = met ? boost::get<Point3>(&*met) : nullptr;
      if (p == nullptr) refuse("two planes do not cross in a point of their triangle");
      return exact::collapsed(*p);
    }
    case ContourPoint::Kind::on_segment: {
      const PointPair& s = drawn.segments()[point.first];
      return crossing_on(drawn.points()[s[0]].at, drawn.points()[s[1]].at, planes.plane(point.second));
    }
    case ContourPoint::Kind::again: {
      const auto& there = on_scene_edge(side / 2, point.first);
      if (point.second >= there.size()) refuse("a point that its edge of the scene does not have");
      return there[point.second];
    }
    case ContourPoint::Kind::in_full:
      break;
  }
  return {fraction_of(point.at[0]), fraction_of(point.at[1]), fraction_of(point.at[2])};
}

void Drawings::add(const scene::ContourCell& cell) {
  const PlaneTable planes = planes_of(cell, *mesh_);
  for (const scene::ContourSide& side : cell.sides) {
    DrawnSide& drawn = on(side.side);
    for (const ContourPoint& point : side.points) {
      const Point3 at = place_of(point, side.side, planes);
      if (!drawn.plane().has_on(at) ||
          drawn.frame().flat().bounded_side(drawn.frame().frame()(at)) == CGAL::ON_UNBOUNDED_SIDE)
        refuse("a point that is not in its triangle");
      drawn.add_point(at, lies_on(point));
      if (const auto edge = scene::edge_that_gets(point)) on_scene_edge(side.side / 2, *edge).push_back(at);
    }
    for (const PointPair& segment : side.segments) drawn.add_segment(segment);
    for (const auto& block : side.blocks) {
      for (const std::uint32_t p : block.ends) {
        if (!drawn.on_edge(block.edge, p)) refuse("a stretch of an edge that does not lie on it");
      }
    }
  }
}

PlaneTable planes_of(const scene::ContourCell& cell, const scene::TriangleMesh& mesh) {
  std::vector<Point3> corners;
  for (const scene::Point& p : cell.points) corners.push_back(exact::to_exact(p));
  PlaneTable planes(mesh, std::move(corners));
  for (const scene::ContourPlane& plane : cell.planes) planes.add(plane);
  return planes;
}

Point2 place_of(const scene::ContourSeed& seed, const TriangleFrame& frame) {
  const auto& flat = frame.flat();
  std::array<FT, 2> at;
  for (std::size_t i = 0; i < 2; ++i)
    at[i] = seed.bits == 0 ? fraction_of(seed.fractions[i])
                           : FT(static_cast<double>(seed.at[i]) / std::ldexp(1.0, static_cast<int>(seed.bits)));
  return flat[0] + (flat[1] - flat[0]) * at[0] + (flat[2] - flat[0]) * at[1];
}

}  // namespace clues::reference
