#include "reference/visibility/wedges/wedge_set.h"

#include <algorithm>

namespace clues::reference {

using exact::Point2;
using exact::Point3;

namespace {

const std::vector<std::uint32_t> kNone;

// yes if all signs are positive, no if one is negative, degenerate otherwise.
Meets all_positive(std::initializer_list<CGAL::Orientation> signs) {
  Meets result = Meets::yes;
  for (const CGAL::Orientation s : signs) {
    if (s == CGAL::NEGATIVE) return Meets::no;
    if (s == CGAL::ZERO) result = Meets::degenerate;
  }
  return result;
}

// A box around the part of the piece inside the bounds of scene and cell: all that a sight line can meet.
CGAL::Bbox_3 box_of(const Wedge& w, const CGAL::Bbox_3& bounds) {
  CGAL::Bbox_3 box = w.near0.bbox() + w.near1.bbox();
  if (!w.unbounded) return box + w.far0.bbox() + w.far1.bbox();
  // An unbounded strip runs to the bounds: extend the box, per axis, wherever one of its rays goes.
  double lo[3], hi[3];
  for (int i = 0; i < 3; ++i) {
    lo[i] = box.min(i);
    hi[i] = box.max(i);
    for (const Point3* r : {&w.on_ray0, &w.on_ray1}) {
      const CGAL::Sign s = CGAL::sign((*r)[i] - w.center[i]);
      if (s == CGAL::POSITIVE) hi[i] = std::max(hi[i], bounds.max(i));
      if (s == CGAL::NEGATIVE) lo[i] = std::min(lo[i], bounds.min(i));
    }
  }
  return {lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]};
}

}  // namespace

Meets covers(const ValidPiece& piece, const Point3& x) {
  const OnWedge& on = *piece.on_wedge;
  const Point2 q = on.frame(x), n0 = on.frame(piece.wedge.near0), n1 = on.frame(piece.wedge.near1);
  const auto sector = {CGAL::orientation(on.center, piece.strip.on_ray0.q, q),
                       CGAL::orientation(piece.strip.on_ray1.q, on.center, q)};
  Meets result = all_positive(sector);
  const auto also = [&](const Meets m) {
    if (result != Meets::no && m != Meets::yes) result = m;
  };
  if (piece.wedge.near0 != piece.wedge.near1) also(all_positive({CGAL::orientation(n1, n0, q)}));
  if (piece.strip.blocker) {
    const Blocker& b = on.blockers[*piece.strip.blocker];
    also(all_positive({CGAL::orientation(b.u.q, b.w.q, q)}));
  }
  return result;
}

Meets crosses(const ValidPiece& piece, const Point3& m, const Point3& p, const exact::Vector3& off) {
  const Wedge& w = piece.wedge;
  const CGAL::Oriented_side at_p = w.plane.oriented_side(p);
  if (at_p == CGAL::ON_NEGATIVE_SIDE) return Meets::no;
  const CGAL::Oriented_side at_m = w.plane.oriented_side(m);
  if (at_m == CGAL::ON_POSITIVE_SIDE) return Meets::no;
  if (at_p == CGAL::ON_ORIENTED_BOUNDARY) return covers(piece, p) == Meets::no ? Meets::no : Meets::degenerate;
  if (at_m == CGAL::ON_ORIENTED_BOUNDARY) return covers(piece, m) == Meets::no ? Meets::no : Meets::degenerate;
  // m -> p runs along the normal; it passes left of a directed line of the plane exactly when the orientation is positive. That is linear in p:
  // where it is zero, the line from m to a point just off p tells.
  const auto passes = [&](const Point3& a, const Point3& b) {
    const CGAL::Orientation o = CGAL::orientation(m, p, a, b);
    return o == CGAL::ZERO && off != CGAL::NULL_VECTOR ? CGAL::orientation(m, m + off, a, b) : o;
  };
  Meets result = all_positive({passes(w.center, w.on_ray0), passes(w.on_ray1, w.center)});
  const auto also = [&](const Point3& a, const Point3& b) {
    if (result == Meets::no) return;
    const Meets r = all_positive({passes(a, b)});
    if (r != Meets::yes) result = r;
  };
  if (w.near0 != w.near1) also(w.near1, w.near0);
  if (piece.strip.blocker) {
    const Blocker& b = piece.on_wedge->blockers[*piece.strip.blocker];
    also(b.u.p, b.w.p);
  }
  return result;
}

void WedgeSet::add(std::vector<ValidPiece> batch) {
  const std::size_t begin = pieces_.size();
  std::vector<CGAL::Bbox_3> boxes;
  for (ValidPiece& piece : batch) {
    const auto id = static_cast<std::uint32_t>(pieces_.size());
    boxes.push_back(box_of(piece.wedge, bounds_));
    for (const std::uint32_t t : piece.on_wedge->coplanar_pieces) {
      const bool front =
          CGAL::is_positive(scene_->complex().planes[t].orthogonal_vector() * piece.wedge.plane.orthogonal_vector());
      upon_[{t, front}].push_back(id);
    }
    for (const std::uint32_t e : piece.on_wedge->coplanar_edges) along_[e].push_back(id);
    pieces_.push_back(std::move(piece));
  }
  batches_.push_back({begin, exact::BoxTree(std::move(boxes))});
}

const std::vector<std::uint32_t>& WedgeSet::upon(std::uint32_t t, bool front) const {
  const auto it = upon_.find({t, front});
  return it == upon_.end() ? kNone : it->second;
}

const std::vector<std::uint32_t>& WedgeSet::along(std::uint32_t e) const {
  const auto it = along_.find(e);
  return it == along_.end() ? kNone : it->second;
}

}  // namespace clues::reference
