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

}  // namespace

OneLabel::OneLabel(const Walker& walker, const PieceSet& pieces, const LeftOut& left_out)
    : walker_(walker), pieces_(pieces), left_out_(left_out) {
  for (const ValidPiece& p : pieces.pieces()) piece_bounds_.push_back(bounds_of(p));
}

OneLabel::PieceBounds OneLabel::bounds_of(const ValidPiece& piece) {
  PieceBounds out;
  const IntervalBox n = piece.on->plane->normal_approximate(), c = piece.on->center->approximate();
  out.plane = {n, c};
  const auto left_of = [&](const ExactPoint& a, const ExactPoint& b) {
    out.inward.push_back({cross(n, b.approximate() - a.approximate()), a.approximate()});
  };
  left_of(*piece.on->center, *piece.ray0);
  left_of(*piece.ray1, *piece.on->center);
  if (piece.near0) left_of(*piece.near1, *piece.near0);
  if (piece.blocker >= 0) {
    const Blocker& b = piece.on->blockers[static_cast<std::size_t>(piece.blocker)];
    left_of(*b.u, *b.w);
  }
  return out;
}

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
    return [&](std::size_t i) { return piece_touches(i, what) && !piece_in_plane(i, triangle); };
  };
  if (pieces_.any([&](const IntervalBox& b) { return overlap(b, all); }, touches_across(corner)))
    return SetLabel::visible;
  if (pieces_.any([&](const IntervalBox& b) { return overlap(b, place); }, touches_across(place)))
    return SetLabel::elsewhere;
  return of_uncut(corner, ExactPoint(middle_of(about)));
}

bool OneLabel::piece_in_plane(std::size_t piece, const Corners& triangle) const {
  const Plane& h = *pieces_.pieces()[piece].on->plane;
  return std::all_of(triangle.begin(), triangle.end(), [&](const Point& p) { return h.side(ExactPoint(p)) == 0; });
}

bool OneLabel::piece_touches(std::size_t i, const IntervalBox& box) const {
  const PieceBounds& piece = piece_bounds_[i];
  return may_be_zero(piece.plane.at(box)) && std::all_of(piece.inward.begin(), piece.inward.end(),
                                                         [&](const HalfSpace& h) { return h.at(box).sup() >= 0; });
}

// Apart if all corners are strictly on one side of the piece's plane, or strictly outside one of its bounds.
bool OneLabel::piece_touches(std::size_t i, const std::array<IntervalBox, 3>& corner) const {
  const PieceBounds& piece = piece_bounds_[i];
  bool above = true, below = true;
  for (const IntervalBox& c : corner) {
    const Interval x = piece.plane.at(c);
    above &= x.inf() > 0;
    below &= x.sup() < 0;
  }
  if (above || below) return false;
  return std::none_of(piece.inward.begin(), piece.inward.end(), [&](const HalfSpace& h) {
    return std::all_of(corner.begin(), corner.end(), [&](const IntervalBox& c) { return h.at(c).sup() < 0; });
  });
}

bool OneLabel::piece_may_touch(const IntervalBox& box) const {
  return pieces_.any([&](const IntervalBox& b) { return overlap(b, box); },
                     [&](std::size_t i) { return piece_touches(i, box); });
}

bool OneLabel::piece_may_touch(const Corners& triangle) const {
  const std::array<IntervalBox, 3> corner = to_intervals(triangle);
  const IntervalBox box = hull(hull(corner[0], corner[1]), corner[2]);
  const IntervalBox normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  return pieces_.any([&](const IntervalBox& b) { return overlap(b, box) && may_be_zero(dot(normal, b - corner[0])); },
                     [&](std::size_t i) { return piece_touches(i, corner); });
}

}  // namespace clues::fastpath
