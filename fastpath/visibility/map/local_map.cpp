#include "fastpath/visibility/map/local_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "fastpath/visibility/labels/one_label.h"
#include "fastpath/visibility/map/regions.h"
#include "fastpath/visibility/points/near_enough.h"
#include "fastpath/visibility/search/search.h"
#include "fastpath/visibility/wedges/workers.h"
#include "scene/messages/error.h"

namespace clues::fastpath {

namespace {

IntervalBox to_box(const Box& b) {
  return {Interval(b.low[0], b.high[0]), Interval(b.low[1], b.high[1]), Interval(b.low[2], b.high[2])};
}

IntervalBox bounds_of(const LocalScene& scene, const Box* outside) {
  return outside ? hull(scene.bounds, to_box(*outside)) : scene.bounds;
}

Interval wider(const Interval& side, double by) { return side + Interval(-by, by); }

// What set_box needs: bounds of every segment that pieces are asked about. With L the largest side of what
// holds mesh and cell, and E that of the mesh alone, ends of segments are
// - corners of the mesh, points of V, of segments between these and those that follow, and places that the
//   caller asks about: in `given`;
// - beside a side of a piece (side_visible): E/16 off it, or exactly by 2^-21 E;
// - beside a contour edge (beside_edge): 2^-5 (1 + 2^-5) of its length, at most 0.06 E, or exactly by 2^-29
//   of the way across to the cell, at most 2 L, with 2^-5 of that, times 4 at most, along the normal: 2^-27
//   L;
// - beside x, on the way to another point (point_near): rounded to 2^-52 L;
// - beside a vertex on the way through V, perhaps beyond V (views_of_cell): L/32 in each coordinate. Each is
//   rounded, a few times, in the unit of the largest coordinate. So it is enough to add E/8 + L/16 and 2^-50
//   of the largest coordinate around the mesh. The box that the closure gives leaves E/2 (first_order.cpp),
//   which is as much where L is below 6 E and E is not next to the spacing of doubles.
IntervalBox bounds_of_segments(const LocalScene& scene, const IntervalBox& given) {
  if (scene.points.empty()) return given;
  const RoundedUp rounded_up;
  IntervalBox mesh = scene.points.front().approximate();
  for (const ExactPoint& p : scene.points) mesh = hull(mesh, p.approximate());
  const auto largest_side = [](const IntervalBox& b) {
    return std::max({b.x.sup() - b.x.inf(), b.y.sup() - b.y.inf(), b.z.sup() - b.z.inf()});
  };
  double largest = 0;
  for (const Interval* side : {&scene.bounds.x, &scene.bounds.y, &scene.bounds.z})
    largest = std::max({largest, std::fabs(side->inf()), std::fabs(side->sup())});
  const double by = largest_side(mesh) / 8 + largest_side(scene.bounds) / 16 + 0x1p-50 * largest;
  return hull(given, IntervalBox{wider(mesh.x, by), wider(mesh.y, by), wider(mesh.z, by)});
}

}  // namespace

class LocalMap::Parts {
 public:
  Parts(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const LocalMapOptions& o, const Box* outside)
      : options(o),
        scene(mesh, cell),
        wanted(mesh.triangles.size(), true),
        bounds(fastpath::bounds_of(scene, outside)),
        workers(scene),
        bounds_asked(bounds_of_segments(scene, bounds)),
        search(scene, bounds_asked, options, counts, workers) {
    make();
  }
  Parts(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& part,
        const LocalMapOptions& o, const std::vector<bool>& w)
      : options(o),
        scene(complex, whole, part),
        wanted(w),
        bounds(scene.bounds),
        workers(scene),
        bounds_asked(bounds_of_segments(scene, bounds)),
        search(scene, bounds_asked, options, counts, workers) {
    make();
  }

  void make() {
    const RoundedUp rounded_up;
    const std::uint64_t before = exact_decisions();
    counts.pieces = scene.pieces.size();
    counts.refined_triangles = scene.refined_triangles;
    search.run();
    one_label.emplace(search.walker(), search.pieces(), search.left_out());
    find_visible();
    counts.walks += side_walks;
    labels_of_sides = one_label->unresolved();
    counts.conservative_fallbacks += side_fallbacks + labels_of_sides;
    counts.exact_decisions = exact_decisions() - before;
  }

  WedgePiece estimated(ValidPiece p) const {
    set_box(p, bounds);
    WedgePiece out;
    out.kind = p.kind;
    out.generation = p.generation;
    const IntervalBox& n = p.on->plane->normal_approximate();
    out.normal_estimate = {(n.x.inf() + n.x.sup()) / 2, (n.y.inf() + n.y.sup()) / 2, (n.z.inf() + n.z.sup()) / 2};
    out.center_estimate = p.on->center->estimate();
    out.unbounded = p.blocker < 0;
    outline(p, out);
    out.box = {{p.box.x.inf(), p.box.y.inf(), p.box.z.inf()}, {p.box.x.sup(), p.box.y.sup(), p.box.z.sup()}};
    return out;
  }

  const LocalMapOptions options;
  LocalMapCounts counts;
  LocalScene scene;
  const std::vector<bool> wanted;  // by triangle
  IntervalBox bounds;              // of scene and cell, and of what the caller asks about
  Workers workers;
  IntervalBox bounds_asked;
  Search search;
  std::vector<std::uint32_t> visible, lit;
  std::optional<OneLabel> one_label;
  std::uint64_t labels_of_sides = 0;  // that are visible because nothing is known
  std::atomic<std::uint64_t> side_walks{0}, side_fallbacks{0};

 private:
  // A triangle that light meets; whether the side that it meets counts.
  struct Lit {
    std::uint32_t triangle = 0;
    bool counts = false;
  };

  // What cuts a side: a DM segment, beside which it is visible; else planes of wedges that are in doubt, and only separate (T10).
  struct Cut {
    bool lit = false;
    std::vector<const Plane*> planes;
  };
  using Cuts = std::vector<std::array<Cut, 2>>;  // by piece: front, back

  // D15. A side with a DM segment has a visible region: beside the segment, in H-. Any other has one label, or one on every part between the planes.
  void find_visible() {
    Cuts cut(scene.pieces.size());
    for (const ValidPiece& piece : search.pieces().pieces()) mark_traces(piece, cut);
    std::vector<std::vector<std::uint32_t>> pieces_of(scene.triangles);
    for (std::uint32_t t = 0; t < scene.pieces.size(); ++t)
      pieces_of[scene.pieces[t].origins.front().triangle].push_back(t);
    std::vector<std::vector<Lit>> found(scene.triangles);
    workers.for_each(scene.triangles, [&](std::size_t i, Workers::Worker&) { found[i] = lit_of(pieces_of[i], cut); });
    std::vector<bool> seen(scene.triangles, false), met(scene.triangles, false);
    for (const auto& list : found) {
      for (const Lit& l : list) {
        met[l.triangle] = true;
        if (l.counts) seen[l.triangle] = true;
      }
    }
    for (std::uint32_t t = 0; t < seen.size(); ++t) {
      if (seen[t] && wanted[t]) visible.push_back(t);
      if (met[t] && wanted[t]) lit.push_back(t);
    }
  }

  // By these pieces, one after the other, until nothing more can be learnt from them.
  std::vector<Lit> lit_of(const std::vector<std::uint32_t>& ids, const Cuts& cut) {
    std::vector<Lit> found;
    const auto is_known = [&](const LocalOrigin& o) {
      return !wanted[o.triangle] || std::any_of(found.begin(), found.end(),
                                                [&](const Lit& l) { return l.triangle == o.triangle && l.counts; });
    };
    for (const std::uint32_t t : ids) {
      const LocalPiece& piece = scene.pieces[t];
      for (const bool front : {true, false}) {
        if (std::all_of(piece.origins.begin(), piece.origins.end(), is_known)) break;
        if (!(piece.in_cell || piece.meets_cell || side_visible(t, front, cut[t][front ? 0 : 1]))) continue;
        for (const LocalOrigin& o : piece.origins)
          found.push_back({o.triangle, piece.meets_cell || counts_for(options.mode, o, front)});
      }
    }
    return found;
  }

  // A trace along an edge of the piece cuts nothing, and several pieces may have it: which of them is lit there a walk says.
  bool runs_along_an_edge(const Plane& plane, std::uint32_t t) const {
    int corners = 0;
    for (int i = 0; i < 3; ++i) corners += plane.side(scene.corner(t, i)) == 0;
    return corners >= 2;
  }

  void mark_traces(const ValidPiece& piece, Cuts& cut) const {
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
      if (!runs_along_an_edge(*on.plane, t)) mark(t, scene.planes[t].side(*on.center) > 0);
    }
    // A piece seen edge-on is cut on the side, or sides, on which the strip runs along it.
    for (const Radial& r : on.radials) {
      const int after = on.turn(piece.ray0, r.w), before = on.turn(r.w, piece.ray1);
      if (after < 0 || before < 0 || runs_along_an_edge(*on.plane, r.piece)) continue;
      if (!on.reaches(piece.blocker, r.u) || !on.reaches(piece.blocker, r.w)) continue;
      const bool front_is_ccw = decide([&]<class NT>() {
        const Vec3<NT> ccw = cross(normal_of<NT>(*on.plane), coordinates<NT>(*r.w) - coordinates<NT>(*on.center));
        return sign_of(NT(dot(normal_of<NT>(scene.planes[r.piece]), ccw))) > 0;
      });
      if (before > 0) mark(r.piece, front_is_ccw);
      if (after > 0) mark(r.piece, !front_is_ccw);
    }
  }

  bool side_visible(std::uint32_t t, bool front, const Cut& cut) {
    const Plane& h = scene.planes[t];
    const int side = front ? 1 : -1;
    // A side that no point of V is strictly in front of is reached by no sight line and no continuation (D8).
    const auto& s = scene.cell.vertices;
    if (std::none_of(s.begin(), s.end(), [&](const ExactPoint& v) { return h.side(v) == side; })) return false;
    if (cut.lit) return true;
    if (!cut.planes.empty()) {
      const std::vector<std::vector<Exact3>> parts = parts_between(t, cut.planes);
      return std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return part_visible(t, side, part); });
    }
    // A wedge piece in the plane of the piece lies on its back, as V has points in front.
    const auto behind_the_piece = [&](const Plane& wedge) {
      return wedge.side(scene.corner(t, 0)) == 0 && wedge.side(scene.corner(t, 1)) == 0 &&
             wedge.side(scene.corner(t, 2)) == 0;
    };
    const Point a = scene.corner(t, 0).estimate(), b = scene.corner(t, 1).estimate(), c = scene.corner(t, 2).estimate();
    const Vec3<Interval>& n = h.normal_approximate();
    const Point up{n.x.inf() + n.x.sup(), n.y.inf() + n.y.sup(), n.z.inf() + n.z.sup()};
    const double up_size = length_estimate(up);
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k)
      extent = std::max({extent, std::fabs(a[k] - b[k]), std::fabs(b[k] - c[k]), std::fabs(c[k] - a[k])});
    constexpr double kWeights[4][3] = {{0.3671875, 0.3359375, 0.296875},
                                       {0.203125, 0.484375, 0.3125},
                                       {0.28125, 0.1875, 0.53125},
                                       {0.5625, 0.25, 0.1875}};
    for (const auto& w : kWeights) {
      constexpr int kDoubles = 3;
      // On either side of the piece, with nothing but the piece between.
      const auto beside = [&](int way, int level) {
        if (level >= kDoubles)
          return ExactPoint::lifted(ExactPoint(inner_point(t, w)), scene.corner(t, 0),
                                    std::ldexp(1.0, -24 * (level - kDoubles + 1)), h, way);
        const double step = std::ldexp(extent, -4 - 8 * level) * way;
        Point x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = w[0] * a[k] + w[1] * b[k] + w[2] * c[k] + step * (up[k] / up_size);
        return ExactPoint(x);
      };
      int level = up_size > 0 ? 0 : kDoubles;
      const auto place = [&](int at) { return beside(side, at); };
      const auto p = near_enough(level, 2 * kDoubles, place, [&](const ExactPoint& x) {
        return nothing_else_between(x, beside(-side, level), t, side, behind_the_piece);
      });
      if (!p) continue;
      ++side_walks;
      const std::array<IntervalBox, 3> corners{scene.corner(t, 0).approximate(), scene.corner(t, 1).approximate(),
                                               scene.corner(t, 2).approximate()};
      return one_label->of_uncut(corners, *p) != SetLabel::hidden;
    }
    ++side_fallbacks;
    return true;
  }

  // Whether piece t, x on the given side of it, is all that divides x from q: no other surface and no wedge piece, but for
  // those in planes that `leaves_out`; x in free space.
  template <class LeavesOut>
  bool nothing_else_between(const ExactPoint& x, const ExactPoint& q, std::uint32_t t, int side,
                            const LeavesOut& leaves_out) const {
    const Plane& h = scene.planes[t];
    if (h.side(x) != side || h.side(q) != -side || scene.crosses(x, q, t) != Crossing::yes) return false;
    if (scene.is_on_surface(x)) return false;
    const bool blocked = scene.tree.any(SegmentTest(x, q), [&](std::uint32_t i) {
      return scene.occluders[i] != t && scene.crosses(x, q, scene.occluders[i]) != Crossing::no;
    });
    return !blocked && !search.pieces().may_meet(x, q, 0, leaves_out);
  }

  // The piece cut along these planes into convex parts.
  std::vector<std::vector<Exact3>> parts_between(std::uint32_t t, const std::vector<const Plane*>& planes) const {
    std::vector<std::vector<Exact3>> parts{
        {scene.corner(t, 0).exact(), scene.corner(t, 1).exact(), scene.corner(t, 2).exact()}};
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
  bool part_visible(std::uint32_t t, int side, const std::vector<Exact3>& part) {
    const Plane& h = scene.planes[t];
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
        return ExactPoint::lifted(inner, scene.corner(t, 0), std::ldexp(1.0, -8 - 24 * level), h, way);
      };
      int level = 0;
      const auto p = near_enough(
          level, 3, [&](int at) { return beside(side, at); },
          [&](const ExactPoint& x) {
            return nothing_else_between(x, beside(-side, level), t, side, [](const Plane&) { return false; });
          });
      if (!p) continue;
      ++side_walks;
      return one_label->of_uncut(corners, *p) != SetLabel::hidden;
    }
    ++side_fallbacks;
    return true;
  }

  Exact3 inner_point(std::uint32_t t, const double* weights) const {
    return Rational(weights[0]) * scene.corner(t, 0).exact() + Rational(weights[1]) * scene.corner(t, 1).exact() +
           Rational(weights[2]) * scene.corner(t, 2).exact();
  }

  // Where the ray from the centre through r crosses the near edge.
  static Point near_end(const ValidPiece& p, const Point& r) {
    const Point c = p.on->center->estimate(), a = p.near0->estimate(), b = p.near1->estimate();
    Point n{}, across{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = (a[j] - c[j]) * (b[k] - c[k]) - (a[k] - c[k]) * (b[j] - c[j]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      across[i] = n[j] * (r[k] - c[k]) - n[k] * (r[j] - c[j]);
    }
    double at_a = 0, at_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      at_a += across[i] * (a[i] - c[i]);
      at_b += across[i] * (b[i] - c[i]);
    }
    const double t = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  }

  // near 0, near 1, far 1, far 0
  static void outline(const ValidPiece& p, WedgePiece& out) {
    const Point c = p.on->center->estimate();
    const auto far = [&](const ExactPoint* ray) {
      if (p.blocker >= 0) return far_end_estimate(p, ray);
      const Point r = ray->estimate();
      double reach = HUGE_VAL;  // where the ray leaves the piece's box
      const double low[3] = {p.box.x.inf(), p.box.y.inf(), p.box.z.inf()},
                   high[3] = {p.box.x.sup(), p.box.y.sup(), p.box.z.sup()};
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = r[k] - c[k];
        if (d != 0) reach = std::min(reach, ((d > 0 ? high[k] : low[k]) - c[k]) / d);
      }
      if (!std::isfinite(reach)) reach = 1;
      return Point{c[0] + reach * (r[0] - c[0]), c[1] + reach * (r[1] - c[1]), c[2] + reach * (r[2] - c[2])};
    };
    if (!p.near0) {
      out.outline_estimate.push_back(c);
    } else {
      out.outline_estimate.push_back(near_end(p, p.ray0->estimate()));
      out.outline_estimate.push_back(near_end(p, p.ray1->estimate()));
    }
    out.outline_estimate.push_back(far(p.ray1));
    out.outline_estimate.push_back(far(p.ray0));
  }
};

const std::vector<std::uint32_t>& LocalMap::visible() const { return parts_->visible; }
std::vector<WedgePiece> LocalMap::pieces() const {
  const RoundedUp rounded_up;
  std::vector<WedgePiece> out;
  for (const ValidPiece& p : parts_->search.pieces().pieces()) out.push_back(parts_->estimated(p));
  return out;
}
const std::vector<std::uint32_t>& LocalMap::lit() const { return parts_->lit; }
const LocalMapCounts& LocalMap::counts() const { return parts_->counts; }
std::uint64_t LocalMap::conservative_labels() const {
  return parts_->one_label->unresolved() - parts_->labels_of_sides;
}

std::vector<LocalRegion> LocalMap::regions() const {
  const RoundedUp rounded_up;
  return make_regions(parts_->scene, parts_->search.pieces(), parts_->options.mode, parts_->wanted,
                      [&](std::span<const IntervalBox> region, const ExactPoint& p) {
                        return parts_->one_label->of_uncut(region, p) != Label::hidden;
                      });
}

LocalMap::Label LocalMap::label(const Point& p) const {
  const RoundedUp rounded_up;
  const ExactPoint at(p);
  return parts_->one_label->of_uncut({&at.approximate(), 1}, at);
}

LocalMap::Label LocalMap::label(const Box& box) const {
  const RoundedUp rounded_up;
  return parts_->one_label->of_box(box);
}

LocalMap::Label LocalMap::label_of_inside(const Corners& triangle, const Box& about) const {
  const RoundedUp rounded_up;
  return parts_->one_label->of_inside(triangle, about);
}

bool LocalMap::piece_may_touch(const Box& box) const {
  const RoundedUp rounded_up;
  return parts_->one_label->piece_may_touch(to_box(box));
}

bool LocalMap::piece_may_touch(const Corners& triangle) const {
  const RoundedUp rounded_up;
  return parts_->one_label->piece_may_touch(triangle);
}

LocalMap make_local_map(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const LocalMapOptions& options,
                        const Box* outside) {
  for (const Point& p : mesh.points) {
    for (const double x : p) {
      if (!std::isfinite(x))
        throw scene::Error(scene::ErrorCode::non_finite, "local map: a coordinate is not a finite number");
      if (std::fabs(x) >= 0x1p129)
        throw scene::Error(scene::ErrorCode::unsupported,
                           "local map: a coordinate is beyond 2^128; move the scene into the standard range first");
    }
  }
  return LocalMap(std::make_shared<const LocalMap::Parts>(mesh, cell, options, outside));
}

LocalMap make_local_map_in(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& part,
                           const LocalMapOptions& options, const std::vector<bool>& wanted) {
  return LocalMap(std::make_shared<const LocalMap::Parts>(complex, whole, part, options, wanted));
}

}  // namespace clues::fastpath
