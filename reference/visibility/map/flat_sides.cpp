#include "reference/visibility/map/flat_sides.h"

#include <utility>

namespace clues::reference {

using exact::Point2;
using exact::Point3;

namespace {

void add_faces(const FlatSet& set, bool visible, const TriangleFrame& frame, std::uint32_t t, bool front,
               SideFaces& out) {
  const auto twice_triangle = frame.twice_area();
  for (const Face2& face : set.faces()) {
    Region r{t, front, visible, {}, exact::FT(0), frame.lift(inner_point(face, 0))};
    for (const Ring2& ring : face) {
      r.area_fraction += twice_area(ring) / twice_triangle;
      r.rings.emplace_back();
      for (const Point2& q : ring) r.rings.back().push_back(frame.lift(q));
    }
    r.area_fraction = exact::collapsed(r.area_fraction);
    out.regions.push_back(std::move(r));
  }
}

// The borders of the set inside the triangle.
void add_borders(const FlatSet& set, const TriangleFrame& frame, std::uint32_t t, bool front, SideFaces& out) {
  for (const Face2& face : set.faces()) {
    for (const Ring2& ring : face) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
        if (on_outline(frame.flat(), p, q)) continue;
        Point3 a = frame.lift(p), b = frame.lift(q);
        if (CGAL::lexicographically_xyz_smaller(b, a)) std::swap(a, b);
        out.segments.push_back({t, front, true, a, b});
      }
    }
  }
}

}  // namespace

Face2 flat_face(const Region& region, const TriangleFrame& frame) {
  Face2 face;
  for (const auto& ring : region.rings) {
    face.emplace_back();
    for (const Point3& p : ring) face.back().push_back(frame.frame()(p));
  }
  return face;
}

FlatSet whole_of(const TriangleFrame& frame) { return FlatSet(frame.twice_area(), {Face2{frame.outline()}}); }

SideFaces side_faces(const FlatSet& visible, const TriangleFrame& frame, std::uint32_t piece, bool front) {
  SideFaces out;
  add_faces(visible, true, frame, piece, front, out);
  add_faces(subtract(whole_of(frame), visible), false, frame, piece, front, out);
  add_borders(visible, frame, piece, front, out);
  out.sort();
  return out;
}

}  // namespace clues::reference
