#include "validate/certificates/point_query.h"

#include <algorithm>

#include "exact/complex/complex_internal.h"
#include "exact/sight/witness.h"
#include "scene/messages/error.h"

namespace clues::validate {
namespace {

using exact::Plane3;
using exact::Point2;
using exact::Point3;

// Whether p, a point of the rings' plane, lies in the closed region.
bool in_region(const reference::Region& region, const Plane3& plane, const Point3& p) {
  const int axis = exact::dominant_axis(plane.orthogonal_vector());
  const Point2 q = exact::drop_axis(p, axis);
  bool odd = false;
  for (const auto& ring : region.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = exact::drop_axis(ring[i], axis), b = exact::drop_axis(ring[(i + 1) % ring.size()], axis);
      const CGAL::Orientation turn = CGAL::orientation(a, b, q);
      if (turn == CGAL::COLLINEAR && CGAL::collinear_are_ordered_along_line(a, q, b)) return true;
      const bool a_above = a.y() > q.y(), b_above = b.y() > q.y();
      if (a_above != b_above) odd ^= turn == (b_above ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN);
    }
  }
  return odd;
}

}  // namespace

PointQuery::PointQuery(const scene::TriangleMesh& mesh, const reference::Omega& omega, const CGAL::Bbox_3& bounds)
    : mesh_(mesh), omega_(omega), labels_(omega, bounds), visible_regions_(mesh.triangles.size()) {
  for (const scene::Triangle& t : mesh.triangles) {
    corners_.push_back(
        {exact::to_exact(mesh.points[t[0]]), exact::to_exact(mesh.points[t[1]]), exact::to_exact(mesh.points[t[2]])});
    const auto& [a, b, c] = corners_.back();
    planes_.push_back(CGAL::collinear(a, b, c) ? std::optional<Plane3>() : Plane3(a, b, c));
  }
  const reference::VisibilityMap& map = omega.map();
  for (std::uint32_t i = 0; i < map.regions.size(); ++i) {
    const reference::Region& r = map.regions[i];
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins)
      visible_regions_[o.triangle][r.front == o.same_side].push_back(i);
  }
}

// Only triangles that are known to matter are put to the oracle: it answers with a sight line that misses these, and what stops that line is
// added, until it is free or there is none. So is a triangle that v lies on: points of int V beside v need
// not see p then (D6).
PointAnswer PointQuery::look(const Point3& p, const std::optional<Plane3>& side) const {
  PointAnswer answer;
  const exact::ConvexCell& cell = omega_.map().cell;
  const auto ask = [&](const std::vector<std::uint32_t>& triangles) {
    std::vector<exact::TriangleCorners> soup;
    for (const std::uint32_t t : triangles) soup.push_back(corners_[t]);
    return exact::point_occlusion(p, side, cell, soup);
  };
  std::vector<std::uint32_t> cover;
  while (true) {
    const exact::OcclusionAnswer found = ask(cover);
    if (found.occluded) break;
    const exact::SightLine line = exact::check_sight_line(mesh_, cell, *found.witness, p);
    if (!line.valid)
      throw scene::Error(scene::ErrorCode::internal, "point_query: a sight line does not start in the cell");
    std::vector<std::uint32_t> in_the_way = line.blockers;
    if (in_the_way.empty() && line.spoiler) in_the_way = {*line.spoiler};
    if (in_the_way.empty()) {
      answer.v = found.witness;
      return answer;
    }
    for (const std::uint32_t t : in_the_way) {
      if (std::find(cover.begin(), cover.end(), t) != cover.end())
        throw scene::Error(scene::ErrorCode::internal, "point_query: a sight line found does not pass a triangle");
    }
    cover.push_back(in_the_way.front());
  }
  for (std::size_t i = cover.size(); i-- > 0;) {
    std::vector<std::uint32_t> less = cover;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    if (ask(less).occluded) cover.swap(less);
  }
  std::sort(cover.begin(), cover.end());
  answer.faces_away = cover.empty();
  answer.covered_by = std::move(cover);
  return answer;
}

bool PointQuery::in_visible_region(std::uint32_t triangle, bool front, const Point3& p) const {
  const reference::VisibilityMap& map = omega_.map();
  return std::any_of(visible_regions_[triangle][front].begin(), visible_regions_[triangle][front].end(),
                     [&](std::uint32_t i) { return in_region(map.regions[i], *planes_[triangle], p); });
}

PointReport PointQuery::ask(const Point3& p) const { return ask(p, {p}); }

PointReport PointQuery::ask(const Point3& p, const std::vector<Point3>& corners) const {
  PointReport report;
  const reference::VisibilityMap& map = omega_.map();
  report.in_cell = map.cell.contains(p);
  if (report.in_cell) return report;
  bool on_surface = false;
  for (std::uint32_t t = 0; t < corners_.size(); ++t) {
    const auto& [a, b, c] = corners_[t];
    if (!planes_[t] || !planes_[t]->has_on(p) || !exact::Kernel::Triangle_3(a, b, c).has_on(p)) continue;
    on_surface = true;
    for (const bool front : {true, false}) {
      if (!front && map.mode == reference::Mode::solid) continue;
      PointAnswer answer = look(p, front ? *planes_[t] : planes_[t]->opposite());
      answer.triangle = t;
      answer.front = front;
      answer.first_order = in_visible_region(t, front, p);
      answer.contradiction =
          answer.v && !answer.first_order && exact::check_witness(mesh_, map.cell, t, front, *answer.v, p).valid;
      report.answers.push_back(std::move(answer));
    }
  }
  if (on_surface) return report;
  PointAnswer answer = look(p, std::nullopt);
  const reference::Walker::Label label = labels_(p, corners);
  answer.first_order = label.visible;
  answer.fallback = label.fallback;
  answer.contradiction = answer.v && !label.visible;
  report.answers.push_back(std::move(answer));
  return report;
}

}  // namespace clues::validate
