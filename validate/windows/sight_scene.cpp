// Which occluders, edges and contacts there are (docs/visible-set.md, sections 2 and 3).
#include "validate/windows/sight_scene.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "exact/sight/scene_query.h"
#include "scene/messages/error.h"

namespace clues::validate {
namespace {

RVector negative(const RVector& a) { return times(a, Rational(-1)); }

int side_of(const RVector& normal, const RVector& at, const RVector& x) { return sgn(dot(normal, minus(x, at))); }

bool any_on_side(const std::vector<RVector>& points, const RVector& normal, const RVector& at, int side) {
  return std::any_of(points.begin(), points.end(), [&](const RVector& x) { return side_of(normal, at, x) * side > 0; });
}

bool all_on_plane(const std::vector<RVector>& points, const RVector& normal, const RVector& at) {
  return !any_on_side(points, normal, at, 1) && !any_on_side(points, normal, at, -1);
}

// Whether some planes (outward normals of a convex body) keep the polygon away from the body's interior.
template <class Facets>
bool surely_outside(const Polygon& polygon, const Facets& facets) {
  return std::any_of(facets.begin(), facets.end(),
                     [&](const auto& facet) { return !any_on_side(polygon, facet.normal, facet.corners[0], -1); });
}

// The convex parts of a polygon outside the interior of a solid cell; `polygon` itself when they do not meet.
std::vector<Polygon> parts_outside(const Polygon& polygon, const CellShape& cell) {
  std::vector<Polygon> parts;
  Polygon rest = polygon;
  for (const auto& facet : cell.facets) {
    Polygon out = clipped(rest, facet.normal, facet.corners[0]);
    if (out.size() >= 3 && any_on_side(out, facet.normal, facet.corners[0], 1)) parts.push_back(std::move(out));
    rest = clipped(rest, negative(facet.normal), facet.corners[0]);
    if (rest.size() < 3 || !any_on_side(rest, facet.normal, facet.corners[0], -1)) return {polygon};
  }
  return parts;
}

// s with x = origin + s direction, for x on that line.
Rational parameter_of(const SightEdge& edge, const RVector& x) {
  std::size_t axis = 0;
  while (sgn(edge.direction[axis]) == 0) ++axis;
  return (x[axis] - edge.origin[axis]) / edge.direction[axis];
}

}  // namespace

bool cut_range(SightEdge& edge, const RVector& normal, const RVector& at) {
  const Rational value = dot(normal, minus(edge.origin, at)), slope = dot(normal, edge.direction);
  if (sgn(slope) == 0) return sgn(value) > 0;
  const Rational s = -value / slope;
  if (sgn(slope) > 0) {
    edge.low = std::max(edge.low, s);
  } else {
    edge.high = std::min(edge.high, s);
  }
  return edge.low < edge.high;
}

SightScene::SightScene(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, bool solid)
    : cell_(cell), complex_(exact::build_complex(mesh)), shape_(cell), polygons_(mesh.triangles.size()) {
  if (solid) {
    if (const auto bad = exact::triangles_not_solid(complex_); !bad.empty()) {
      throw scene::Error(scene::ErrorCode::not_solid,
                         "triangle " + std::to_string(bad.front()) +
                             " lies at an edge that is not closed and consistently oriented; use sheet mode");
    }
  }
  for (const auto& p : complex_.points) points_.push_back(read(p));
  const std::size_t count = mesh.triangles.size();
  outside_.resize(count);
  above_.resize(count);
  below_.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (std::binary_search(complex_.degenerate.begin(), complex_.degenerate.end(), t)) continue;
    for (const std::uint32_t c : mesh.triangles[t]) polygons_[t].push_back(read(exact::to_exact(mesh.points[c])));
    if (shape_.dimension == 3) outside_[t] = parts_outside(polygons_[t], shape_);
    if (shape_.dimension == 2) {
      const RVector &n = shape_.facets[0].normal, &at = shape_.facets[0].corners[0];
      if (any_on_side(polygons_[t], n, at, 1)) above_[t] = {clipped(polygons_[t], n, at)};
      if (any_on_side(polygons_[t], n, at, -1)) below_[t] = {clipped(polygons_[t], negative(n), at)};
    }
  }
  if (shape_.dimension >= 2) find_edges();
  if (shape_.dimension == 3) find_cut_edges();
  if (shape_.dimension == 1) find_stops();
}

// The edge as a part of an edge of the input, whose numbers are short; as itself when it lies on none.
SightEdge SightScene::edge_on_input(const exact::Edge& edge) const {
  const RVector &a = points_[edge.a], &b = points_[edge.b];
  for (const std::uint32_t p : edge.pieces) {
    for (const auto& origin : complex_.pieces[p].origins) {
      const Polygon& t = polygons_[origin.triangle];
      for (std::size_t i = 0; i < 3; ++i) {
        const RVector along = minus(t[(i + 1) % 3], t[i]);
        if (!is_zero(cross(along, minus(a, t[i]))) || !is_zero(cross(along, minus(b, t[i])))) continue;
        SightEdge found{t[i], along, 0, 1, {}};
        const Rational at_a = parameter_of(found, a), at_b = parameter_of(found, b);
        found.low = std::min(at_a, at_b);
        found.high = std::max(at_a, at_b);
        return found;
      }
    }
  }
  return {a, minus(b, a), 0, 1, {}};
}

SightEdge::Sheet SightScene::sheet_of(std::uint32_t piece, const RVector& into, const RVector& direction) const {
  // The input triangle's normal: shorter numbers than the piece's own.
  const RVector long_normal = cross(into, direction);
  RVector normal = normal_of(polygons_[complex_.pieces[piece].origins.front().triangle]);
  if (sgn(dot(normal, long_normal)) < 0) normal = negative(normal);
  return {into, normal};
}

// One for each half plane of pieces at the edge.
std::vector<SightEdge::Sheet> SightScene::sheets_at(const exact::Edge& edge, const RVector& direction) const {
  std::vector<SightEdge::Sheet> sheets;
  for (const std::uint32_t p : edge.pieces) {
    for (const std::uint32_t c : complex_.pieces[p].corners) {
      if (c == edge.a || c == edge.b) continue;
      SightEdge::Sheet sheet = sheet_of(p, minus(points_[c], points_[edge.a]), direction);
      const bool known = std::any_of(sheets.begin(), sheets.end(), [&](const auto& other) {
        return primitive(other.normal) == primitive(sheet.normal);
      });
      if (!known) sheets.push_back(std::move(sheet));
    }
  }
  return sheets;
}

bool SightScene::along_boundary(const exact::Edge& edge) const {
  if (shape_.dimension != 3) return false;
  return std::any_of(shape_.facets.begin(), shape_.facets.end(), [&](const CellShape::Facet& facet) {
    return all_on_plane({points_[edge.a], points_[edge.b]}, facet.normal, facet.corners[0]);
  });
}

void SightScene::find_edges() {
  for (const exact::Edge& e : complex_.edges) {
    SightEdge edge = edge_on_input(e);
    edge.sheets = sheets_at(e, edge.direction);
    const bool along = along_boundary(e);
    const bool flat = std::any_of(edge.sheets.begin(), edge.sheets.end(), [&](const auto& a) {
      return std::any_of(edge.sheets.begin(), edge.sheets.end(),
                         [&](const auto& b) { return primitive(a.normal) == primitive(negative(b.normal)); });
    });
    if (flat && !along) continue;  // surface goes on across it: no line passes it with all sheets on one side
    edges_.push_back({std::move(edge), along});
  }
}

// Where pieces enter a solid cell: S ends there.
void SightScene::find_cut_edges() {
  for (std::uint32_t p = 0; p < complex_.pieces.size(); ++p) {
    Polygon corners;
    for (const std::uint32_t c : complex_.pieces[p].corners) corners.push_back(points_[c]);
    if (surely_outside(corners, shape_.facets)) continue;
    for (const auto& facet : shape_.facets) {
      const RVector &n = facet.normal, &at = facet.corners[0];
      if (!any_on_side(corners, n, at, 1) || !any_on_side(corners, n, at, -1)) continue;
      const Polygon part = clipped(corners, n, at);
      std::vector<RVector> ends;
      for (const RVector& x : part) {
        if (side_of(n, at, x) == 0) ends.push_back(x);
      }
      SightEdge edge{ends.at(0), minus(ends.at(1), ends.at(0)), 0, 1, {}};
      bool left = true;
      for (const auto& other : shape_.facets) {
        if (&other != &facet) left = left && cut_range(edge, negative(other.normal), other.corners[0]);
      }
      if (!left) continue;
      const RVector up = normal_of(corners);
      const RVector out = minus(times(n, Rational(dot(up, up))), times(up, Rational(dot(n, up))));
      edge.sheets.push_back(sheet_of(p, out, edge.direction));
      edges_.push_back({std::move(edge), true});
    }
  }
}

void SightScene::find_stops() {
  const RVector &a = shape_.vertices[0], &b = shape_.vertices[1];
  for (const Polygon& t : polygons_) {
    if (t.empty()) continue;
    const RVector n = normal_of(t);
    const Rational at_a = dot(n, minus(a, t[0])), at_b = dot(n, minus(b, t[0]));
    if (sgn(at_a) * sgn(at_b) < 0) stops_.push_back(at_a / (at_a - at_b));
  }
  std::sort(stops_.begin(), stops_.end());
  stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
}

std::optional<SightQuestion> SightScene::question(std::uint32_t triangle, bool front) const {
  SightQuestion question;
  question.triangle = triangle;
  question.front = front;
  SightTarget& target = question.target;
  target.triangle = polygons_[triangle];
  if (!front) std::swap(target.triangle[1], target.triangle[2]);
  target.up = normal_of(target.triangle);
  const RVector& at = target.triangle[0];
  if (!any_on_side(shape_.vertices, target.up, at, 1)) return std::nullopt;
  const auto corner = [&](std::size_t i) { return to_point(target.triangle[i]); };
  question.plane = exact::Plane3(corner(0), corner(1), corner(2));

  // All sight lines lie within the hull of triangle and cell.
  std::vector<exact::Point3> hull_points = cell_.vertices();
  for (std::size_t i = 0; i < 3; ++i) hull_points.push_back(corner(i));
  const CellShape hull{exact::ConvexCell(hull_points)};
  const exact::ConvexCell body({corner(0), corner(1), corner(2)});
  // What stands on the cell or on the target from outside the hull stops no line, but spoils single points of
  // them for a witness.
  const auto spoils = [&](const Polygon& t) {
    const exact::TriangleCorners c{to_point(t[0]), to_point(t[1]), to_point(t[2])};
    return shape_.dimension < 3 && (exact::meets_cell(c, cell_) || exact::meets_cell(c, body));
  };
  for (std::uint32_t t = 0; t < polygons_.size(); ++t) {
    if (polygons_[t].empty() || t == triangle) continue;
    const bool coplanar = all_on_plane(polygons_[t], target.up, at);
    const bool outside = !coplanar && surely_outside(polygons_[t], hull.facets);
    if (outside && !spoils(polygons_[t])) continue;
    question.soup.push_back({to_point(polygons_[t][0]), to_point(polygons_[t][1]), to_point(polygons_[t][2])});
    if (coplanar || outside) continue;  // a line through the target meets its plane only there
    if (any_on_side(polygons_[t], target.up, at, 1)) target.before.push_back(clipped(polygons_[t], target.up, at));
    target.outside.insert(target.outside.end(), outside_[t].begin(), outside_[t].end());
    target.above.insert(target.above.end(), above_[t].begin(), above_[t].end());
    target.below.insert(target.below.end(), below_[t].begin(), below_[t].end());
  }

  for (const Candidate& candidate : edges_) {
    SightEdge edge = candidate.edge;
    bool left = cut_range(edge, target.up, at);
    for (const auto& facet : hull.facets) left = left && cut_range(edge, negative(facet.normal), facet.corners[0]);
    if (!left) continue;
    // A line through the edge crosses the plane of each sheet there: from target to cell, both wedges looked at together.
    const bool possible = candidate.along_boundary || std::all_of(edge.sheets.begin(), edge.sheets.end(), [&](auto& s) {
                            return (any_on_side(target.triangle, s.normal, edge.origin, -1) &&
                                    any_on_side(shape_.vertices, s.normal, edge.origin, 1)) ||
                                   (any_on_side(target.triangle, s.normal, edge.origin, 1) &&
                                    any_on_side(shape_.vertices, s.normal, edge.origin, -1));
                          });
    if (possible) question.edges.push_back(std::move(edge));
  }
  find_places(question);
  return question;
}

void SightScene::find_places(SightQuestion& question) const {
  const SightTarget& target = question.target;
  const RVector& at = target.triangle[0];
  const auto height = [&](std::uint32_t point) { return side_of(target.up, at, points_[point]); };
  const auto flat = [&](std::uint32_t p) {
    const auto& c = complex_.pieces[p].corners;
    return height(c[0]) == 0 && height(c[1]) == 0 && height(c[2]) == 0;
  };
  std::vector<bool> own(complex_.pieces.size());
  std::vector<std::uint32_t> root(complex_.pieces.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t p) {
    while (root[p] != p) p = root[p];
    return p;
  };
  for (std::uint32_t p = 0; p < complex_.pieces.size(); ++p) {
    const auto& origins = complex_.pieces[p].origins;
    own[p] =
        std::any_of(origins.begin(), origins.end(), [&](const auto& o) { return o.triangle == question.triangle; });
  }
  // The plane of a polygon as cell parts the lines that come from its two sides: what stands on the plane ends there.
  const auto& facets = shape_.facets;
  if (shape_.dimension == 2 && any_on_side(target.triangle, facets[0].normal, facets[0].corners[0], 1) &&
      any_on_side(target.triangle, facets[0].normal, facets[0].corners[0], -1)) {
    for (std::uint32_t p = 0; p < complex_.pieces.size(); ++p) {
      if (!own[p]) continue;
      Polygon corners;
      for (const std::uint32_t c : complex_.pieces[p].corners) corners.push_back(points_[c]);
      for (const RVector& up : {facets[0].normal, negative(facets[0].normal)}) {
        if (!any_on_side(corners, up, facets[0].corners[0], 1)) continue;
        const Polygon part = clipped(corners, up, facets[0].corners[0]);
        RVector middle{};
        for (const RVector& x : part) middle = sum(middle, x);
        question.samples.push_back(
            to_point(times(middle, Rational(Rational(1) / static_cast<unsigned long>(part.size())))));
      }
    }
    return;
  }
  for (const exact::Edge& e : complex_.edges) {
    std::vector<std::uint32_t> mine;
    std::copy_if(e.pieces.begin(), e.pieces.end(), std::back_inserter(mine), [&](std::uint32_t p) { return own[p]; });
    if (mine.size() < 2) continue;
    if (std::all_of(e.pieces.begin(), e.pieces.end(), flat)) root[find(mine[0])] = find(mine[1]);
  }
  for (std::uint32_t p = 0; p < complex_.pieces.size(); ++p) {
    if (!own[p] || find(p) != p) continue;
    const auto& c = complex_.pieces[p].corners;
    question.samples.push_back(
        exact::collapsed(CGAL::centroid(complex_.points[c[0]], complex_.points[c[1]], complex_.points[c[2]])));
  }
}

}  // namespace clues::validate
