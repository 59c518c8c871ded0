#include "fastpath/visibility/map/sides.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "fastpath/visibility/map/regions.h"
#include "fastpath/visibility/points/near_enough.h"

namespace clues::fastpath {
namespace {

using CornerPoints = std::array<const ExactPoint*, 3>;

CornerPoints corners_of(const LocalScene& scene, std::uint32_t t) {
  return {&scene.corner(t, 0), &scene.corner(t, 1), &scene.corner(t, 2)};
}

// Sums of 1.
constexpr std::array<std::array<double, 3>, 4> kWeights{{{0.3671875, 0.3359375, 0.296875},
                                                         {0.203125, 0.484375, 0.3125},
                                                         {0.28125, 0.1875, 0.53125},
                                                         {0.5625, 0.25, 0.1875}}};

Exact3 inner_point(const CornerPoints& corners, const std::array<double, 3>& weights) {
  return Rational(weights[0]) * corners[0]->exact() + Rational(weights[1]) * corners[1]->exact() +
         Rational(weights[2]) * corners[2]->exact();
}

// Places beside a point of the inside of a piece, nearer and nearer: first with double coordinates, then exactly.
class PlacesBeside {
 public:
  static constexpr int kDoubles = 3, kLevels = 2 * kDoubles;

  PlacesBeside(const LocalScene& scene, std::uint32_t t) : plane_(scene.planes[t]), corners_(corners_of(scene, t)) {
    up_ = plane_.normal_estimate();
    up_size_ = length_estimate(up_);
    for (std::size_t i = 0; i < 3; ++i) at_[i] = corners_[i]->estimate();
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) extent_ = std::max(extent_, std::fabs(at_[i][k] - at_[(i + 1) % 3][k]));
    }
  }

  int first_level() const { return up_size_ > 0 ? 0 : kDoubles; }
  // In front (way = 1) of the point with these weights, or behind it (-1).
  ExactPoint place(const std::array<double, 3>& weights, int way, int level) const {
    if (level >= kDoubles)
      return ExactPoint::lifted(ExactPoint(inner_point(corners_, weights)), *corners_[0],
                                std::ldexp(1.0, -24 * (level - kDoubles + 1)), plane_, way);
    const double step = std::ldexp(extent_, -4 - 8 * level) * way;
    Point x;
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = weights[0] * at_[0][k] + weights[1] * at_[1][k] + weights[2] * at_[2][k] + step * (up_[k] / up_size_);
    return ExactPoint(x);
  }

 private:
  const Plane& plane_;
  CornerPoints corners_;
  std::array<Point, 3> at_{};  // estimates
  Point up_{};
  double up_size_ = 0, extent_ = 0;
};

}  // namespace

Sides::Cuts Sides::cuts() const {
  Cuts cut(scene_.pieces.size());
  for (const ValidPiece& piece : pieces_.pieces()) mark_traces(piece, cut);
  return cut;
}

void Sides::find_visible(Workers& workers) {
  const Cuts cut = cuts();
  // A piece of several triangles is looked at once, for all of them.
  std::vector<std::vector<std::uint32_t>> pieces_of(scene_.triangles);
  for (std::uint32_t t = 0; t < scene_.pieces.size(); ++t) {
    if (!scene_.pieces[t].dark) pieces_of[scene_.pieces[t].origins.front().triangle].push_back(t);
  }
  std::vector<std::vector<Lit>> found(scene_.triangles);
  workers.for_each(scene_.triangles, [&](std::size_t i, Workers::Worker&) { found[i] = lit_of(pieces_of[i], cut); });
  std::vector<bool> seen(scene_.triangles, false), met(scene_.triangles, false);
  for (const auto& list : found) {
    for (const Lit& l : list) {
      met[l.triangle] = true;
      if (l.counts) seen[l.triangle] = true;
    }
  }
  for (std::uint32_t t = 0; t < seen.size(); ++t) {
    if (seen[t] && wanted_[t]) visible.push_back(t);
    if (met[t] && wanted_[t]) lit.push_back(t);
  }
}

std::vector<std::uint32_t> Sides::in_doubt_of(const std::vector<std::uint32_t>& listed, const Walker& walker,
                                              Workers& workers) const {
  const Cuts cut = cuts();
  std::vector<std::vector<std::uint32_t>> pieces_of(scene_.triangles);
  for (std::uint32_t t = 0; t < scene_.pieces.size(); ++t) {
    for (const LocalOrigin& o : scene_.pieces[t].origins) pieces_of[o.triangle].push_back(t);
  }
  const auto shows = [&](std::uint32_t t, std::uint32_t triangle) {
    const LocalPiece& piece = scene_.pieces[t];
    if (piece.meets_cell) return true;
    return std::any_of(piece.origins.begin(), piece.origins.end(), [&](const LocalOrigin& o) {
      if (o.triangle != triangle) return false;
      for (const bool front : {true, false}) {
        if (!counts_for(mode_, o, front)) continue;
        if (piece.in_cell) return true;
        if (!scene_.faces_cell(t, front ? 1 : -1)) continue;
        if (cut[t][front ? 0 : 1].lit || is_seen_inside(t, front, walker)) return true;
      }
      return false;
    });
  };
  std::vector<char> shown(listed.size(), 0);
  workers.for_each(listed.size(), [&](std::size_t i, Workers::Worker&) {
    const auto& pieces = pieces_of[listed[i]];
    shown[i] = std::any_of(pieces.begin(), pieces.end(), [&](std::uint32_t t) { return shows(t, listed[i]); }) ? 1 : 0;
  });
  std::vector<std::uint32_t> in_doubt;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    if (shown[i] == 0) in_doubt.push_back(listed[i]);
  }
  return in_doubt;
}

// Whether a sight line that is free, or comes through a piece into its light, ends inside a piece of the surface.
bool Sides::is_seen_inside(std::uint32_t t, bool front, const Walker& walker) const {
  constexpr std::uint64_t kViewpoints = 8;
  for (const std::array<double, 3>& w : kWeights) {
    const ExactPoint q(inner_point(corners_of(scene_, t), w));
    for (std::uint64_t i = 0; i < kViewpoints; ++i) {
      const ExactPoint& v = *walker.viewpoint(i);
      if (scene_.planes[t].side(v) != (front ? 1 : -1)) continue;
      const LocalScene::Last last = scene_.last_crossing(v, q);
      if (last.degenerate) continue;
      if (!last.piece) return true;
      const Plane& h = scene_.planes[*last.piece];
      const ExactPoint m = ExactPoint::on_plane(v, q, h);
      if (walker.leg_crossed({&m, &q, nullptr, *last.piece, h.side(q), false, false}, 0) == Crossing::yes) return true;
    }
  }
  return false;
}

// By these pieces, one after the other, until nothing more can be learnt from them.
std::vector<Sides::Lit> Sides::lit_of(const std::vector<std::uint32_t>& ids, const Cuts& cut) {
  std::vector<Lit> found;
  const auto is_known = [&](const LocalOrigin& o) {
    return !wanted_[o.triangle] ||
           std::any_of(found.begin(), found.end(), [&](const Lit& l) { return l.triangle == o.triangle && l.counts; });
  };
  for (const std::uint32_t t : ids) {
    const LocalPiece& piece = scene_.pieces[t];
    for (const bool front : {true, false}) {
      if (std::all_of(piece.origins.begin(), piece.origins.end(), is_known)) break;
      if (!(piece.in_cell || piece.meets_cell || is_visible(t, front, cut[t][front ? 0 : 1]))) continue;
      for (const LocalOrigin& o : piece.origins)
        found.push_back({o.triangle, piece.meets_cell || counts_for(mode_, o, front)});
    }
  }
  return found;
}

// A trace along an edge of the piece cuts nothing, and several pieces may have it: which of them is lit there a walk says.
bool Sides::runs_along_an_edge(const Plane& plane, std::uint32_t t) const {
  int corners = 0;
  for (int i = 0; i < 3; ++i) corners += plane.side(scene_.corner(t, i)) == 0;
  return corners >= 2;
}

void Sides::mark_traces(const ValidPiece& piece, Cuts& cut) const {
  const OnWedge& on = *piece.on;
  const auto mark = [&](std::uint32_t t, bool front) {
    Cut& c = cut[t][front ? 0 : 1];
    if (piece.in_doubt) {
      c.planes.push_back(on.plane);
    } else {
      c.lit = true;
    }
  };
  if (piece.blocker >= 0) {
    const std::uint32_t t = on.blockers[static_cast<std::size_t>(piece.blocker)].piece;
    if (!runs_along_an_edge(*on.plane, t)) mark(t, scene_.planes[t].side(*on.center) > 0);
  }
  // A piece seen edge-on is cut on the side, or sides, on which the strip runs along it.
  for (const Radial& r : on.radials) {
    const int after = on.turn(piece.ray0, r.w), before = on.turn(r.w, piece.ray1);
    if (after < 0 || before < 0 || runs_along_an_edge(*on.plane, r.piece)) continue;
    if (!on.reaches(piece.blocker, r.u) || !on.reaches(piece.blocker, r.w)) continue;
    const bool front_is_ccw = decide([&]<class NT>() {
      const Vec3<NT> ccw = cross(normal_of<NT>(*on.plane), coordinates<NT>(*r.w) - coordinates<NT>(*on.center));
      return sign_of(NT(dot(normal_of<NT>(scene_.planes[r.piece]), ccw))) > 0;
    });
    if (before > 0) mark(r.piece, front_is_ccw);
    if (after > 0) mark(r.piece, !front_is_ccw);
  }
}

bool Sides::is_visible(std::uint32_t t, bool front, const Cut& cut) {
  const int side = front ? 1 : -1;
  if (!scene_.faces_cell(t, side)) return false;
  if (cut.lit) return true;
  if (cut.planes.empty()) return whole_side_visible(t, side);
  const std::vector<std::vector<Exact3>> parts = parts_between(t, cut.planes);
  return std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return part_visible(t, side, part); });
}

// Whether piece t, x on the given side of it, is all that divides x from q: no other surface and no wedge piece, but for
// those in planes that `leaves_out`; x in free space.
template <class LeavesOut>
bool Sides::nothing_else_between(const ExactPoint& x, const ExactPoint& q, std::uint32_t t, int side,
                                 const LeavesOut& leaves_out) const {
  const Plane& h = scene_.planes[t];
  if (h.side(x) != side || h.side(q) != -side || scene_.crosses(x, q, t) != Crossing::yes) return false;
  if (scene_.is_on_surface(x)) return false;
  const bool blocked = scene_.tree.any(SegmentTest(x, q), [&](std::uint32_t i) {
    return scene_.occluders[i] != t && scene_.crosses(x, q, scene_.occluders[i]) != Crossing::no;
  });
  return !blocked && !pieces_.may_meet(x, q, 0, leaves_out);
}

// By a place beside it.
bool Sides::whole_side_visible(std::uint32_t t, int side) {
  // A wedge piece in the plane of the piece lies on its back, as V has points in front.
  const auto behind_the_piece = [&](const Plane& wedge) {
    return wedge.side(scene_.corner(t, 0)) == 0 && wedge.side(scene_.corner(t, 1)) == 0 &&
           wedge.side(scene_.corner(t, 2)) == 0;
  };
  const PlacesBeside places(scene_, t);
  for (const std::array<double, 3>& w : kWeights) {
    int level = places.first_level();
    const auto p = near_enough(
        level, PlacesBeside::kLevels, [&](int at) { return places.place(w, side, at); },
        [&](const ExactPoint& x) {
          return nothing_else_between(x, places.place(w, -side, level), t, side, behind_the_piece);
        });
    if (!p) continue;
    ++walks;
    const std::array<IntervalBox, 3> corners{scene_.corner(t, 0).approximate(), scene_.corner(t, 1).approximate(),
                                             scene_.corner(t, 2).approximate()};
    return one_label_.of_uncut(corners, *p) != SetLabel::hidden;
  }
  ++fallbacks;
  return true;
}

// The piece cut along these planes into convex parts.
std::vector<std::vector<Exact3>> Sides::parts_between(std::uint32_t t, const std::vector<const Plane*>& planes) const {
  std::vector<std::vector<Exact3>> parts{
      {scene_.corner(t, 0).exact(), scene_.corner(t, 1).exact(), scene_.corner(t, 2).exact()}};
  for (const Plane* h : planes) {
    const auto height = [&](const Exact3& x) { return Rational(dot(h->normal_exact(), x - h->base().exact())); };
    std::vector<std::vector<Exact3>> cut;
    for (const std::vector<Exact3>& part : parts) {
      std::vector<Exact3> above, below;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Exact3 &p = part[i], &q = part[(i + 1) % part.size()];
        const Rational at_p = height(p), at_q = height(q);
        if (at_p >= 0) above.push_back(p);
        if (at_p <= 0) below.push_back(p);
        if (sign_of(at_p) * sign_of(at_q) >= 0) continue;
        above.push_back(p + Rational(at_p / (at_p - at_q)) * (q - p));
        below.push_back(above.back());
      }
      for (std::vector<Exact3>& half : {std::ref(above), std::ref(below)}) {
        if (half.size() >= 3) cut.push_back(std::move(half));
      }
    }
    parts = std::move(cut);
  }
  return parts;
}

// Whether a convex part of a side counts as visible, by a point beside it with nothing but the piece between that and the other side.
bool Sides::part_visible(std::uint32_t t, int side, const std::vector<Exact3>& part) {
  const Plane& h = scene_.planes[t];
  std::vector<IntervalBox> corners;
  for (const Exact3& x : part) corners.push_back(ExactPoint(x).approximate());
  for (int which = 1; which <= 4; ++which) {
    Exact3 sum = Rational(0) * part[0];
    Rational all(0);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Rational weight(static_cast<double>(7 + (static_cast<int>(i) * 5 * which + which) % 11));
      sum = sum + weight * part[i];
      all += weight;
    }
    const ExactPoint inner(Rational(1 / all) * sum);
    const auto beside = [&](int way, int level) {
      return ExactPoint::lifted(inner, scene_.corner(t, 0), std::ldexp(1.0, -8 - 24 * level), h, way);
    };
    int level = 0;
    const auto p = near_enough(
        level, 3, [&](int at) { return beside(side, at); },
        [&](const ExactPoint& x) {
          return nothing_else_between(x, beside(-side, level), t, side, [](const Plane&) { return false; });
        });
    if (!p) continue;
    ++walks;
    return one_label_.of_uncut(corners, *p) != SetLabel::hidden;
  }
  ++fallbacks;
  return true;
}

}  // namespace clues::fastpath
