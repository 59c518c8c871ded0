#include "validate/certificates/segment_query.h"

#include <algorithm>

namespace clues::validate {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using exact::Vector3;

class Cutter {
 public:
  Cutter(const Point3& a, const Point3& b) : a_(a), b_(b) {}

  // Cuts at the plane if `counts` says so of the point there.
  template <class Counts>
  void cut(const Plane3& plane, const Counts& counts) {
    const FT at_a = exact::value_at(plane, a_), at_b = exact::value_at(plane, b_);
    if (CGAL::sign(at_a) * CGAL::sign(at_b) >= 0) return;
    const FT s = exact::collapsed(at_a / (at_a - at_b));
    if (counts(a_ + s * (b_ - a_))) stops_.push_back(s);
  }
  // For a segment in the plane with this normal: cuts at a line of the plane.
  void cut_at_line(const Point3& p, const Point3& q, const Vector3& normal) {
    if (p != q) cut(Plane3(p, CGAL::cross_product(normal, q - p)), [](const Point3&) { return true; });
  }
  bool runs_in(const Plane3& plane) const { return plane.has_on(a_) && plane.has_on(b_); }

  std::vector<FT> stops() && {
    stops_.emplace_back(0);
    stops_.emplace_back(1);
    std::sort(stops_.begin(), stops_.end());
    stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
    return std::move(stops_);
  }

 private:
  const Point3 &a_, &b_;
  std::vector<FT> stops_;
};

std::vector<FT> cuts(const reference::Omega& omega, const Point3& a, const Point3& b) {
  Cutter cutter(a, b);
  const reference::VisibilityMap& map = omega.map();
  const exact::Complex& complex = map.complex;
  for (const reference::ValidPiece& piece : omega.fixpoint().wedges.pieces()) {
    const reference::Wedge& w = piece.wedge;
    if (!cutter.runs_in(w.plane)) {
      cutter.cut(w.plane, [&](const Point3& x) { return reference::covers(piece, x) != reference::Meets::no; });
      continue;
    }
    const Vector3 n = w.plane.orthogonal_vector();
    cutter.cut_at_line(w.center, w.on_ray0, n);
    cutter.cut_at_line(w.center, w.on_ray1, n);
    cutter.cut_at_line(w.near0, w.near1, n);
    if (!w.unbounded) cutter.cut_at_line(w.far0, w.far1, n);
  }
  for (std::size_t t = 0; t < complex.pieces.size(); ++t) {
    const auto& c = complex.pieces[t].corners;
    const exact::Kernel::Triangle_3 triangle(complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]);
    if (!cutter.runs_in(complex.planes[t])) {
      cutter.cut(complex.planes[t], [&](const Point3& x) { return triangle.has_on(x); });
      continue;
    }
    const Vector3 n = complex.planes[t].orthogonal_vector();
    for (int i = 0; i < 3; ++i) cutter.cut_at_line(triangle[i], triangle[i + 1], n);
  }
  for (const reference::DmSegment& d : map.segments) {
    const Plane3& plane = complex.planes[d.piece];
    if (cutter.runs_in(plane)) cutter.cut_at_line(d.a, d.b, plane.orthogonal_vector());
  }
  for (const Point3& s : map.cell.vertices()) cutter.cut(Plane3(s, b - a), [&](const Point3& x) { return x == s; });
  const auto in_cell = [&](const Point3& x) { return map.cell.contains(x); };
  for (const exact::CellFacet& f : map.cell.facets()) {
    const Vector3 n = f.plane.orthogonal_vector();
    cutter.cut(f.plane, in_cell);
    for (std::size_t i = 0; i < f.corners.size() && cutter.runs_in(f.plane); ++i) {
      const auto corner = [&](std::size_t k) {
        return map.cell.vertices()[static_cast<std::size_t>(f.corners[k % f.corners.size()])];
      };
      cutter.cut_at_line(corner(i), corner(i + 1), n);
    }
  }
  return std::move(cutter).stops();
}

}  // namespace

std::vector<SegmentPart> ask_segment(const PointQuery& query, const reference::Omega& omega, const Point3& a,
                                     const Point3& b) {
  std::vector<SegmentPart> parts;
  const std::vector<FT> stops = cuts(omega, a, b);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    SegmentPart part{stops[i], stops[i + 1], PartSight::hidden, {}, std::nullopt, false};
    const auto at = [&](const FT& share) { return exact::collapsed(a + share * (b - a)); };
    part.at = at((FT(4) * part.from + FT(3) * part.to) / FT(7));
    const PointReport report = query.ask(part.at, {at(part.from), at(part.to)});
    if (report.in_cell) part.sight = PartSight::visible;
    for (const PointAnswer& answer : report.answers) {
      part.contradiction |= answer.contradiction;
      if (answer.v && !part.v) {
        part.v = answer.v;
        part.sight = PartSight::visible;
      }
      if (answer.first_order && part.sight == PartSight::hidden) part.sight = PartSight::undecided;
    }
    if (!parts.empty() && parts.back().sight == part.sight && !part.contradiction) {
      parts.back().to = part.to;
    } else {
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

}  // namespace clues::validate
