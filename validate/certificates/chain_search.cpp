#include "validate/certificates/chain_search.h"

#include <algorithm>
#include <vector>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "validate/certificates/region_points.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using exact::Vector3;
using reference::Wedge;
using reference::WedgeKind;

constexpr std::size_t kQuestions = 160;  // points asked about, for one chain
constexpr int kViewpoints = 3;           // per point: walks from different places of the cell cross different wedges
constexpr int kNearness[] = {5, 12, 24, 48};  // powers of 1/2
constexpr int kDirections = 6;                // beside a corner, where not every side is seen

FT half_to_the(int n) {
  FT x(1);
  for (int i = 0; i < n; ++i) x = x / FT(2);
  return x;
}

bool inside(const reference::Region& region, const Vector3& normal, const Point3& x) {
  // Even-odd in the coordinate plane that the region is not upright to. A point on the outline may go either way.
  int drop = 0;
  for (int i = 1; i < 3; ++i) {
    if (CGAL::abs(normal[i]) > CGAL::abs(normal[drop])) drop = i;
  }
  const int u = (drop + 1) % 3, w = (drop + 2) % 3;
  bool odd = false;
  for (const auto& ring : region.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a[w] > x[w]) == (b[w] > x[w])) continue;
      odd ^= x[u] < a[u] + (x[w] - a[w]) / (b[w] - a[w]) * (b[u] - a[u]);
    }
  }
  return odd;
}

}  // namespace

class ChainSearch::Impl {
 public:
  Impl(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map)
      : mesh_(mesh), map_(map), scene_(map.complex, map.cell), regions_(2 * map.complex.pieces.size()) {
    for (const exact::Piece& piece : map.complex.pieces) {
      const auto& c = piece.corners;
      soup_.push_back({map.complex.points[c[0]], map.complex.points[c[1]], map.complex.points[c[2]]});
    }
    for (const reference::Region& r : map.regions) {
      if (r.visible) regions_[2 * r.piece + (r.front ? 1 : 0)].push_back(&r);
    }
  }

  // Breadth first, so that the chain is short.
  std::optional<Chain> find(std::uint32_t triangle, bool front, const reference::Region& region,
                            const Point3& p) const {
    const Plane3& plane = map_.complex.planes[region.piece];
    const Plane3 side = region.front ? plane : plane.opposite();
    if (map_.cell.contains(p)) return std::nullopt;
    std::vector<Step> steps{{p, {}, 0}};
    for (std::size_t i = 0; i < steps.size() && i < kQuestions; ++i) {
      const std::optional<Plane3> on = i == 0 ? std::optional<Plane3>(side) : std::nullopt;
      const exact::OcclusionAnswer answer = exact::point_occlusion(steps[i].x, on, map_.cell, soup_);
      if (!answer.witness) {
        if (steps.size() < kQuestions) go_back(i, on, steps);
        continue;
      }
      Chain chain{triangle, front, {{*answer.witness, steps[i].x}}};
      for (std::size_t at = i; at != 0; at = steps[at].next)
        chain.links.insert(chain.links.end(), steps[at].onward.begin(), steps[at].onward.end());
      if (check_chain(mesh_, map_.cell, chain).valid) return chain;
    }
    return std::nullopt;
  }

 private:
  // A point from which the links lead on to the point of the step `next`.
  struct Step {
    Point3 x;
    std::vector<ChainLink> onward;
    std::size_t next = 0;
  };

  // Appends points from which step `to` is reached; `side`: on the positive side of that plane, in which it lies.
  void go_back(std::size_t to, const std::optional<Plane3>& side, std::vector<Step>& steps) const {
    const Point3 p = steps[to].x;
    for (int i = 0; i < kViewpoints; ++i) {
      const std::optional<Point3> v = viewpoint(side, i);
      if (!v) return;
      const exact::SegmentAnswer walk = scene_.crossings(*v, p);
      if (walk.degenerate || walk.hits.empty()) continue;
      const exact::Hit& last = walk.hits.back();
      const Point3 m = exact::collapsed(*v + last.t * (p - *v));
      for (const Wedge& w : map_.wedges) {
        if (const std::optional<Point3> q = crossing(w, last.piece, m, p)) through_wedge(w, *q, *v, to, side, steps);
      }
      if (seen(last.piece, m, p)) past_surface(m, *v, to, steps);
    }
  }

  // A point of int V, strictly on the positive side of the plane.
  std::optional<Point3> viewpoint(const std::optional<Plane3>& side, int which) const {
    const std::vector<Point3>& s = map_.cell.vertices();
    std::vector<int> weights;
    for (std::size_t i = 0; i < s.size(); ++i) weights.push_back(1 + (static_cast<int>(i) * 7 + which * 11) % 13);
    const Point3 u = map_.cell.interior_point(weights);
    if (!side || side->has_on_positive_side(u)) return u;
    const auto anchor =
        std::find_if(s.begin(), s.end(), [&](const Point3& x) { return side->has_on_positive_side(x); });
    if (anchor == s.end()) return std::nullopt;
    for (FT pull = FT(1) / FT(2);; pull = pull / FT(2)) {
      const Point3 v = *anchor + pull * (u - *anchor);
      if (side->has_on_positive_side(v)) return exact::collapsed(v);
    }
  }

  // D14, rule 2: where the way from m, on a surface, to p passes through the wedge piece from H+ to H-.
  std::optional<Point3> crossing(const Wedge& w, std::uint32_t piece, const Point3& m, const Point3& p) const {
    if (w.plane.oriented_side(p) != CGAL::ON_POSITIVE_SIDE) return std::nullopt;
    const FT at_p = exact::value_at(w.plane, p), at_m = exact::value_at(w.plane, m);
    if (CGAL::is_positive(at_m)) return std::nullopt;
    if (CGAL::is_zero(at_m)) {  // only a wedge piece upon the surface
      for (const std::uint32_t c : map_.complex.pieces[piece].corners) {
        if (!w.plane.has_on(map_.complex.points[c])) return std::nullopt;
      }
    }
    const Point3 q = exact::collapsed(m + (at_m / (at_m - at_p)) * (p - m));
    const Vector3 n = w.plane.orthogonal_vector();
    const auto left = [&](const Point3& a, const Point3& b) {
      return CGAL::is_positive(n * CGAL::cross_product(b - a, q - a));
    };
    if (!left(w.center, w.on_ray0) || !left(w.on_ray1, w.center)) return std::nullopt;
    if (w.near0 != w.near1 && !left(w.near1, w.near0)) return std::nullopt;
    if (!w.unbounded && !left(w.far0, w.far1)) return std::nullopt;
    return q;
  }

  // The touching point of V and the source of a wedge piece, on one line with q.
  struct Origin {
    Point3 touching, source;
  };
  std::optional<Origin> origin(const Wedge& w, const Point3& q) const {
    const Vector3 n = w.plane.orthogonal_vector(), d = q - w.center;
    const auto meet = [&](const Point3& a, const Point3& b) -> std::optional<Point3> {
      const FT at_a = n * CGAL::cross_product(d, a - w.center), at_b = n * CGAL::cross_product(d, b - w.center);
      if (CGAL::sign(at_a) * CGAL::sign(at_b) > 0) return std::nullopt;
      return at_a == at_b ? a : exact::zero_on_line(a, b, at_a, at_b);
    };
    if (w.kind != WedgeKind::se_mv) {
      const std::optional<Point3> y = meet(w.near0, w.near1);
      if (!y) return std::nullopt;
      return Origin{w.center, *y};
    }
    const std::vector<Point3>& s = map_.cell.vertices();
    for (const auto& [i, j] : map_.cell.edges()) {
      const Point3 &a = s[static_cast<std::size_t>(i)], &b = s[static_cast<std::size_t>(j)];
      if (!w.plane.has_on(a) || !w.plane.has_on(b)) continue;
      const std::optional<Point3> x = meet(a, b);
      if (x && CGAL::is_negative((*x - w.center) * d)) return Origin{*x, w.center};
    }
    return std::nullopt;
  }

  // The point is reached from just beyond q, which is on the wedge piece, and that from just beside the source, both in H-. Sight lines near the one through
  // q and v pass q on all sides; at a corner only some of these sides are seen.
  void through_wedge(const Wedge& w, const Point3& q, const Point3& v, std::size_t to,
                     const std::optional<Plane3>& side, std::vector<Step>& steps) const {
    const std::optional<Origin> o = origin(w, q);
    if (!o) return;
    const Point3 p = steps[to].x;
    const Vector3 whole = q - o->touching, n = w.plane.orthogonal_vector();
    const FT share = exact::collapsed(((o->source - o->touching) * whole) / (whole * whole));
    const FT onward = exact::collapsed(((v - p) * (v - p)) / ((v - p) * (q - p)));  // v - p as a multiple of q - p
    const int directions = w.kind == WedgeKind::se_mv ? kDirections : 1;
    for (int direction = 0; direction < directions; ++direction) {
      Vector3 aside = p - q;
      if (direction > 0) {
        aside = *viewpoint(std::nullopt, direction) - *viewpoint(std::nullopt, direction + 5);
        if (CGAL::is_negative(aside * n)) aside = -aside;
        if (!CGAL::is_positive(aside * n)) continue;
      }
      for (const int near : kNearness) {
        const FT step = half_to_the(near);
        const Point3 beyond = exact::collapsed(q + step * aside);
        const Point3 eye = direction == 0 ? v : exact::collapsed(p + onward * (beyond - p));
        if (!map_.cell.interior_contains(eye) || (side && !side->has_on_positive_side(eye))) continue;
        const Point3 from =
            exact::collapsed(o->touching + step * half_to_the(near) * (*viewpoint(std::nullopt, near) - o->touching));
        const Point3 beside = exact::collapsed(from + share * (beyond - from));
        if (map_.cell.contains(beside) || !scene_.is_free(beside, beyond) || !scene_.is_free(beyond, p)) continue;
        steps.push_back({beside, {{from, beyond}, {eye, p}}, to});
        if (near != kNearness[0]) break;
      }
    }
  }

  // D14, rule 3: the point is reached from the exit side of the surface at m.
  void past_surface(const Point3& m, const Point3& v, std::size_t to, std::vector<Step>& steps) const {
    const Point3 p = steps[to].x;
    for (const int near : kNearness) {
      const Point3 off = exact::collapsed(m + half_to_the(near) * (p - m));
      if (scene_.is_free(off, p)) {
        steps.push_back({off, {{v, p}}, to});
        break;
      }
    }
  }

  // Whether the map shows the surface at m on the side of p.
  bool seen(std::uint32_t piece, const Point3& m, const Point3& p) const {
    const Plane3& plane = map_.complex.planes[piece];
    const auto& regions = regions_[2 * piece + (plane.has_on_positive_side(p) ? 1 : 0)];
    const Vector3 n = plane.orthogonal_vector();
    return std::any_of(regions.begin(), regions.end(), [&](const auto* r) { return inside(*r, n, m); });
  }

  const scene::TriangleMesh& mesh_;
  const reference::VisibilityMap& map_;
  exact::SceneQuery scene_;
  std::vector<exact::TriangleCorners> soup_;
  std::vector<std::vector<const reference::Region*>> regions_;  // visible ones by piece and side
};

ChainSearch::ChainSearch(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map)
    : impl_(std::make_unique<Impl>(mesh, map)) {}
ChainSearch::~ChainSearch() = default;

std::optional<Chain> ChainSearch::find(std::uint32_t triangle, bool front, const reference::Region& region,
                                       const Point3& p) const {
  return impl_->find(triangle, front, region, p);
}

std::vector<Chain> find_chains(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map,
                               const std::vector<std::uint32_t>& triangles) {
  constexpr std::size_t kPoints = 2;  // per region, besides its sample
  const ChainSearch search(mesh, map);
  std::vector<std::optional<Chain>> found(mesh.triangles.size());
  for (const reference::Region& r : map.regions) {
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      const bool front = o.same_side == r.front;
      if (found[o.triangle] || (map.mode == reference::Mode::solid && !front) ||
          !std::binary_search(triangles.begin(), triangles.end(), o.triangle))
        continue;
      std::vector<Point3> points = interior_points(r.rings, kPoints);
      points.insert(points.begin(), r.sample);
      for (const Point3& p : points) {
        found[o.triangle] = search.find(o.triangle, front, r, p);
        if (found[o.triangle]) break;
      }
    }
  }
  std::vector<Chain> chains;
  for (std::optional<Chain>& chain : found) {
    if (chain) chains.push_back(std::move(*chain));
  }
  return chains;
}

}  // namespace clues::validate
