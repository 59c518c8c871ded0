#include "reference/contours/plane_labels.h"

#include <algorithm>
#include <map>
#include <set>

#include "scene/messages/error.h"

namespace clues::reference {

using exact::Plane3;
using exact::Point3;

namespace {

bool same_plane(const Plane3& g, const Plane3& h) { return g == h || g == h.opposite(); }

// Points of the file by coordinates, the first of each; edges of triangles with an area between them.
struct SceneLines {
  std::vector<std::uint32_t> first;
  std::set<std::array<std::uint32_t, 2>> edges;

  explicit SceneLines(const scene::TriangleMesh& mesh) {
    std::map<scene::Point, std::uint32_t> seen;
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
      first.push_back(seen.emplace(mesh.points[i], i).first->second);
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(first[t[k]], first[t[(k + 1) % 3]]);
        if (a != b) edges.insert({a, b});
      }
    }
  }
};

}  // namespace

Plane3 PlaneTable::plane_of(const PlaneLabel& label) const {
  const auto point = [this](std::uint32_t i) { return exact::to_exact(mesh_->points[i]); };
  const auto corner = [this](std::uint32_t i) { return corners_[i]; };
  switch (label.kind) {
    case PlaneLabel::Kind::edge:
      return {point(label.points[0]), point(label.points[1]), corner(label.cell[0])};
    case PlaneLabel::Kind::vertex:
      return {point(label.points[0]), corner(label.cell[0]), corner(label.cell[1])};
    case PlaneLabel::Kind::triangle:
      return {point(label.points[0]), point(label.points[1]), point(label.points[2])};
    case PlaneLabel::Kind::crossing:
      break;
  }
  const Point3 a = point(label.points[0]), b = point(label.points[1]);
  const exact::FT at_a = exact::value_at(planes_[label.crossed], a), at_b = exact::value_at(planes_[label.crossed], b);
  if (at_a == at_b)
    throw scene::Error(scene::ErrorCode::malformed, "contours: an edge that does not cross the plane of its label");
  const Point3 x = exact::zero_on_line(a, b, at_a, at_b);
  return {x, corner(label.cell[0]), corner(label.cell[1])};
}

std::size_t PlaneTable::add(const PlaneLabel& label) {
  const Plane3 plane = plane_of(label);
  if (plane.is_degenerate())
    throw scene::Error(scene::ErrorCode::malformed, "contours: a label whose points are on one line makes no plane");
  labels_.push_back(label);
  planes_.push_back(plane);
  return labels_.size() - 1;
}

std::size_t PlaneTable::holding(const Point3& a, const Point3& b) const {
  const auto at =
      std::find_if(planes_.begin(), planes_.end(), [&](const Plane3& h) { return h.has_on(a) && h.has_on(b); });
  return at == planes_.end() ? npos : static_cast<std::size_t>(at - planes_.begin());
}

std::optional<PlaneLabel> PlaneTable::label_of(const Wedge& wedge) const {
  if (wedge.kind == WedgeKind::se_mv) return label_at_apex(wedge);
  for (const auto& [a, b] : edges_) {
    const Point3 p = exact::to_exact(mesh_->points[a]), q = exact::to_exact(mesh_->points[b]);
    if (!wedge.plane.has_on(p) || !wedge.plane.has_on(q)) continue;
    if (!CGAL::collinear(p, q, wedge.near0) || !CGAL::collinear(p, q, wedge.near1)) continue;
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      const Point3& corner = corners_[c];
      if (wedge.plane.has_on(corner) && !CGAL::collinear(p, q, corner))
        return PlaneLabel{PlaneLabel::Kind::edge, {a, b, 0}, {c, 0}, 0};
    }
  }
  return std::nullopt;
}

std::optional<PlaneLabel> PlaneTable::label_at_apex(const Wedge& wedge) const {
  const Point3& x = wedge.center;
  std::optional<std::array<std::uint32_t, 2>> corners;
  for (std::uint32_t c = 0; c < corners_.size() && !corners; ++c) {
    if (!wedge.plane.has_on(corners_[c])) continue;
    for (std::uint32_t d = c + 1; d < corners_.size() && !corners; ++d) {
      if (wedge.plane.has_on(corners_[d]) && !CGAL::collinear(x, corners_[c], corners_[d])) corners = {c, d};
    }
  }
  if (!corners) return std::nullopt;
  for (const auto& edge : edges_) {
    for (const std::uint32_t end : edge) {
      if (exact::to_exact(mesh_->points[end]) == x)
        return PlaneLabel{PlaneLabel::Kind::vertex, {end, 0, 0}, *corners, 0};
    }
  }
  for (const auto& [a, b] : edges_) {
    const Point3 p = exact::to_exact(mesh_->points[a]), q = exact::to_exact(mesh_->points[b]);
    if (!CGAL::collinear(p, q, x)) continue;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if (planes_[i].has_on(x) && !planes_[i].has_on(p))
        return PlaneLabel{PlaneLabel::Kind::crossing, {a, b, 0}, *corners, static_cast<std::uint32_t>(i)};
    }
  }
  return std::nullopt;
}

void PlaneTable::add_wedges(const VisibilityMap& map) {
  const SceneLines lines(*mesh_);
  edges_.assign(lines.edges.begin(), lines.edges.end());
  std::vector<const Wedge*> wedges;
  for (const Wedge& w : map.wedges) wedges.push_back(&w);
  std::stable_sort(wedges.begin(), wedges.end(),
                   [](const Wedge* a, const Wedge* b) { return a->generation < b->generation; });
  for (const Wedge* w : wedges) {
    if (std::any_of(planes_.begin(), planes_.end(), [w](const Plane3& h) { return same_plane(h, w->plane); })) continue;
    if (const auto label = label_of(*w)) {
      add(*label);
    } else {
      ++left_out_;
    }
  }
  std::map<std::uint32_t, int> pieces;
  for (const auto& piece : map.complex.pieces) {
    for (const auto& origin : piece.origins) ++pieces[origin.triangle];
  }
  for (const auto& [t, count] : pieces) {
    if (count < 2) continue;
    const auto& c = mesh_->triangles[t];
    add({PlaneLabel::Kind::triangle, {lines.first[c[0]], lines.first[c[1]], lines.first[c[2]]}, {}, 0});
  }
}

}  // namespace clues::reference
