#include "reference/visibility/hidden/umbra_slice.h"

#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>

#include <array>
#include <map>
#include <utility>

namespace clues::reference {

using exact::FT;
using exact::Plane3;
using exact::Point2;
using exact::Point3;
using exact::Vector3;

namespace {

enum class Depth : std::uint8_t { unknown, outside, inside };

using SliceTraits = CGAL::Arr_segment_traits_2<exact::Kernel>;
using SliceArrangement = CGAL::Arrangement_2<SliceTraits, CGAL::Arr_face_extended_dcel<SliceTraits, Depth>>;

// Directed segments, added up: along each line a step function of the times it is walked upwards less downwards. What
// cancels is gone, and what is left does not overlap.
class FlatBorder {
 public:
  void add(const Point2& a, const Point2& b) {
    if (a == b) return;
    const bool up = a < b;
    const Point2 &lo = up ? a : b, &hi = up ? b : a;
    auto& steps = lines_[key_of(lo, hi)];
    steps[lo] += up ? 1 : -1;
    steps[hi] -= up ? 1 : -1;
  }

  // Where the sum is odd: a border between inside and outside.
  std::vector<std::pair<Point2, Point2>> segments() const {
    std::vector<std::pair<Point2, Point2>> out;
    for (const auto& [key, steps] : lines_) {
      int height = 0;
      const Point2* from = nullptr;
      for (const auto& [p, change] : steps) {
        if (change == 0) continue;
        if (height % 2 != 0) out.emplace_back(*from, p);
        height += change;
        from = &p;
      }
    }
    return out;
  }

 private:
  using Key = std::array<FT, 3>;
  // The same for two pairs of points exactly when their lines are.
  static Key key_of(const Point2& lo, const Point2& hi) {
    const FT dx = hi.x() - lo.x(), dy = hi.y() - lo.y();
    if (CGAL::is_zero(dx)) return {FT(0), FT(1), exact::collapsed(lo.x())};
    const FT slope = exact::collapsed(dy / dx);
    return {FT(1), slope, exact::collapsed(lo.y() - slope * lo.x())};
  }
  std::map<Key, std::map<Point2, int>> lines_;
};

Ring2 ring_of(SliceArrangement::Ccb_halfedge_const_circulator start) {
  Ring2 ring;
  auto h = start;
  do {
    ring.push_back(h->source()->point());
  } while (++h != start);
  return ring;
}

void mark_depths(SliceArrangement& arrangement) {
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) f->set_data(Depth::unknown);
  std::vector<SliceArrangement::Face_handle> open{arrangement.unbounded_face()};
  open.front()->set_data(Depth::outside);
  const auto cross = [&open](SliceArrangement::Ccb_halfedge_circulator start) {
    const Depth beyond = start->face()->data() == Depth::inside ? Depth::outside : Depth::inside;
    auto h = start;
    do {
      const auto next = h->twin()->face();
      if (next->data() != Depth::unknown) continue;
      next->set_data(beyond);
      open.push_back(next);
    } while (++h != start);
  };
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    if (!face->is_unbounded()) cross(face->outer_ccb());
    for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole) cross(*hole);
  }
}

}  // namespace

std::vector<std::vector<Point3>> in_space(const Plane3& plane, const std::vector<Ring2>& face) {
  const PlaneFrame frame(plane);
  std::vector<std::vector<Point3>> rings;
  for (const Ring2& ring : face) {
    rings.emplace_back();
    for (const Point2& q : ring) rings.back().push_back(frame.lifted(plane, q));
  }
  return rings;
}

UmbraSlice slice_of(const Umbra& umbra, const Plane3& plane, Approach approach) {
  const PlaneFrame frame(plane);
  const Vector3 up = plane.orthogonal_vector();
  FlatBorder border;
  for (const UmbraFacet& facet : umbra.facets) {
    std::array<FT, 3> value;
    std::array<bool, 3> above{};
    for (std::size_t i = 0; i < 3; ++i) {
      value[i] = exact::value_at(plane, facet.corners[i]);
      // Just before the plane, its own points are below; just behind it they are above.
      above[i] = approach == Approach::before ? CGAL::is_positive(value[i]) : !CGAL::is_negative(value[i]);
    }
    std::vector<Point3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (above[i] == above[j]) continue;
      ends.push_back(exact::collapsed(facet.corners[i] +
                                      (value[i] / (value[i] - value[j])) * (facet.corners[j] - facet.corners[i])));
    }
    if (ends.size() != 2) continue;
    // With the umbra on its left: it lies behind the facet.
    const Vector3 outside =
        CGAL::cross_product(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
    if (CGAL::is_negative(CGAL::cross_product(up, outside) * (ends[1] - ends[0]))) std::swap(ends[0], ends[1]);
    border.add(frame(ends[0]), frame(ends[1]));
  }
  SliceArrangement arrangement;
  std::vector<SliceTraits::X_monotone_curve_2> curves;
  for (const auto& [a, b] : border.segments()) curves.emplace_back(a, b);
  CGAL::insert(arrangement, curves.begin(), curves.end());
  mark_depths(arrangement);

  UmbraSlice slice{{}, FT(0)};
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    if (f->data() != Depth::inside) continue;
    std::vector<Ring2> rings{ring_of(f->outer_ccb())};
    for (auto hole = f->inner_ccbs_begin(); hole != f->inner_ccbs_end(); ++hole) rings.push_back(ring_of(*hole));
    for (const Ring2& ring : rings) slice.twice_area += twice_area(ring);
    slice.faces.push_back(std::move(rings));
  }
  slice.twice_area = exact::collapsed(slice.twice_area);
  return slice;
}

}  // namespace clues::reference
