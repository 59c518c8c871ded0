#include "fastpath/visibility/labels/one_label.h"

#include <algorithm>
#include <array>
#include <vector>

namespace clues::fastpath {

namespace {

constexpr std::uint64_t kLabelSeed = 0x1d;

IntervalBox to_intervals(const Point& p) { return {Interval(p[0]), Interval(p[1]), Interval(p[2])}; }
IntervalBox to_intervals(const Box& b) { return hull(to_intervals(b.low), to_intervals(b.high)); }

std::array<IntervalBox, 3> to_intervals(const Corners& t) {
  return {to_intervals(t[0]), to_intervals(t[1]), to_intervals(t[2])};
}

std::vector<IntervalBox> to_intervals(std::span<const ExactPoint> points) {
  std::vector<IntervalBox> boxes;
  for (const ExactPoint& p : points) boxes.push_back(p.approximate());
  return boxes;
}

std::array<ExactPoint, 3> points_of(const Corners& t) { return {ExactPoint(t[0]), ExactPoint(t[1]), ExactPoint(t[2])}; }

std::vector<Around> around(std::span<const IntervalBox> boxes) {
  std::vector<Around> around;
  for (const IntervalBox& box : boxes) around.emplace_back(box);
  return around;
}

// Whether the closed piece surely has no point inside the polygon. Decided exactly, as it is asked only where the two may touch: nearly always that is at the border of the polygon.
bool misses_inside(const ValidPiece& piece, std::span<const ExactPoint> polygon) {
  const Plane& h = *piece.on->plane;
  std::vector<int> side;
  for (const ExactPoint& p : polygon) side.push_back(h.side(p));
  const auto any = [&](int sign) { return std::find(side.begin(), side.end(), sign) != side.end(); };
  if (!any(1) || !any(-1)) return any(1) || any(-1);
  // The plane meets the inside in an open segment.
  std::array<ExactPoint, 2> ends;
  std::size_t found = 0;
  for (std::size_t i = 0; i < side.size(); ++i) {
    const std::size_t j = (i + 1) % side.size();
    if (side[i] == 0) ends[found++] = polygon[i];
    if (side[i] * side[j] < 0) ends[found++] = ExactPoint::on_plane(polygon[i], polygon[j], h);
  }
  // All of it strictly beyond the line of a side of the outline, which is convex.
  const auto is_beyond = [&](const ExactPoint& a, const ExactPoint& b) {
    const int first = piece.on->turn(&a, &b, ends.data()), second = piece.on->turn(&a, &b, &ends[1]);
    return first <= 0 && second <= 0 && first + second < 0;
  };
  const ExactPoint& c = *piece.on->center;
  if (is_beyond(c, *piece.ray0) || is_beyond(*piece.ray1, c)) return true;
  if (piece.near0 && is_beyond(*piece.near1, *piece.near0)) return true;
  if (piece.blocker < 0) return false;
  const Blocker& blocker = piece.on->blockers[static_cast<std::size_t>(piece.blocker)];
  return is_beyond(*blocker.u, *blocker.w);
}

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

SetLabel OneLabel::of_inside(std::span<const ExactPoint> polygon, const Box& about) const {
  if (any_meets_inside(polygon, [](std::size_t) { return true; })) return SetLabel::visible;
  if (piece_may_touch(to_intervals(about))) return SetLabel::elsewhere;
  return of_uncut(to_intervals(polygon), ExactPoint(middle_of(about)));
}

SetLabel OneLabel::of_beside(const Corners& triangle, const Box& about) const {
  const std::array<ExactPoint, 3> corners = points_of(triangle);
  const IntervalBox place = to_intervals(about);
  const Around around_place(place);
  const auto is_across = [&](std::size_t i) { return !piece_in_plane(i, corners); };
  if (any_meets_inside(corners, is_across)) return SetLabel::visible;
  if (pieces_.any([&](const IntervalBox& b) { return overlap(b, place); },
                  [&](std::size_t i) { return pieces_.bounds(i).may_touch(around_place) && is_across(i); }))
    return SetLabel::elsewhere;
  return of_uncut(to_intervals(corners), ExactPoint(middle_of(about)));
}

bool OneLabel::piece_in_plane(std::size_t piece, std::span<const ExactPoint> corners) const {
  const Plane& h = *pieces_.pieces()[piece].on->plane;
  return std::all_of(corners.begin(), corners.end(), [&](const ExactPoint& p) { return h.side(p) == 0; });
}

bool OneLabel::piece_may_touch(const IntervalBox& box) const {
  const Around all(box);
  return pieces_.any([&](const IntervalBox& b) { return overlap(b, box); },
                     [&](std::size_t i) { return pieces_.bounds(i).may_touch(all); });
}

template <class Counts>
bool OneLabel::any_meets_inside(std::span<const ExactPoint> polygon, const Counts& counts) const {
  return any_may_touch(to_intervals(polygon),
                       [&](std::size_t i) { return counts(i) && !misses_inside(pieces_.pieces()[i], polygon); });
}

bool OneLabel::piece_may_touch(const Corners& triangle) const {
  return any_may_touch(to_intervals(triangle), [](std::size_t) { return true; });
}

template <class Test>
bool OneLabel::any_may_touch(std::span<const IntervalBox> polygon, const Test& test) const {
  const std::vector<Around> corners = around(polygon);
  IntervalBox box = polygon.front();
  for (const IntervalBox& corner : polygon) box = hull(box, corner);
  const IntervalBox normal = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
  return pieces_.any([&](const IntervalBox& b) { return overlap(b, box) && may_be_zero(dot(normal, b - polygon[0])); },
                     [&](std::size_t i) { return pieces_.bounds(i).may_touch(corners) && test(i); });
}

}  // namespace clues::fastpath
