#include "reference/visibility/map/regions.h"

#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "reference/visibility/labels/walk.h"
#include "reference/visibility/map/side_faces.h"
#include "reference/visibility/map/sides.h"
#include "reference/visibility/planar/flat_faces.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Point2;
using exact::Point3;

namespace {

constexpr std::size_t kSamples = 8;  // points of a region that are asked before it counts as visible
// Where walks lose their way they do so in hundreds of regions. When so many count as visible for want of an answer, of this side and of those that were
// done when it was begun, one point of each is asked, and the walk from it is short. So many sides are begun at once, whatever the number of threads.
constexpr std::uint64_t kPatience = 16;
constexpr std::size_t kSidesAtOnce = 16;
constexpr std::int64_t kShortWalk = 8;  // legs
constexpr std::uint64_t kRegionSeed = 0x1d, kSecondSeed = 0x7a3;

using Segment3 = std::pair<Point3, Point3>;
using SideKey = std::pair<std::uint32_t, bool>;  // piece, front
using Traits = CGAL::Arr_segment_traits_2<Kernel>;
using Arrangement = CGAL::Arrangement_2<Traits>;

// The part of segment ab inside triangle t, all in one plane (flat coordinates); none when it is empty or a point.
std::vector<std::pair<Point2, Point2>> clipped(const Kernel::Triangle_2& t, const Point2& a, const Point2& b) {
  if (a == b) return {};
  const auto met = CGAL::intersection(Kernel::Segment_2(a, b), t);
  if (!met) return {};
  if (const auto* s = boost::get<Kernel::Segment_2>(&*met)) return {{s->source(), s->target()}};
  return {};
}

using Segments2 = std::vector<std::pair<Point2, Point2>>;

// The same point set without overlaps: collinear segments that meet become one. (The sweep of CGAL 5.5 fails on some sets of three and more
// overlapping segments, depending on where its nodes lie in memory.) O(n^2) filtered orientation tests.
Segments2 without_overlaps(const Segments2& segments) {
  Segments2 out;
  for (auto [a, b] : segments) {
    if (b < a) std::swap(a, b);
    std::erase_if(out, [&a = a, &b = b](const auto& other) {
      const auto& [c, d] = other;
      if (!CGAL::collinear(c, d, a) || !CGAL::collinear(c, d, b) || d < a || b < c) return false;
      if (c < a) a = c;
      if (b < d) b = d;
      return true;
    });
    out.emplace_back(a, b);
  }
  return out;
}

class SideMapper {
 public:
  SideMapper(const exact::SceneQuery& scene, const Fixpoint& fixpoint, const std::vector<bool>& visited,
             const Options& options)
      : scene_(scene),
        fixpoint_(fixpoint),
        visited_(visited),
        options_(options),
        walker_(scene, options.dials.longest_walk),
        short_walker_(scene, options.dials.longest_walk == exact::Dials::kOwn
                                 ? kShortWalk
                                 : std::min(kShortWalk, options.dials.longest_walk)) {
    for (const ValidPiece& piece : fixpoint.wedges.pieces()) {
      const Wedge& w = piece.wedge;
      if (!w.unbounded) {
        const bool front = scene.complex().planes[w.blocker].oriented_side(w.center) == CGAL::ON_POSITIVE_SIDE;
        traces_[{w.blocker, front}].push_back({w.far0, w.far1});
      }
      add_radials(piece);
    }
  }

  struct Output : SideFaces {
    std::uint64_t walks = 0, disagreements = 0, fallbacks = 0, fallbacks_before = 0;
  };

  Output map_side(std::uint32_t t, bool front, std::uint64_t fallbacks_before) const {
    Output out;
    out.fallbacks_before = fallbacks_before;
    const exact::Complex& complex = scene_.complex();
    const TriangleFrame flat_triangle(complex, t);
    const auto& p = flat_triangle.corners();
    const Kernel::Triangle_2& triangle = flat_triangle.flat();
    const auto lift = [&](const Point2& q) { return flat_triangle.lift(q); };

    if (!visited_.empty() && !visited_[t]) {  // lies in no point of Omega
      Region r{t, front, false, {{p[0], p[1], p[2]}}, FT(1), {}};
      r.sample = lift(inner_point({flat_triangle.outline()}, 0));
      out.regions.push_back(std::move(r));
      return out;
    }
    if (complex.in_cell[t]) {  // D3
      Region r{t, front, true, {{p[0], p[1], p[2]}}, FT(1), CGAL::centroid(p[0], p[1], p[2])};
      out.regions.push_back(std::move(r));
      return out;
    }
    const Segments2 flat = without_overlaps(segments_on({t, front}, flat_triangle.frame(), triangle));
    if (flat.empty()) {
      Region r{t, front, false, {{p[0], p[1], p[2]}}, FT(1), {}};
      finish(r, {flat_triangle.outline()}, lift, out);
      out.regions.push_back(std::move(r));
      return out;
    }
    Arrangement arrangement;
    std::vector<Traits::X_monotone_curve_2> curves;
    for (int i = 0; i < 3; ++i) curves.emplace_back(triangle[i], triangle[i + 1]);
    for (const auto& [a, b] : flat) curves.emplace_back(a, b);
    CGAL::insert(arrangement, curves.begin(), curves.end());
    std::map<const void*, bool> label;
    std::vector<std::pair<std::vector<Point2>, Arrangement::Face_const_handle>> faces;
    for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
      if (f->is_unbounded()) continue;
      std::vector<std::vector<Point2>> rings;
      const auto ring = [&](Arrangement::Ccb_halfedge_const_circulator start) {
        std::vector<Point2> points;
        auto h = start;
        do {
          points.push_back(h->source()->point());
        } while (++h != start);
        return points;
      };
      rings.push_back(without_spurs(ring(f->outer_ccb())));
      for (auto hole = f->inner_ccbs_begin(); hole != f->inner_ccbs_end(); ++hole) {
        auto points = without_spurs(ring(*hole));
        if (points.size() >= 3) rings.push_back(std::move(points));
      }
      Region r{t, front, false, {}, {}, {}};
      FT area(0);
      for (const auto& points : rings) {
        area += twice_area(points);  // holes run clockwise
        std::vector<Point3> lifted;
        for (const Point2& q : points) lifted.push_back(lift(q));
        r.rings.push_back(std::move(lifted));
      }
      r.area_fraction = exact::collapsed(area / flat_triangle.twice_area());
      finish(r, rings, lift, out);
      label[&*f] = r.visible;
      out.regions.push_back(std::move(r));
    }
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
      if (e->face()->is_unbounded() || e->twin()->face()->is_unbounded()) continue;
      Point3 a = lift(e->source()->point()), b = lift(e->target()->point());
      if (CGAL::lexicographically_xyz_smaller(b, a)) std::swap(a, b);
      out.segments.push_back({t, front, label[&*e->face()] != label[&*e->twin()->face()], a, b});
    }
    out.sort();
    return out;
  }

 private:
  // A piece seen edge-on is cut on the side, or sides, on which the valid strip runs along it.
  void add_radials(const ValidPiece& piece) {
    const OnWedge& on = *piece.on_wedge;
    for (const Radial& r : on.radials) {
      const CGAL::Orientation after0 = CGAL::orientation(on.center, piece.strip.on_ray0.q, r.w.q);
      const CGAL::Orientation before1 = CGAL::orientation(on.center, r.w.q, piece.strip.on_ray1.q);
      if (after0 == CGAL::RIGHT_TURN || before1 == CGAL::RIGHT_TURN) continue;
      if (!reaches(on, piece.strip, r.u.q) || !reaches(on, piece.strip, r.w.q)) continue;
      const exact::Vector3 ccw = CGAL::cross_product(piece.wedge.plane.orthogonal_vector(), r.w.p - piece.wedge.center);
      const bool front_is_ccw = CGAL::is_positive(scene_.complex().planes[r.piece].orthogonal_vector() * ccw);
      if (before1 == CGAL::LEFT_TURN) traces_[{r.piece, front_is_ccw}].push_back({r.u.p, r.w.p});
      if (after0 == CGAL::LEFT_TURN) traces_[{r.piece, !front_is_ccw}].push_back({r.u.p, r.w.p});
    }
  }

  Segments2 segments_on(const SideKey& key, const PlaneFrame& frame, const Kernel::Triangle_2& triangle) const {
    Segments2 flat;
    const auto add = [&](const Point2& a, const Point2& b) {
      for (const auto& s : clipped(triangle, a, b)) {
        if (!on_outline(triangle, s.first, s.second)) flat.push_back(s);  // there it separates nothing
      }
    };
    const auto traces = traces_.find(key);
    if (traces != traces_.end()) {
      for (const Segment3& s : traces->second) add(frame(s.first), frame(s.second));
    }
    for (const std::uint32_t i : fixpoint_.wedges.upon(key.first, key.second)) {  // the outline of a piece on this side
      const Wedge& w = fixpoint_.wedges.pieces()[i].wedge;
      add(frame(w.near0), frame(w.near1));
      const auto side = [&](const Point3& near, const Point3& on_ray, const Point3& far) {
        if (!w.unbounded) {
          add(frame(near), frame(far));
          return;
        }
        const auto met = CGAL::intersection(Kernel::Ray_2(frame(near), frame(on_ray) - frame(w.center)), triangle);
        if (!met) return;
        if (const auto* s = boost::get<Kernel::Segment_2>(&*met)) add(s->source(), s->target());
      };
      side(w.near0, w.on_ray0, w.far0);
      side(w.near1, w.on_ray1, w.far1);
      if (!w.unbounded) add(frame(w.far0), frame(w.far1));
    }
    return flat;
  }

  template <class Lift>
  void finish(Region& r, const std::vector<std::vector<Point2>>& rings, const Lift& lift, Output& out) const {
    if (!faces_cell(scene_.complex(), scene_.cell(), r.piece, r.front)) {  // though the space beside it may be seen
      r.sample = lift(inner_point(rings, 0));
      return;
    }
    if (fixpoint_.left_out.may_reach(r.rings[0])) {
      r.visible = true;
      r.sample = lift(inner_point(rings, 0));
      return;
    }
    const bool has_patience = out.fallbacks_before + out.fallbacks < kPatience;
    const Walker& walker = has_patience ? walker_ : short_walker_;
    const std::size_t samples = has_patience ? kSamples : 0;
    for (std::size_t which = 0;; ++which) {
      r.sample = lift(inner_point(rings, which));
      const Start start{r.sample, SurfaceSide{r.piece, r.front}, nullptr};
      ++out.walks;
      try {
        const Walker::Label label = walker.label(start, fixpoint_.wedges, fixpoint_.left_out, kRegionSeed + which);
        if (label.fallback && which < samples) continue;  // another point of the region may be easier to decide
        r.visible = label.visible;
        out.fallbacks += label.fallback;
        if (options_.check_two_walks) {
          ++out.walks;
          const Walker::Label second = walker.label(start, fixpoint_.wedges, fixpoint_.left_out, kSecondSeed + which);
          out.disagreements +=
              !fixpoint_.in_doubt && !label.fallback && !second.fallback && second.visible != label.visible;
        }
      } catch (const scene::Error&) {
        if (which < samples) continue;  // the sample itself lies in special position: take another
        r.visible = true;
        ++out.fallbacks;
      }
      break;
    }
  }

  const exact::SceneQuery& scene_;
  const Fixpoint& fixpoint_;
  const std::vector<bool>& visited_;
  const Options& options_;
  Walker walker_, short_walker_;
  std::map<SideKey, std::vector<Segment3>> traces_;
};

}  // namespace

void make_regions(const exact::SceneQuery& scene, const Fixpoint& fixpoint, const RegionScope& scope,
                  const Options& options, VisibilityMap& map) {
  const SideMapper mapper(scene, fixpoint, scope.visited, options);
  const auto& pieces = map.complex.pieces;
  std::vector<SideKey> sides;
  for (std::uint32_t t = 0; t < pieces.size(); ++t) {
    for (const bool front : {true, false}) {
      if (counts(map.mode, pieces[t], front) && (scope.wanted.empty() || scope.wanted[side_index(t, front)]))
        sides.emplace_back(t, front);
    }
  }
  std::vector<SideMapper::Output> outputs(sides.size());
  std::uint64_t fallbacks = 0;
  for (std::size_t first = 0; first < sides.size(); first += kSidesAtOnce) {
    const std::size_t end = std::min(first + kSidesAtOnce, sides.size());
    tbb::parallel_for(first, end,
                      [&](std::size_t i) { outputs[i] = mapper.map_side(sides[i].first, sides[i].second, fallbacks); });
    if (options.progress) options.progress("regions", end, sides.size());
    for (std::size_t i = first; i < end; ++i) fallbacks += outputs[i].fallbacks;
  }
  for (SideMapper::Output& out : outputs) {
    map.statistics.walks += out.walks;
    map.statistics.walk_disagreements += out.disagreements;
    out.move_to(map);
  }
  map.statistics.conservative_fallbacks += fallbacks;
}

}  // namespace clues::reference
