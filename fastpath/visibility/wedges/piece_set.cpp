#include "fastpath/visibility/wedges/piece_set.h"

#include <algorithm>

namespace clues::fastpath {

namespace {

const Blocker& blocker_of(const ValidPiece& piece) {
  return piece.on->blockers[static_cast<std::size_t>(piece.blocker)];
}

// Where the ray crosses the blocker: 0 at u, 1 at w.
template <class NT>
NT crossing(const ValidPiece& piece, const ExactPoint* on_ray) {
  const Blocker& b = blocker_of(piece);
  const auto& axes = piece.on->plane->axes();
  const auto flat = [&](const ExactPoint& x, const ExactPoint& from) {
    const Vec3<NT>&p = coordinates<NT>(x), &q = coordinates<NT>(from);
    return std::pair<NT, NT>(coordinate(p, axes[0]) - coordinate(q, axes[0]),
                             coordinate(p, axes[1]) - coordinate(q, axes[1]));
  };
  const auto det = [](const auto& x, const auto& y) { return NT(x.first * y.second - x.second * y.first); };
  const ExactPoint& c = *piece.on->center;
  const auto ray = flat(*on_ray, c);
  return NT(-det(ray, flat(*b.u, c)) / det(ray, flat(*b.w, *b.u)));
}

PieceBounds bounds_of(const ValidPiece& piece) {
  const ExactPoint& c = *piece.on->center;
  const Vec3<Interval>& n = piece.on->plane->normal_approximate();
  PieceBounds bounds(n, c);
  bounds.add_side(n, c, *piece.ray0);
  bounds.add_side(n, *piece.ray1, c);
  if (piece.near0) bounds.add_side(n, *piece.near1, *piece.near0);
  if (piece.blocker >= 0) bounds.add_side(n, *blocker_of(piece).u, *blocker_of(piece).w);
  return bounds;
}

}  // namespace

IntervalBox far_end(const ValidPiece& piece, const ExactPoint* on_ray) {
  const Blocker& b = blocker_of(piece);
  if (on_ray == b.u || on_ray == b.w) return on_ray->approximate();
  const IntervalBox &u = b.u->approximate(), &w = b.w->approximate();
  const auto t = crossing<Interval>(piece, on_ray);
  const double low = t.inf() >= 0 ? std::min(t.inf(), 1.0) : 0, high = t.sup() <= 1 ? std::max(t.sup(), 0.0) : 1;
  return u + Interval(std::min(low, high), std::max(low, high)) * (w - u);
}

Point far_end_estimate(const ValidPiece& piece, const ExactPoint* on_ray) {
  const Blocker& b = blocker_of(piece);
  const IntervalBox near = far_end(piece, on_ray), all = hull(b.u->approximate(), b.w->approximate());
  Point middle{};
  bool narrow = true;
  for (int i = 0; i < 3; ++i) {
    const Interval &x = coordinate(near, i), &side = coordinate(all, i);
    middle[static_cast<std::size_t>(i)] = x.inf() + (x.sup() - x.inf()) / 2;
    narrow &= x.sup() - x.inf() <= 0x1p-40 * (side.sup() - side.inf()) || x.is_point();
  }
  if (narrow) return middle;
  // Where the ray's point is next to the centre intervals know little of its direction.
  const Exact3& u = b.u->exact();
  return ExactPoint(u + crossing<Rational>(piece, on_ray) * (b.w->exact() - u)).estimate();
}

void set_box(ValidPiece& piece, const IntervalBox& bounds) {
  const IntervalBox c = piece.on->center->approximate();
  piece.box = c;
  if (piece.near0) piece.box = hull(piece.near0->approximate(), piece.near1->approximate());
  if (piece.blocker >= 0) {
    piece.box = hull(piece.box, hull(far_end(piece, piece.ray0), far_end(piece, piece.ray1)));
    return;
  }
  for (int i = 0; i < 3; ++i) {
    Interval& side = coordinate(piece.box, i);
    const Interval& limit = coordinate(bounds, i);
    for (const ExactPoint* r : {piece.ray0, piece.ray1}) {
      const Interval way = coordinate(r->approximate(), i) - coordinate(c, i);
      if (way.sup() > 0) side = Interval(side.inf(), std::max(side.sup(), limit.sup()));
      if (way.inf() < 0) side = Interval(std::min(side.inf(), limit.inf()), side.sup());
    }
  }
}

Crossing PieceSet::passes(const ValidPiece& piece, const ExactPoint& a, const ExactPoint& b) {
  Crossing result = Crossing::yes;
  const ExactPoint& c = *piece.on->center;
  const auto left_of = [&](const ExactPoint& u, const ExactPoint& w) {
    const int s = orientation(a, b, u, w);
    if (s == 0) result = Crossing::touch;
    return s >= 0;
  };
  if (!left_of(c, *piece.ray0) || !left_of(*piece.ray1, c)) return Crossing::no;
  if (piece.near0 && !left_of(*piece.near1, *piece.near0)) return Crossing::no;
  if (piece.blocker >= 0) {
    const Blocker& blocker = blocker_of(piece);
    if (!left_of(*blocker.u, *blocker.w)) return Crossing::no;
  }
  return result;
}

void PieceSet::clear() {
  pieces_.clear();
  bounds_.clear();
  batches_.clear();
}

void PieceSet::add(std::vector<ValidPiece> batch, Workers& workers) {
  constexpr std::size_t kAtOnce = 64;
  if (batch.empty()) return;
  Batch made{pieces_.size(), {}, std::vector<std::vector<PieceBounds>>((batch.size() + kAtOnce - 1) / kAtOnce)};
  std::vector<IntervalBox> boxes;
  boxes.reserve(batch.size());
  for (const ValidPiece& p : batch) boxes.push_back(p.box);
  workers.for_each(1 + made.bounds.size(), [&](std::size_t i, Workers::Worker&) {
    if (i == 0) {
      made.tree = BoxTree(std::move(boxes));
      return;
    }
    const std::size_t first = (i - 1) * kAtOnce, end = std::min(i * kAtOnce, batch.size());
    made.bounds[i - 1].reserve(end - first);
    for (std::size_t k = first; k < end; ++k) made.bounds[i - 1].push_back(bounds_of(batch[k]));
  });
  for (const auto& some : made.bounds) {
    for (const PieceBounds& bounds : some) bounds_.push_back(&bounds);
  }
  batches_.push_back(std::move(made));
  pieces_.insert(pieces_.end(), batch.begin(), batch.end());
}

}  // namespace clues::fastpath
