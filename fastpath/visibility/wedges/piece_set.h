// The valid wedge pieces found so far, and what walks ask of them (D14): is one crossed from H+ to H-, or met at all.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "fastpath/visibility/wedges/on_wedge.h"
#include "fastpath/visibility/wedges/piece_bounds.h"
#include "fastpath/visibility/wedges/piece_kind.h"
#include "fastpath/visibility/wedges/workers.h"

namespace clues::fastpath {

// One radial strip of a wedge: between two rays, from the near edge or the apex to the blocker.
struct ValidPiece {
  PieceKind kind = PieceKind::sv_me;
  int generation = 0;
  const OnWedge* on = nullptr;
  const ExactPoint *ray0 = nullptr, *ray1 = nullptr;    // points of the two rays
  const ExactPoint *near0 = nullptr, *near1 = nullptr;  // the whole near edge; none for an apex
  int blocker = -1;                                     // index into on->blockers
  bool holds_cell = false;                              // all of V lies in its plane: no sight line crosses it (T10)
  bool in_doubt = false;  // and whether it exists was not decided: what it ends at need not be visible there
  IntervalBox box{};      // of the part within the bounds
};

// `bounds` must hold every segment that will be asked about. O(1).
void set_box(ValidPiece& piece, const IntervalBox& bounds);
// Where the ray through `on_ray` ends at the blocker: an enclosure, and a point of doubles.
IntervalBox far_end(const ValidPiece& piece, const ExactPoint* on_ray);
Point far_end_estimate(const ValidPiece& piece, const ExactPoint* on_ray);

class PieceSet {
 public:
  void clear();
  // Adds and indexes a batch; with all threads.
  void add(std::vector<ValidPiece> batch, Workers& workers);
  const std::vector<ValidPiece>& pieces() const { return pieces_; }
  const PieceBounds& bounds(std::size_t i) const { return *bounds_[i]; }

  // Calls found(i) for every piece i whose box passes the test, until found returns true; then true.
  template <class Test, class Found>
  bool any(const Test& test, const Found& found) const {
    return std::any_of(batches_.begin(), batches_.end(), [&](const Batch& b) {
      return b.tree.any(test, [&](std::uint32_t i) { return found(b.begin + i); });
    });
  }

  // Whether the way from m to p crosses a piece from number `first` (the begin of a batch) on from H+ to H-. Where it starts in
  // the plane of a piece: crossed if `starts_on(plane)` says that this plane holds the surface at m; not crossed if `leaves_out(plane)`; else
  // touch, as for every other coincidence.
  template <class StartsOn, class LeavesOut>
  Crossing crossed(const ExactPoint& m, const ExactPoint& p, std::size_t first, const StartsOn& starts_on,
                   const LeavesOut& leaves_out) const {
    Crossing result = Crossing::no;
    const SegmentTest test(m, p);
    const Ends ends{Around(m.approximate()), Around(p.approximate())};
    for (const Batch& b : batches_) {
      if (b.begin < first) continue;
      const bool found = b.tree.any(test, [&](std::uint32_t i) {
        if (pieces_[b.begin + i].holds_cell || !bounds_[b.begin + i]->may_touch(ends)) return false;
        const Crossing c = crosses(pieces_[b.begin + i], m, p, starts_on, leaves_out);
        if (c == Crossing::touch) result = c;
        return c == Crossing::yes;
      });
      if (found) return Crossing::yes;
    }
    return result;
  }

  // Whether the way from m to p crosses a piece from H- to H+, or may.
  bool may_leave(const ExactPoint& m, const ExactPoint& p) const {
    const Ends ends{Around(m.approximate()), Around(p.approximate())};
    return any(SegmentTest(m, p), [&](std::size_t i) {
      const Plane& h = *pieces_[i].on->plane;
      return !pieces_[i].holds_cell && bounds_[i]->may_touch(ends) && h.side(m) > 0 && h.side(p) <= 0 &&
             passes(pieces_[i], p, m) != Crossing::no;
    });
  }

  // Whether the open segment meets a piece from number `first` on, in either direction, or may. Planes that `leaves_out` are skipped.
  template <class LeavesOut>
  bool may_meet(const ExactPoint& a, const ExactPoint& b, std::size_t first, const LeavesOut& leaves_out) const {
    const SegmentTest test(a, b);
    const Ends ends{Around(a.approximate()), Around(b.approximate())};
    for (const Batch& batch : batches_) {
      if (batch.begin < first) continue;
      const bool found = batch.tree.any(test, [&](std::uint32_t i) {
        if (!bounds_[batch.begin + i]->may_touch(ends)) return false;
        const ValidPiece& piece = pieces_[batch.begin + i];
        const Plane& h = *piece.on->plane;
        if (leaves_out(h)) return false;
        const int at_a = h.side(a), at_b = h.side(b);
        if (at_a == at_b && at_a != 0) return false;
        if (at_a == 0 && at_b == 0) return true;
        if (at_a == 0 || at_b == 0) return false;
        return (at_b > 0 ? passes(piece, a, b) : passes(piece, b, a)) != Crossing::no;
      });
      if (found) return true;
    }
    return false;
  }

 private:
  using Ends = std::array<Around, 2>;
  struct Batch {
    std::size_t begin;
    BoxTree tree;
    std::vector<std::vector<PieceBounds>> bounds;  // they are large: made in place, and never moved
  };

  template <class StartsOn, class LeavesOut>
  Crossing crosses(const ValidPiece& piece, const ExactPoint& m, const ExactPoint& p, const StartsOn& starts_on,
                   const LeavesOut& leaves_out) const {
    const Plane& h = *piece.on->plane;
    const int at_p = h.side(p);
    if (at_p < 0) return Crossing::no;
    const bool upon = filtered_sign(h.value_approximate(m)) == kUnsure && starts_on(h);
    const int at_m = upon ? 0 : h.side(m);
    if (at_m > 0 || (at_m == 0 && at_p == 0)) return Crossing::no;
    if (at_m == 0 && leaves_out(h)) return Crossing::no;
    const Crossing c = passes(piece, m, p);
    if (c == Crossing::no) return c;
    if (at_p == 0 || (at_m == 0 && !upon && !starts_on(h))) return Crossing::touch;
    return c;
  }

  // The line from a to b, along the normal of the piece's plane: through the piece, on its outline, or beside it.
  static Crossing passes(const ValidPiece& piece, const ExactPoint& a, const ExactPoint& b);

  std::vector<ValidPiece> pieces_;
  std::vector<const PieceBounds*> bounds_;  // of each
  std::vector<Batch> batches_;
};

}  // namespace clues::fastpath
