#include "fastpath/visibility/labels/one_label.h"

#include <algorithm>
#include <array>

namespace clues::fastpath {

namespace {

constexpr std::uint64_t kLabelSeed = 0x1d;

IntervalBox to_intervals(const Point& p) { return {Interval(p[0]), Interval(p[1]), Interval(p[2])}; }
IntervalBox to_intervals(const Box& b) { return hull(to_intervals(b.low), to_intervals(b.high)); }

std::array<IntervalBox, 3> to_intervals(const Corners& t) {
  return {to_intervals(t[0]), to_intervals(t[1]), to_intervals(t[2])};
}

std::array<Around, 3> around(const std::array<IntervalBox, 3>& t) { return {Around(t[0]), Around(t[1]), Around(t[2])}; }

}  // namespace

OneLabel::OneLabel(const Walker& walker, const PieceSet& pieces, const LeftOut& left_out)
    : walker_(walker), pieces_(pieces), left_out_(left_out) {}

SetLabel OneLabel::of_uncut(std::span<const IntervalBox> hull, const ExactPoint& p) const {
  Pool pool;
  const Walker::Label label = walker_.label(&p, left_out_, pool, kLabelSeed);
  if (label == Walker::Label::visible) return SetLabel::visible;
  // With the point, which may be beside the set: each might be outside of an A(x) that lies between the two.
  std::vector<IntervalBox> together(hull.begin(), hull.end());
  together.push_back(p.approximate());
  if (label == Walker::Label::hidden && left_out_.surely_misses(together)) return SetLabel::hidden;
  ++unresolved_;
  return SetLabel::visible;
}

SetLabel OneLabel::of_box(const Box& box) const {
  const IntervalBox all = to_intervals(box);
  if (piece_may_touch(all)) return SetLabel::visible;
  return of_uncut({&all, 1}, ExactPoint(middle_of(box)));
}

SetLabel OneLabel::of_inside(const Corners& triangle, const Box& about) const {
  if (piece_may_touch(triangle)) return SetLabel::visible;
  if (piece_may_touch(to_intervals(about))) return SetLabel::elsewhere;
  return of_uncut(to_intervals(triangle), ExactPoint(middle_of(about)));
}

SetLabel OneLabel::of_beside(const Corners& triangle, const Box& about) const {
  const std::array<IntervalBox, 3> corner = to_intervals(triangle);
  const IntervalBox all = hull(hull(corner[0], corner[1]), corner[2]), place = to_intervals(about);
  const auto touches_across = [&](const auto& what) {
    return [&](std::size_t i) { return pieces_.bounds(i).may_touch(what) && !piece_in_plane(i, triangle); };
  };
  if (pieces_.any([&](const IntervalBox& b) { return overlap(b, all); }, touches_across(around(corner))))
    return SetLabel::visible;
  if (pieces_.any([&](const IntervalBox& b) { return overlap(b, place); }, touches_across(Around(place))))
    return SetLabel::elsewhere;
  return of_uncut(corner, ExactPoint(middle_of(about)));
}

bool OneLabel::piece_in_plane(std::size_t piece, const Corners& triangle) const {
  const Plane& h = *pieces_.pieces()[piece].on->plane;
  return std::all_of(triangle.begin(), triangle.end(), [&](const Point& p) { return h.side(ExactPoint(p)) == 0; });
}

bool OneLabel::piece_may_touch(const IntervalBox& box) const {
  const Around all(box);
  return pieces_.any([&](const IntervalBox& b) { return overlap(b, box); },
                     [&](std::size_t i) { return pieces_.bounds(i).may_touch(all); });
}

bool OneLabel::piece_may_touch(const Corners& triangle) const {
  const std::array<IntervalBox, 3> corner = to_intervals(triangle);
  const std::array<Around, 3> corners = around(corner);
  const IntervalBox box = hull(hull(corner[0], corner[1]), corner[2]);
  const IntervalBox normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  return pieces_.any([&](const IntervalBox& b) { return overlap(b, box) && may_be_zero(dot(normal, b - corner[0])); },
                     [&](std::size_t i) { return pieces_.bounds(i).may_touch(corners); });
}

}  // namespace clues::fastpath
