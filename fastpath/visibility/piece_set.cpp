#include "fastpath/visibility/piece_set.h"

#include <algorithm>

namespace clues::fastpath {

namespace {

Interval& component(IntervalBox& b, int axis) { return axis == 0 ? b.x : axis == 1 ? b.y : b.z; }
template <class NT>
const NT& component(const Vec3<NT>& b, int axis) {
  return axis == 0 ? b.x : axis == 1 ? b.y : b.z;
}

}  // namespace

IntervalBox far_end(const ValidPiece& piece, const ExactPoint* on_ray) {
  const Blocker& b = piece.on->blockers[static_cast<std::size_t>(piece.blocker)];
  if (on_ray == b.u || on_ray == b.w) return on_ray->approximate();
  const auto& axes = piece.on->plane->axes();
  const IntervalBox &c = piece.on->center->approximate(), &u = b.u->approximate(), &w = b.w->approximate();
  const auto flat = [&](const IntervalBox& x, const IntervalBox& from) {
    return std::pair<Interval, Interval>(component(x, axes[0]) - component(from, axes[0]),
                                         component(x, axes[1]) - component(from, axes[1]));
  };
  const auto det = [](const auto& x, const auto& y) { return x.first * y.second - x.second * y.first; };
  const auto ray = flat(on_ray->approximate(), c);
  const Interval t = -det(ray, flat(u, c)) / det(ray, flat(w, u));
  const double low = t.inf() >= 0 ? std::min(t.inf(), 1.0) : 0, high = t.sup() <= 1 ? std::max(t.sup(), 0.0) : 1;
  return u + Interval(std::min(low, high), std::max(low, high)) * (w - u);
}

Point far_end_estimate(const ValidPiece& piece, const ExactPoint* on_ray) {
  const Blocker& b = piece.on->blockers[static_cast<std::size_t>(piece.blocker)];
  const IntervalBox near = far_end(piece, on_ray), all = hull(b.u->approximate(), b.w->approximate());
  Point middle{};
  bool narrow = true;
  for (int i = 0; i < 3; ++i) {
    const Interval &x = component(near, i), &side = component(all, i);
    middle[static_cast<std::size_t>(i)] = x.inf() + (x.sup() - x.inf()) / 2;
    narrow &= x.sup() - x.inf() <= 0x1p-40 * (side.sup() - side.inf()) || x.is_point();
  }
  if (narrow) return middle;
  // Where the ray's point is next to the centre intervals know little of its direction.
  const auto& axes = piece.on->plane->axes();
  const Exact3 &c = piece.on->center->exact(), &u = b.u->exact();
  const Exact3 along = b.w->exact() - u, ray = on_ray->exact() - c, to_u = u - c;
  const auto det = [&](const Exact3& x, const Exact3& y) {
    return Rational(component(x, axes[0]) * component(y, axes[1]) - component(x, axes[1]) * component(y, axes[0]));
  };
  return ExactPoint(u + Rational(-det(ray, to_u) / det(ray, along)) * along).estimate();
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
    Interval& side = component(piece.box, i);
    const Interval& limit = component(bounds, i);
    for (const ExactPoint* r : {piece.ray0, piece.ray1}) {
      const Interval way = component(r->approximate(), i) - component(c, i);
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
    const Blocker& blocker = piece.on->blockers[static_cast<std::size_t>(piece.blocker)];
    if (!left_of(*blocker.u, *blocker.w)) return Crossing::no;
  }
  return result;
}

void PieceSet::clear() {
  pieces_.clear();
  batches_.clear();
}

void PieceSet::add(std::vector<ValidPiece> batch) {
  if (batch.empty()) return;
  std::vector<IntervalBox> boxes;
  for (const ValidPiece& p : batch) boxes.push_back(p.box);
  batches_.push_back({pieces_.size(), BoxTree(boxes)});
  pieces_.insert(pieces_.end(), batch.begin(), batch.end());
}

}  // namespace clues::fastpath
