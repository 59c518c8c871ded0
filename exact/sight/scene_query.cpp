// Exact segment-piece tests by orientation signs; D3 (the cell's inside does not occlude) and D5 (closed occluders).
#include "exact/sight/scene_query.h"

#include <algorithm>

#include "exact/cell/cell_plane.h"
#include "exact/cell/direction_cone.h"

namespace clues::exact {

bool meets_cell(const TriangleCorners& t, const ConvexCell& cell) {
  if (CGAL::collinear(t[0], t[1], t[2])) return false;
  std::vector<Point3> rest(t.begin(), t.end());
  if (cell.dimension() == 3) {
    for (const CellFacet& f : cell.facets()) {
      rest = clipped(rest, f.plane.opposite());
      if (rest.empty()) return false;
    }
    return true;
  }
  const Kernel::Triangle_3 triangle(t[0], t[1], t[2]);
  const auto& s = cell.vertices();
  if (cell.dimension() == 0) return triangle.has_on(s[0]);
  if (cell.dimension() == 1) return CGAL::do_intersect(triangle, Kernel::Segment_3(s[0], s[1]));
  const CellFacet& f = cell.facets().front();
  for (std::size_t i = 2; i < f.corners.size(); ++i) {
    const Kernel::Triangle_3 part(s[static_cast<std::size_t>(f.corners[0])],
                                  s[static_cast<std::size_t>(f.corners[i - 1])],
                                  s[static_cast<std::size_t>(f.corners[i])]);
    if (CGAL::do_intersect(triangle, part)) return true;
  }
  return false;
}

bool is_touched(const Complex& complex, const Point3& v) {
  for (std::size_t t = 0; t < complex.pieces.size(); ++t) {
    if (complex.in_cell[t] || !complex.planes[t].has_on(v)) continue;
    const auto& c = complex.pieces[t].corners;
    if (Kernel::Triangle_3(complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]).has_on(v)) return true;
  }
  return false;
}

SceneQuery::SceneQuery(const Complex& complex, const ConvexCell& cell, const std::vector<bool>& occluders)
    : complex_(&complex), cell_(&cell) {
  CGAL::Bbox_3 cell_box;
  for (const Point3& s : cell.vertices()) cell_box += s.bbox();
  bounds_ = cell_box;
  std::vector<CGAL::Bbox_3> boxes;
  boxes.reserve(complex.pieces.size());
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    const auto& c = complex.pieces[t].corners;
    const CGAL::Bbox_3 box = complex.points[c[0]].bbox() + complex.points[c[1]].bbox() + complex.points[c[2]].bbox();
    bounds_ += box;
    meets_cell_.push_back(CGAL::do_overlap(box, cell_box) &&
                          exact::meets_cell({complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]}, cell));
    if (complex.in_cell[t] || (!occluders.empty() && !occluders[t])) continue;
    boxes.push_back(box);
    occluders_.push_back(t);
  }
  tree_ = BoxTree(std::move(boxes));
}

namespace {

// What a segment from v to p does at a piece, for one piece after the other.
class Crossing {
 public:
  enum class Kind { none, clean, degenerate };

  Crossing(const Complex& complex, const ConvexCell& cell, const Point3& v, const Point3& p, bool off_planes)
      : complex_(complex), cell_(cell), v_(v), p_(p), off_planes_(off_planes) {}

  Kind at(std::uint32_t t) {
    const auto& c = complex_.pieces[t].corners;
    const Point3 &a = complex_.points[c[0]], &b = complex_.points[c[1]], &d = complex_.points[c[2]];
    look_at_plane(complex_.pieces[t].origins.front(), a, b, d);
    if (at_p_ == CGAL::COPLANAR) {
      const bool in_plane = at_v_ == CGAL::COPLANAR && !off_planes_;
      return in_plane && CGAL::do_intersect(Kernel::Segment_3(v_, p_), Kernel::Triangle_3(a, b, d)) ? Kind::degenerate
                                                                                                    : Kind::none;
    }
    if (at_v_ == at_p_) return Kind::none;
    const CGAL::Orientation o1 = CGAL::orientation(v_, p_, a, b), o2 = CGAL::orientation(v_, p_, b, d),
                            o3 = CGAL::orientation(v_, p_, d, a);
    const bool negative = o1 == CGAL::NEGATIVE || o2 == CGAL::NEGATIVE || o3 == CGAL::NEGATIVE;
    const bool positive = o1 == CGAL::POSITIVE || o2 == CGAL::POSITIVE || o3 == CGAL::POSITIVE;
    if (negative && positive) return Kind::none;
    // On a triangle that holds what of V is next to v, v starts beside it, and a line that leaves its plane does not come back.
    if (at_v_ == CGAL::COPLANAR && lies_in(cell_, complex_.planes[t])) return Kind::none;
    const bool at_border = o1 == CGAL::COPLANAR || o2 == CGAL::COPLANAR || o3 == CGAL::COPLANAR;
    return at_v_ == CGAL::COPLANAR || at_border ? Kind::degenerate : Kind::clean;
  }

 private:
  // The pieces of an input triangle, which mostly follow each other, have one plane.
  void look_at_plane(const Origin& origin, const Point3& a, const Point3& b, const Point3& d) {
    if (known_ == origin.triangle) return;
    const auto side_of = [&](const Point3& x) {
      return origin.same_side ? CGAL::orientation(a, b, d, x) : CGAL::orientation(b, a, d, x);
    };
    known_ = origin.triangle;
    at_p_ = side_of(p_);
    at_v_ = side_of(v_);
  }

  const Complex& complex_;
  const ConvexCell& cell_;
  const Point3 &v_, &p_;
  bool off_planes_;
  std::optional<std::uint32_t> known_;
  CGAL::Orientation at_p_ = CGAL::COPLANAR, at_v_ = CGAL::COPLANAR;  // of the triangle that is known
};

}  // namespace

SegmentAnswer SceneQuery::crossings(const Point3& v, const Point3& p, bool off_planes,
                                    std::optional<std::uint32_t> first) const {
  SegmentAnswer answer;
  Crossing crossing(*complex_, *cell_, v, p, off_planes);
  const auto is_degenerate = [&](Crossing::Kind kind, std::uint32_t t) {
    if (kind != Crossing::Kind::degenerate) return false;
    answer.degenerate = true;
    answer.at = t;
    return true;
  };
  if (first && is_degenerate(crossing.at(*first), *first)) return answer;
  for (const std::uint32_t t : candidates(SegmentBoxTest(v, p))) {
    const Crossing::Kind kind = crossing.at(t);
    if (is_degenerate(kind, t)) return answer;
    if (kind == Crossing::Kind::none) continue;
    if (const std::optional<Hit> hit = hit_outside(v, p, t)) answer.hits.push_back(*hit);
  }
  std::sort(answer.hits.begin(), answer.hits.end(), [](const Hit& x, const Hit& y) { return x.t < y.t; });
  for (std::size_t i = 1; i < answer.hits.size(); ++i) {
    if (answer.hits[i - 1].t == answer.hits[i].t) answer.degenerate = true;
  }
  return answer;
}

std::optional<Hit> SceneQuery::hit_outside(const Point3& v, const Point3& p, std::uint32_t crossed) const {
  const Plane3& plane = complex_->planes[crossed];
  const FT at_end = value_at(plane, p), at_start = value_at(plane, v);
  const FT s = at_start / (at_start - at_end);
  if (cell_->dimension() == 3 && meets_cell_[crossed] && cell_->interior_contains(v + s * (p - v))) return std::nullopt;
  return Hit{crossed, s};
}

bool SceneQuery::meets(const Point3& v, const Point3& p, std::uint32_t occluder) const {
  const Crossing::Kind kind = Crossing(*complex_, *cell_, v, p, false).at(occluder);
  return kind == Crossing::Kind::degenerate || (kind == Crossing::Kind::clean && hit_outside(v, p, occluder));
}

bool SceneQuery::is_free(const Point3& v, const Point3& p) const {
  if (v == p) return true;
  const bool solid = cell_->dimension() == 3;  // else nothing is in its interior (D3)
  const auto inside = [&](const Point3& x) { return solid && cell_->interior_contains(x); };
  // An end of the segment is not in the open segment; what is beside it is in int V where the end is at least in V.
  const auto end_in_cell = [&](const Point3& x) { return x == v || x == p ? cell_->contains(x) : inside(x); };
  const Kernel::Segment_3 segment(v, p);
  for (const std::uint32_t t : candidates(SegmentBoxTest(v, p))) {
    const auto& c = complex_->pieces[t].corners;
    const Kernel::Triangle_3 triangle(complex_->points[c[0]], complex_->points[c[1]], complex_->points[c[2]]);
    if (!CGAL::do_intersect(segment, triangle)) continue;
    const auto met = CGAL::intersection(segment, triangle);
    if (!met) continue;
    if (const auto* x = boost::get<Point3>(&*met)) {
      if (*x != v && *x != p && !inside(*x)) return false;
    } else {
      const auto& s = boost::get<Kernel::Segment_3>(*met);
      if (!end_in_cell(s.source()) || !end_in_cell(s.target()) || !inside(CGAL::midpoint(s.source(), s.target())))
        return false;
    }
  }
  return true;
}

}  // namespace clues::exact
