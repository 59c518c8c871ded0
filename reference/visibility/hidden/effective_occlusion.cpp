#include "reference/visibility/hidden/effective_occlusion.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "exact/area.h"
#include "exact/sight/scene_query.h"
#include "reference/in_parallel.h"
#include "reference/visibility/hidden/inside_corners.h"
#include "reference/visibility/map/flat_sides.h"
#include "reference/visibility/map/sides.h"
#include "reference/visibility/planar/flat_set.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;

namespace {

struct HiddenRegion {
  std::size_t side = 0;  // side_index
  Face2 face;
  std::uint64_t segments = 0;
  FT fraction;  // of the piece
  double area = 0;
  bool whole = false;
};

// The regions of a map by side_index; those of a side are neighbours in the list.
using SideRegions = std::map<std::size_t, std::vector<const Region*>>;

SideRegions by_side(const VisibilityMap& map) {
  SideRegions sides;
  for (const Region& r : map.regions) sides[side_index(r.piece, r.front)].push_back(&r);
  return sides;
}

FlatSet set_with(bool visible, const std::vector<const Region*>& regions, const TriangleFrame& frame) {
  std::vector<Face2> faces;
  for (const Region* r : regions) {
    if (r->visible == visible) faces.push_back(flat_face(*r, frame));
  }
  return faces.size() == regions.size() ? whole_of(frame) : FlatSet(frame.twice_area(), faces);
}

void measure(HiddenRegion& region, const exact::Complex& complex, const TriangleFrame& frame) {
  FT twice(0);
  for (const Ring2& ring : region.face) twice += twice_area(ring);  // holes run clockwise
  region.fraction = exact::collapsed(twice / frame.twice_area());
  region.segments = boundary_segments(region.face, frame.flat());
  region.whole = region.fraction == FT(1);
  const auto& c = complex.pieces[piece_of(region.side)].corners;
  region.area = exact::area_estimate(complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]) *
                CGAL::to_double(region.fraction);
}

// Those of all sides that face the cell, by side.
std::vector<HiddenRegion> hidden_regions(const VisibilityMap& map, int threads) {
  std::vector<std::pair<std::size_t, std::vector<const Region*>>> sides;
  for (auto& [side, regions] : by_side(map)) {
    const bool hides = std::any_of(regions.begin(), regions.end(), [](const Region* r) { return !r->visible; });
    if (hides && faces_cell(map.complex, map.cell, piece_of(side), is_front(side)))
      sides.emplace_back(side, std::move(regions));
  }
  std::vector<std::vector<HiddenRegion>> found(sides.size());
  in_parallel(sides.size(), threads, [&](std::size_t k) {
    const TriangleFrame frame(map.complex, piece_of(sides[k].first));
    for (Face2& face : set_with(false, sides[k].second, frame).faces()) {
      found[k].push_back({sides[k].first, std::move(face), 0, FT(0), 0, false});
      measure(found[k].back(), map.complex, frame);
    }
  });
  std::vector<HiddenRegion> all;
  for (auto& some : found) std::move(some.begin(), some.end(), std::back_inserter(all));
  return all;
}

// A hidden region along a part of an edge of the complex.
struct Stretch {
  std::size_t region = 0;
  Point3 from, to;  // from < to
};

std::map<std::uint32_t, std::vector<Stretch>> stretches_by_edge(const exact::Complex& complex,
                                                                const std::vector<HiddenRegion>& regions) {
  std::map<std::uint32_t, std::vector<Stretch>> edges;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::uint32_t t = piece_of(regions[i].side);
    if (complex.in_cell[t]) continue;
    const TriangleFrame frame(complex, t);
    const auto& f = frame.flat();
    for (const Ring2& ring : regions[i].face) {
      for (std::size_t j = 0; j < ring.size(); ++j) {
        const auto &p = ring[j], &q = ring[(j + 1) % ring.size()];
        for (int k = 0; k < 3; ++k) {
          if (!CGAL::collinear(f[k], f[k + 1], p) || !CGAL::collinear(f[k], f[k + 1], q)) continue;
          Point3 from = frame.lift(p), to = frame.lift(q);
          if (to < from) std::swap(from, to);
          edges[complex.piece_edges[t][static_cast<std::size_t>(k)]].push_back({i, from, to});
        }
      }
    }
  }
  return edges;
}

bool runs_along(const exact::Complex& complex, std::uint32_t piece, const exact::Edge& edge) {  // from a to b
  const auto& c = complex.pieces[piece].corners;
  for (std::size_t k = 0; k < 3; ++k) {
    if (c[k] == edge.a && c[(k + 1) % 3] == edge.b) return true;
  }
  return false;
}

// Per hidden region the number of its occlusion region: that of the first hidden region in it.
std::vector<std::size_t> joined(const exact::Complex& complex, const std::vector<HiddenRegion>& regions) {
  std::vector<std::size_t> leader(regions.size());
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  for (const auto& [e, stretches] : stretches_by_edge(complex, regions)) {
    const exact::Edge& edge = complex.edges[e];
    if (edge.pieces.size() != 2) continue;
    const bool same_sides = runs_along(complex, edge.pieces[0], edge) != runs_along(complex, edge.pieces[1], edge);
    for (const Stretch& x : stretches) {
      for (const Stretch& y : stretches) {
        const std::size_t s = regions[x.region].side, u = regions[y.region].side;
        if (piece_of(s) >= piece_of(u) || (is_front(s) == is_front(u)) != same_sides) continue;
        if (!(std::max(x.from, y.from) < std::min(x.to, y.to))) continue;
        const std::size_t a = find(x.region), b = find(y.region);
        leader[std::max(a, b)] = std::min(a, b);
      }
    }
  }
  for (std::size_t i = 0; i < leader.size(); ++i) leader[i] = find(i);
  return leader;
}

// By leader.
std::map<std::size_t, OcclusionRegion> summed(const VisibilityMap& map, const std::vector<HiddenRegion>& regions,
                                              const std::vector<std::size_t>& leader) {
  std::map<std::size_t, OcclusionRegion> sums;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    OcclusionRegion& sum = sums[leader[i]];
    sum.segments += regions[i].segments;
    sum.hidden_area += regions[i].area;
    if (regions[i].segments > 0) sum.bordered_area += regions[i].area;
    sum.whole_pieces += regions[i].whole;
    for (const exact::Origin& o : map.complex.pieces[piece_of(regions[i].side)].origins)
      sum.triangles.push_back(o.triangle);
  }
  for (auto& [i, sum] : sums) {
    std::sort(sum.triangles.begin(), sum.triangles.end());
    sum.triangles.erase(std::unique(sum.triangles.begin(), sum.triangles.end()), sum.triangles.end());
  }
  return sums;
}

OcclusionFigures figures(const VisibilityMap& map, const std::vector<HiddenRegion>& regions) {
  OcclusionFigures out;
  out.visible_triangles = map.visible.size();
  for (const auto& [i, sum] : summed(map, regions, joined(map.complex, regions))) {
    ++out.regions;
    out.segments += sum.segments;
    out.hidden_area += sum.hidden_area;
  }
  return out;
}

void simplify(std::vector<HiddenRegion>& regions, const exact::Complex& complex, const OcclusionControls& controls) {
  in_parallel(regions.size(), controls.threads, [&](std::size_t i) {
    HiddenRegion& region = regions[i];
    if (region.segments < 2) return;
    const TriangleFrame frame(complex, piece_of(region.side));
    const FT budget = exact::collapsed(FT(controls.max_loss) * region.fraction * frame.twice_area());
    Face2 simpler = simplified(region.face, frame.flat(), budget);
    if (simpler == region.face) return;
    region.face = std::move(simpler);
    measure(region, complex, frame);
  });
}

// The map with these faces as what is hidden on these sides.
VisibilityMap rebuilt(const VisibilityMap& map, const std::map<std::size_t, std::vector<Face2>>& changed,
                      const OcclusionControls& controls) {
  std::vector<std::size_t> order;
  for (const auto& [side, faces] : changed) order.push_back(side);
  const SideRegions old = by_side(map);
  std::vector<SideFaces> made(order.size());
  in_parallel(order.size(), controls.threads, [&](std::size_t k) {
    const std::uint32_t t = piece_of(order[k]);
    const TriangleFrame frame(map.complex, t);
    FlatSet hidden(frame.twice_area());
    for (const Face2& face : changed.at(order[k])) hidden = unite(hidden, FlatSet(frame.twice_area(), {face}));
    if (!subtract(hidden, set_with(false, old.at(order[k]), frame)).empty())
      throw scene::Error(scene::ErrorCode::internal, "simplification: a hidden region grew");
    made[k] = side_faces(subtract(whole_of(frame), hidden), frame, t, is_front(order[k]));
  });
  VisibilityMap out{map.complex, map.cell, map.mode,       map.formulation, map.wedges, {},
                    {},          {},       map.statistics, map.method,      map.range};
  const auto is_changed = [&](const auto& x) { return changed.count(side_index(x.piece, x.front)) > 0; };
  std::remove_copy_if(map.regions.begin(), map.regions.end(), std::back_inserter(out.regions), is_changed);
  std::remove_copy_if(map.segments.begin(), map.segments.end(), std::back_inserter(out.segments), is_changed);
  for (SideFaces& side : made) {
    std::move(side.regions.begin(), side.regions.end(), std::back_inserter(out.regions));
    std::move(side.segments.begin(), side.segments.end(), std::back_inserter(out.segments));
  }
  const auto by_place = [](const auto& x, const auto& y) {
    return side_index(x.piece, x.front) < side_index(y.piece, y.front);
  };
  std::stable_sort(out.regions.begin(), out.regions.end(), by_place);
  std::stable_sort(out.segments.begin(), out.segments.end(), by_place);
  const auto visible = std::count_if(out.regions.begin(), out.regions.end(), [](const Region& r) { return r.visible; });
  out.statistics.regions_visible = static_cast<std::uint64_t>(visible);
  out.statistics.regions_hidden = out.regions.size() - out.statistics.regions_visible;
  find_visible(exact::SceneQuery(out.complex, out.cell), out);
  out.in_doubt = map.in_doubt;  // what is listed for want of an occlusion that was given up is in no doubt
  return out;
}

struct WithPlanes {
  VisibilityMap map;
  std::uint64_t corners = 0, taken = 0;
};

WithPlanes with_planes(const VisibilityMap& map, const OcclusionControls& controls) {
  std::vector<InsideCorner> corners = inside_corners(map);
  std::erase_if(corners, [&](const InsideCorner& c) { return !c.within(*controls.corner_angle); });
  std::vector<std::pair<std::size_t, std::vector<const Region*>>> sides;
  if (!corners.empty()) {
    for (auto& [side, regions] : by_side(map)) {
      if (regions.size() > 1) sides.emplace_back(side, std::move(regions));
    }
  }
  std::vector<std::vector<const DmSegment*>> boundaries(2 * map.complex.pieces.size());  // by side_index
  for (const DmSegment& s : map.segments) {
    if (s.boundary) boundaries[side_index(s.piece, s.front)].push_back(&s);
  }
  std::vector<std::vector<char>> taken(sides.size(), std::vector<char>(corners.size(), 0));
  std::vector<std::vector<Face2>> hidden(sides.size());
  in_parallel(sides.size(), controls.threads, [&](std::size_t k) {
    const auto& [side, regions] = sides[k];
    const std::uint32_t t = piece_of(side);
    const FlatSet old = set_with(false, regions, TriangleFrame(map.complex, t));
    hidden[k] = hidden_by_planes(old, map.complex, t, boundaries[side], corners, taken[k]).faces();
  });
  std::map<std::size_t, std::vector<Face2>> changed;
  std::vector<char> anywhere(corners.size(), 0);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (std::count(taken[k].begin(), taken[k].end(), 0) == static_cast<std::ptrdiff_t>(corners.size())) continue;
    changed[sides[k].first] = std::move(hidden[k]);
    for (std::size_t i = 0; i < corners.size(); ++i) anywhere[i] |= taken[k][i];
  }
  return {rebuilt(map, changed, controls), corners.size(),
          static_cast<std::uint64_t>(std::count(anywhere.begin(), anywhere.end(), 1))};
}

}  // namespace

double OcclusionRegion::effective() const {
  return segments == 0 ? std::numeric_limits<double>::infinity() : bordered_area / static_cast<double>(segments);
}

std::vector<OcclusionRegion> occlusion_regions(const VisibilityMap& map) {
  const std::vector<HiddenRegion> regions = hidden_regions(map, 1);
  std::vector<OcclusionRegion> out;
  for (auto& [i, sum] : summed(map, regions, joined(map.complex, regions))) out.push_back(std::move(sum));
  return out;
}

SimplifiedMap with_simpler_occlusion(const VisibilityMap& map, const OcclusionControls& controls) {
  if (controls.corner_angle) {
    const WithPlanes planes = with_planes(map, controls);
    OcclusionControls rest = controls;
    rest.corner_angle.reset();
    SimplifiedMap out = with_simpler_occlusion(planes.map, rest);
    out.before = figures(map, hidden_regions(map, controls.threads));
    out.inside_corners = planes.corners;
    out.by_planes = planes.taken;
    return out;
  }
  const std::vector<HiddenRegion> old = hidden_regions(map, controls.threads);
  std::vector<HiddenRegion> regions = old;
  if (controls.max_loss > 0) simplify(regions, map.complex, controls);
  const std::vector<std::size_t> leader = joined(map.complex, regions);
  const auto sums = summed(map, regions, leader);

  const double least = map.range.area_moved_in(controls.min_occlusion);
  std::vector<HiddenRegion> kept;
  std::map<std::size_t, std::vector<Face2>> changed;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const bool stays = regions[i].segments == 0 || sums.at(leader[i]).effective() >= least;
    if (!stays || regions[i].face != old[i].face) changed[regions[i].side];
    if (stays) kept.push_back(std::move(regions[i]));
  }
  for (const HiddenRegion& region : kept) {
    const auto side = changed.find(region.side);
    if (side != changed.end()) side->second.push_back(region.face);
  }
  VisibilityMap simpler = rebuilt(map, changed, controls);
  const OcclusionFigures after = figures(simpler, kept);
  return {std::move(simpler), figures(map, old), after};
}

bool hides_no_more(const VisibilityMap& before, const VisibilityMap& after, int threads) {
  const SideRegions old = by_side(before), now = by_side(after);
  std::vector<std::size_t> order;
  for (const auto& [side, regions] : now) order.push_back(side);
  std::vector<char> more(order.size(), 0);
  in_parallel(order.size(), threads, [&](std::size_t k) {
    const TriangleFrame frame(before.complex, piece_of(order[k]));
    const FlatSet hidden = set_with(false, now.at(order[k]), frame);
    const auto was = old.find(order[k]);
    more[k] = was == old.end() ? !hidden.empty() : !subtract(hidden, set_with(false, was->second, frame)).empty();
  });
  return std::none_of(more.begin(), more.end(), [](char m) { return m != 0; });
}

}  // namespace clues::reference
