#include "reference/visibility/labels/walk.h"

#include <algorithm>
#include <cmath>

#include "exact/cell/beside_nearest.h"
#include "exact/cell/cell_plane.h"
#include "exact/cell/direction_cone.h"
#include "exact/complex/simple_point.h"
#include "exact/mix.h"
#include "reference/visibility/labels/special_position.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::mix;
using exact::Point3;

namespace {

// Legs, besides the least that are asked for. What is longer has lost its way in a corner of several walls: of those that end, none was seen with more than ten.
constexpr std::int64_t kLongestWalk = 24;
constexpr int kDeep = 6;            // from this leg on it is looked for light close by
constexpr std::size_t kBeside = 4;  // in so many directions
constexpr int kCoincidences = 4;    // this many in a row, and a plane in common may be the reason
constexpr int kDoubtful = 12;       // walks to a point before it counts as visible
constexpr int kAttempts = 200;  // sight lines in special position come from coincidences; this many in a row mean a bug

}  // namespace

Walker::Walker(const exact::SceneQuery& scene, std::int64_t longest)
    : scene_(&scene), longest_(longest == exact::Dials::kOwn ? kLongestWalk : longest) {
  for (const Point3& v : scene.cell().vertices()) corners_.push_back(exact::to_double_estimate(v));
  if (scene.cell().dimension() == 2) in_cell_plane_.emplace(scene, scene.cell().facets()[0].plane);
}

Point3 Walker::choose(std::uint64_t seed, const std::optional<Point3>& anchor, const Good& good) const {
  const exact::ConvexCell& cell = scene_->cell();
  std::vector<int> weights;
  for (std::size_t i = 0; i < cell.vertices().size(); ++i) {
    seed = mix(seed);
    weights.push_back(1 + static_cast<int>(seed % 61));
  }
  const Point3 u = cell.interior_point(weights);
  if (!anchor || good(u)) return u;
  for (FT pull(1);;) {
    pull = pull / FT(8);
    const Point3 v = *anchor + pull * (u - *anchor);
    if (good(v)) return exact::collapsed(v);
  }
}

std::optional<Point3> Walker::generic_viewpoint(const std::vector<exact::Plane3>& sides, const Point3& p,
                                                bool off_planes, bool& special) const {
  const exact::ConvexCell& cell = scene_->cell();
  std::vector<Point3> part = cell.vertices();
  std::optional<SpecialPosition> own;
  if (cell.dimension() == 2 && cell.facets()[0].plane.has_on(p)) {
    part = exact::corners_of(cell, cell.facets()[0]);
  } else if (cell.dimension() == 1 && !CGAL::collinear(part[0], part[1], p)) {
    own.emplace(*scene_, exact::Plane3(part[0], part[1], p));
  } else {
    return std::nullopt;
  }
  for (const exact::Plane3& side : sides) part = exact::clipped(part, side);
  const SpecialPosition& position = own ? *own : *in_cell_plane_;
  if (!position.is_quick()) return std::nullopt;
  const auto found = position.free_viewpoint(part, p, off_planes);
  special = !found;
  return found;
}

std::vector<Point3> Walker::beneath(const Point3& p, const SurfaceSide& on) const {
  const exact::ConvexCell& cell = scene_->cell();
  const exact::Plane3& plane = scene_->complex().planes[on.piece];
  exact::Vector3 along = on.front ? plane.orthogonal_vector() : -plane.orthogonal_vector();
  Point3 foot;
  if (cell.dimension() == 2) {
    const exact::Plane3& h = cell.facets()[0].plane;
    const exact::Vector3 n = h.orthogonal_vector();
    foot = p - exact::value_at(h, p) / (n * n) * n;
    along = along - (along * n) / (n * n) * n;
  } else if (cell.dimension() == 1) {
    const Point3 &a = cell.vertices()[0], &b = cell.vertices()[1];
    const exact::Vector3 u = b - a;
    foot = a + ((p - a) * u) / (u * u) * u;
    along = (along * u) / (u * u) * u;
  } else {
    return {};
  }
  std::vector<Point3> points{foot};
  const FT steepness = along.squared_length();
  if (!CGAL::is_zero(steepness)) {
    const FT h = height(on, foot);
    const double high = std::sqrt(CGAL::to_double(CGAL::squared_distance(p, foot) / steepness));
    if (std::isfinite(high))
      points.push_back(foot + (FT(high) - (CGAL::is_positive(h) ? FT(0) : h / steepness)) * along);
  }
  std::erase_if(points, [&](const Point3& x) { return !cell.interior_contains(x); });
  for (Point3& x : points) x = exact::collapsed(x);
  return points;
}

FT Walker::height(const SurfaceSide& on, const Point3& x) const {
  const FT d = exact::value_at(scene_->complex().planes[on.piece], x);
  return on.front ? d : FT(-d);
}

void Walker::leaves(const SurfaceSide& side, const Leaving& visit) const {
  const std::vector<Point3>& s = scene_->cell().vertices();
  for (const Point3& inside : s) {
    const FT a = height(side, inside);
    if (!CGAL::is_positive(a)) continue;
    for (const Point3& other : s) {
      const FT c = height(side, other);
      if (!CGAL::is_positive(c) && visit(inside, inside + (a / (a - c)) * (other - inside))) return;
    }
  }
}

std::optional<Point3> Walker::anchor_beyond(const SurfaceSide& side, const SurfaceSide* also) const {
  const std::vector<Point3>& s = scene_->cell().vertices();
  std::vector<FT> a, b;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < s.size(); ++i) {
    a.push_back(height(side, s[i]));
    b.push_back(also ? height(*also, s[i]) : FT(1));
    if (CGAL::is_positive(a[i]) && CGAL::is_positive(b[i]) && (!best || a[i] > a[*best])) best = i;
  }
  if (best) return s[*best];
  if (!also) return std::nullopt;
  // No vertex is on both sides, but an edge of V, or a diagonal, may cross the space between the planes.
  std::optional<Point3> found;
  leaves(side, [&](const Point3& inside, const Point3& x) {
    if (!CGAL::is_positive(height(*also, x))) return false;
    FT pull = FT(1) / FT(2);
    const auto towards = [&] { return x + pull * (inside - x); };
    while (!CGAL::is_positive(height(*also, towards()))) pull = pull / FT(2);
    found = exact::collapsed(towards());
    return true;
  });
  return found;
}

// The crossing m of the segment from v to p, or a shorter rational point beside it that is the last crossing of another admissible sight
// line v'p. Without this the numbers would grow several times as long with every leg.
Point3 Walker::last_crossing(const Point3& v, const Point3& p, const exact::Hit& hit, const Good& good) const {
  const exact::Complex& complex = scene_->complex();
  const auto& c = complex.pieces[hit.piece].corners;
  const Point3 m = v + hit.t * (p - v);
  const std::array<Point3, 3> corners{complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]};
  // Where a sight line through it comes from, before that.
  const auto viewpoint_of = [&](const Point3& near, int level) -> std::optional<Point3> {
    if (scene_->cell().dimension() == 3) {
      const FT t = exact::simple_near(hit.t, level);
      if (t >= FT(1)) return std::nullopt;
      return p + (near - p) / (FT(1) - t);
    }
    const exact::Plane3& h = scene_->cell().facets()[0].plane;
    const FT at_p = exact::value_at(h, p), at_near = exact::value_at(h, near);
    if (CGAL::sign(at_p) * CGAL::sign(at_near) <= 0 || CGAL::abs(at_near) >= CGAL::abs(at_p)) return std::nullopt;
    return p + at_p / (at_p - at_near) * (near - p);
  };
  if (scene_->cell().dimension() >= 2) {
    for (int level = 1; level < exact::kSimpleLevels; ++level) {
      const auto near = exact::simple_in_triangle(m, corners, level);
      if (!near) continue;
      const auto from = viewpoint_of(*near, level);
      if (!from || !scene_->cell().interior_contains(*from) || !good(*from)) continue;
      if (scene_->crossings(*near, p).is_clear()) return *near;
    }
  }
  return exact::collapsed(m);
}

Walk Walker::walk(const Start& start, std::uint64_t seed, std::size_t least) const {
  const exact::Complex& complex = scene_->complex();
  const exact::ConvexCell& cell = scene_->cell();
  Walk walk;
  // Only a wedge piece upon the covering surface can light this edge (D14, rule 2), also where it lies on V: the surface may be one on V's border, and is meant from outside.
  if (start.contour && start.contour->cover) return walk;
  if (cell.contains(start.p)) {
    walk.ends_at_cell = true;
    return walk;
  }
  Point3 p = start.p;
  std::optional<SurfaceSide> surface = start.surface;
  const ContourEdge* contour = start.contour;
  for (int depth = 0;; ++depth) {
    const bool may_end_in_the_dark = walk.legs.size() >= least;
    if (const std::optional<Leg> leg = may_end_in_the_dark ? corner_leg(walk) : std::nullopt) {
      walk.legs.push_back(*leg);
      return walk;
    }
    if (depth == longest_ + static_cast<std::int64_t>(least)) {
      walk.unresolved = true;
      return walk;
    }
    std::optional<Point3> anchor;
    std::vector<exact::Plane3> sides;   // v is to be strictly on their positive sides
    std::optional<Point3> along;        // a v whose sight line leaves a groove at its end
    std::optional<SurfaceSide> before;  // the wall that the walk stood on before this one, if they share an edge
    if (surface) {
      anchor = anchor_beyond(*surface, nullptr);
      if (!anchor) return walk;
      const auto plane_of = [&](const SurfaceSide& side) {
        const exact::Plane3& plane = complex.planes[side.piece];
        return side.front ? plane : plane.opposite();
      };
      if (walk.legs.size() >= 2) {
        const Leg& previous = walk.legs[walk.legs.size() - 2];
        before = SurfaceSide{previous.piece, previous.front};
        const std::optional<Point3> both = anchor_beyond(*surface, &*before);
        if (both) {
          anchor = both;
        } else {
          const std::vector<Point3> ends = ends_of_groove(*surface, *before);
          if (const std::optional<Leg> leg = may_end_in_the_dark ? groove_leg(walk, ends) : std::nullopt) {
            walk.legs.push_back(*leg);
            return walk;
          }
          if (!ends.empty()) along = along_groove(p, *surface, *before, ends);
          before.reset();
        }
      }
      sides.push_back(plane_of(*surface));
      if (before) sides.push_back(plane_of(*before));
    } else if (contour) {
      // v so near the supporting plane that no incident piece lies between it and the supporting polygon.
      anchor = cell.vertices()[static_cast<std::size_t>(contour->touching.front())];
      const exact::Edge& e = complex.edges[contour->edge];
      const Point3 &a = complex.points[e.a], &b = complex.points[e.b], &s = *anchor;
      for (const std::uint32_t t : e.pieces) {
        const auto& c = complex.pieces[t].corners;
        const auto third = *std::find_if(c.begin(), c.end(), [&](auto i) { return i != e.a && i != e.b; });
        const exact::Plane3 plane(a, b, complex.points[third]);
        const auto at_s = plane.oriented_side(s);
        if (at_s != CGAL::ON_ORIENTED_BOUNDARY)
          sides.push_back(at_s == CGAL::ON_POSITIVE_SIDE ? plane : plane.opposite());
      }
    }
    const Good good = [&](const Point3& x) {
      return std::all_of(sides.begin(), sides.end(), [&](const exact::Plane3& h) { return h.has_on_positive_side(x); });
    };
    if (surface) {  // next to V few points of it may see p
      const auto sees = [&](const Point3& x) { return good(x) && scene_->crossings(x, p).is_clear(); };
      const std::vector<Point3> feet = beneath(p, *surface);
      walk.ends_at_cell = std::any_of(feet.begin(), feet.end(), sees);
      if (!walk.ends_at_cell && depth >= kDeep) {
        const auto beside = exact::weights_beside_nearest(
            corners_, exact::to_double_estimate(p), seed * 1000003 + static_cast<std::uint64_t>(depth) * 1009, kBeside);
        walk.ends_at_cell = std::any_of(beside.begin(), beside.end(), [&](const std::vector<double>& weights) {
          return sees(exact::collapsed(cell.interior_point(weights)));
        });
      }
      if (walk.ends_at_cell) return walk;
    }
    exact::SegmentAnswer answer;
    Point3 v;
    int attempt = 0;
    std::optional<Point3> generic;  // next to it are the right sight lines, where those from anywhere are not
    do {
      bool special = attempt == (cell.dimension() == 0 ? 1 : kAttempts);
      if (attempt == kCoincidences) generic = generic_viewpoint(sides, p, contour != nullptr, special);
      if (special) {
        // A flat cell, or a point, in a plane with what is before it: every sight line runs in that plane, along the edges that lie in it.
        walk.unresolved = walk.special = true;
        return walk;
      }
      if (depth == 0 && start.from) {
        v = *start.from;
        answer = scene_->crossings(v, p);
        if (!answer.degenerate) break;
        walk.unresolved = true;
        return walk;
      }
      if (along && attempt == 0) {
        v = *along;
        answer = scene_->crossings(v, p);
        ++attempt;
        continue;
      }
      v = choose(mix(seed * 1000003 + static_cast<std::uint64_t>(depth) * 1009 + static_cast<std::uint64_t>(attempt)),
                 anchor, good);
      if (generic && attempt % 2 == 0) {
        const Point3 near = *generic + FT(std::ldexp(1, -attempt)) * (v - *generic);
        if (good(near)) v = exact::collapsed(near);
      }
      answer = scene_->crossings(v, p, contour != nullptr, answer.at);
      ++attempt;
    } while (answer.degenerate);
    if (answer.hits.empty()) {
      walk.ends_at_cell = true;
      return walk;
    }
    const exact::Hit& last = answer.hits.back();
    const Point3 m = last_crossing(v, p, last, good);
    const bool front = complex.planes[last.piece].oriented_side(p) == CGAL::ON_POSITIVE_SIDE;
    walk.legs.push_back({m, p, last.piece, front, false, false});
    p = m;
    surface = SurfaceSide{last.piece, front};
    contour = nullptr;
  }
}

bool Walk::runs_through(const LeftOut& left_out, std::size_t i) const {
  return std::any_of(legs.begin(), legs.end(),
                     [&](const Leg& leg) { return !leg.is_sight_line() && left_out.meets(i, leg.m, leg.p); });
}

Meets Walker::visible(const Start& start, const Walk& walk, const WedgeSet& wedges, std::size_t first) const {
  if (walk.ends_at_cell || walk.unresolved) return Meets::yes;
  Meets result = Meets::no;
  const auto note = [&](Meets m) {
    if (m == Meets::yes || (m == Meets::degenerate && result == Meets::no)) result = m;
  };
  const auto upon = [&](std::uint32_t piece, bool front, const Point3& x) {
    for (const std::uint32_t i : wedges.upon(piece, front)) {
      if (i >= first && result != Meets::yes) note(covers(wedges.pieces()[i], x));
    }
  };
  if (start.surface) upon(start.surface->piece, start.surface->front, start.p);
  if (start.contour) {
    // A valid piece in the same supporting plane that runs over the near side of the edge.
    for (const std::uint32_t i : wedges.along(start.contour->edge)) {
      const ValidPiece& piece = wedges.pieces()[i];
      if (i < first || result == Meets::yes) continue;
      const Point3& s = scene_->cell().vertices()[static_cast<std::size_t>(start.contour->touching.front())];
      if (piece.wedge.plane.oriented_side(s) != CGAL::ON_ORIENTED_BOUNDARY ||
          !CGAL::is_positive(piece.wedge.plane.orthogonal_vector() * start.contour->plane.orthogonal_vector())) {
        continue;
      }
      // A wedge that starts at this edge runs beyond it, not over it.
      const Meets m = covers(piece, start.p);
      note(m == Meets::degenerate ? Meets::no : m);
    }
  }
  for (const Leg& leg : walk.legs) {
    if (result == Meets::yes || !leg.is_sight_line()) break;
    note(crossed(start, walk, leg, leg.m, leg.p, wedges, first));
    if (result != Meets::yes) upon(leg.piece, leg.front, leg.m);
  }
  return result;
}

Meets Walker::visible_by_last_leg(const Start& start, const Walk& walk, const WedgeSet& wedges,
                                  std::size_t first) const {
  if (!walk.ends_in_the_dark()) return Meets::no;
  const Leg& leg = walk.legs.back();
  return crossed(start, walk, leg, leg.m, leg.p, wedges, first);
}

bool Walker::last_leg_is_in_doubt(const Start& start, const Walk& walk, const WedgeSet& wedges) const {
  if (!walk.ends_in_the_dark()) return false;
  const Leg& leg = walk.legs.back();
  return crossed(start, walk, leg, leg.p, leg.m, wedges, 0) != Meets::no;
}

Meets Walker::crossed(const Start& start, const Walk& walk, const Leg& leg, const Point3& m, const Point3& p,
                      const WedgeSet& wedges, std::size_t first) const {
  const exact::Complex& complex = scene_->complex();
  const bool at_start = &leg == &walk.legs.front();
  const auto crosses_nothing = [&](const ValidPiece& piece) {
    const exact::Plane3& h = piece.wedge.plane;
    const auto on_plane = [&](std::uint32_t point) {
      return h.oriented_side(complex.points[point]) == CGAL::ON_ORIENTED_BOUNDARY;
    };
    const auto holds_piece = [&](std::uint32_t t) {
      const auto& c = complex.pieces[t].corners;
      return on_plane(c[0]) && on_plane(c[1]) && on_plane(c[2]);
    };
    if (h.oriented_side(leg.m) == CGAL::ON_ORIENTED_BOUNDARY) {
      if (holds_piece(leg.piece)) return true;
      if (leg.from_corner) return true;  // the leg leaves its plane
      if (leg.from_edge) {               // a wedge through the edge itself runs outside the groove
        const auto& edges = complex.piece_edges[leg.piece];
        return std::any_of(edges.begin(), edges.end(),
                           [&](auto e) { return on_plane(complex.edges[e].a) && on_plane(complex.edges[e].b); });
      }
    }
    if (h.oriented_side(leg.p) != CGAL::ON_ORIENTED_BOUNDARY) return false;
    if (!at_start) return true;   // p is on the leg before, and was looked at there
    if (start.from) return true;  // p stands for what is just before it
    if (start.contour)
      return on_plane(complex.edges[start.contour->edge].a) && on_plane(complex.edges[start.contour->edge].b);
    return start.surface && holds_piece(start.surface->piece);
  };
  const Meets met = wedges.crossed(m, p, first, crosses_nothing);
  if (met != Meets::degenerate || !start.contour) return met;
  // A flat cell in the plane of its wedge has no other sight lines; D13a means those just off the plane, in H-.
  const exact::Plane3& h = start.contour->plane;
  if (!h.has_on(m) || !h.has_on(p)) return met;
  return wedges.crossed(m, p, first, crosses_nothing, h.orthogonal_vector());
}

Walker::Label Walker::label(const Start& start, const WedgeSet& wedges, const LeftOut& left_out,
                            std::uint64_t seed) const {
  int doubtful = 0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Walk made = walk(start, seed + static_cast<std::uint64_t>(attempt) * 7919);
    const Meets m = visible(start, made, wedges, 0);
    if (m == Meets::yes) return {true, made.unresolved};
    const Meets counts = visible_by_last_leg(start, made, wedges, 0);
    if (counts == Meets::yes) {  // another walk may have no doubt
      if (!last_leg_is_in_doubt(start, made, wedges)) return {true, false};
      if (++doubtful == kDoubtful) return {true, true};
      continue;
    }
    if (m == Meets::no && counts == Meets::no) {
      bool in_doubt = false;
      for (std::size_t i = 0; !in_doubt && i < left_out.size(); ++i) in_doubt = made.runs_through(left_out, i);
      return {in_doubt, in_doubt};
    }
  }
  throw scene::Error(scene::ErrorCode::internal, "walk: no walk in general position with the wedges");
}

}  // namespace clues::reference
