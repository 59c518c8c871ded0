#include "reference/visibility/walk.h"

#include <algorithm>

#include "scene/error.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;

namespace {

constexpr int kAttempts = 200;  // sight lines in special position come from coincidences; this many in a row mean a bug

std::uint64_t mix(std::uint64_t x) {  // splitmix64's finisher
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

CGAL::Oriented_side strict_side(bool front) { return front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE; }

}  // namespace

Point3 Walker::choose(std::uint64_t seed, int anchor, const std::function<bool(const Point3&)>& good) const {
  const exact::ConvexCell& cell = scene_->cell();
  std::vector<int> weights;
  for (std::size_t i = 0; i < cell.vertices().size(); ++i) {
    seed = mix(seed);
    weights.push_back(1 + static_cast<int>(seed % 61));
  }
  const Point3 u = cell.interior_point(weights);
  if (anchor < 0 || good(u)) return u;
  const Point3& s = cell.vertices()[static_cast<std::size_t>(anchor)];
  for (FT pull(1);;) {
    pull = pull / FT(8);
    const Point3 v = s + pull * (u - s);
    if (good(v)) return exact::collapsed(v);
  }
}

int Walker::anchor_beyond(const SurfaceSide& side) const {
  const exact::Plane3& h = scene_->complex().planes[side.piece];
  int best = -1;
  FT farthest(0);
  const auto& s = scene_->cell().vertices();
  for (std::size_t i = 0; i < s.size(); ++i) {
    FT d = h.a() * s[i].x() + h.b() * s[i].y() + h.c() * s[i].z() + h.d();
    if (!side.front) d = -d;
    if (d > farthest) {
      farthest = d;
      best = static_cast<int>(i);
    }
  }
  return best;
}

Walk Walker::walk(const Start& start, std::uint64_t seed) const {
  const exact::Complex& complex = scene_->complex();
  const exact::ConvexCell& cell = scene_->cell();
  Walk walk;
  if (cell.contains(start.p)) {
    walk.ends_at_cell = true;
    return walk;
  }
  Point3 p = start.p;
  std::optional<SurfaceSide> surface = start.surface;
  const ContourEdge* contour = start.contour;
  if (contour && contour->cover) return walk;  // only a wedge piece upon the covering surface can light this edge (D14, rule 2)
  for (int depth = 0;; ++depth) {
    int anchor = -1;
    std::function<bool(const Point3&)> good = [](const Point3&) { return true; };
    if (surface) {
      anchor = anchor_beyond(*surface);
      if (anchor < 0) return walk;
      good = [&](const Point3& v) { return complex.planes[surface->piece].oriented_side(v) == strict_side(surface->front); };
    } else if (contour) {
      // v so near the supporting plane that no incident piece lies between it and the supporting polygon.
      anchor = contour->touching.front();
      const exact::Edge& e = complex.edges[contour->edge];
      const Point3 &a = complex.points[e.a], &b = complex.points[e.b], &s = cell.vertices()[static_cast<std::size_t>(anchor)];
      good = [&](const Point3& v) {
        return std::all_of(e.pieces.begin(), e.pieces.end(), [&](auto t) {
          const auto& c = complex.pieces[t].corners;
          const auto third = *std::find_if(c.begin(), c.end(), [&](auto i) { return i != e.a && i != e.b; });
          const CGAL::Orientation at_s = CGAL::orientation(a, b, complex.points[third], s);
          return at_s == CGAL::COPLANAR || CGAL::orientation(a, b, complex.points[third], v) == at_s;
        });
      };
    }
    exact::SegmentAnswer answer;
    Point3 v;
    int attempt = 0;
    do {
      if (attempt == kAttempts) throw scene::Error(scene::ErrorCode::internal, "walk: no sight line in general position");
      v = choose(mix(seed * 1000003 + static_cast<std::uint64_t>(depth) * 1009 + static_cast<std::uint64_t>(attempt)), anchor, good);
      answer = scene_->crossings(v, p);
      ++attempt;
    } while (answer.degenerate);
    if (answer.hits.empty()) {
      walk.ends_at_cell = true;
      return walk;
    }
    const exact::Hit& last = answer.hits.back();
    const Point3 m = exact::collapsed(v + last.t * (p - v));
    const bool front = complex.planes[last.piece].oriented_side(p) == CGAL::ON_POSITIVE_SIDE;
    walk.legs.push_back({m, p, last.piece, front});
    if (!rule_3_) return walk;
    p = m;
    surface = SurfaceSide{last.piece, front};
    contour = nullptr;
  }
}

Meets Walker::visible(const Start& start, const Walk& walk, const WedgeSet& wedges, std::size_t first) const {
  if (walk.ends_at_cell) return Meets::yes;
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
  const exact::Complex& complex = scene_->complex();
  for (const Leg& leg : walk.legs) {
    if (result == Meets::yes) break;
    const bool at_start = &leg == &walk.legs.front();
    note(wedges.crossed(leg.m, leg.p, first, [&](const ValidPiece& piece) {
      const exact::Plane3& h = piece.wedge.plane;
      const auto on_plane = [&](std::uint32_t point) { return h.oriented_side(complex.points[point]) == CGAL::ON_ORIENTED_BOUNDARY; };
      const auto holds_piece = [&](std::uint32_t t) {
        const auto& c = complex.pieces[t].corners;
        return on_plane(c[0]) && on_plane(c[1]) && on_plane(c[2]);
      };
      if (h.oriented_side(leg.m) == CGAL::ON_ORIENTED_BOUNDARY && holds_piece(leg.piece)) return true;
      if (h.oriented_side(leg.p) != CGAL::ON_ORIENTED_BOUNDARY) return false;
      if (!at_start) return true;  // p is the m of the leg before, and was looked at there
      if (start.contour) return on_plane(complex.edges[start.contour->edge].a) && on_plane(complex.edges[start.contour->edge].b);
      return start.surface && holds_piece(start.surface->piece);
    }));
    if (result != Meets::yes) upon(leg.piece, leg.front, leg.m);
  }
  return result;
}

bool Walker::label(const Start& start, const WedgeSet& wedges, std::uint64_t seed) const {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Meets m = visible(start, walk(start, seed + static_cast<std::uint64_t>(attempt) * 7919), wedges, 0);
    if (m != Meets::degenerate) return m == Meets::yes;
  }
  throw scene::Error(scene::ErrorCode::internal, "walk: no walk in general position with the wedges");
}

}  // namespace clues::reference
