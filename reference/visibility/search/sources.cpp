#include "reference/visibility/search/sources.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "exact/cell/cell_plane.h"
#include "exact/complex/simple_point.h"

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

VertexSource vertex_source(const exact::SceneQuery& scene, std::uint32_t point, const Apex& apex, const Vector3& d) {
  const Point3& x = scene.complex().points[point];
  VertexSource s{point, x,     d,    x + d, {{d, CGAL::NULL_VECTOR, CGAL::NULL_VECTOR}, d, CGAL::NULL_VECTOR},
                 {},    false, false};
  for (int attempt = 0; attempt < kViews; ++attempt) {
    if (look_again(scene, apex, s, attempt)) break;
  }
  return s;
}

// x in one plane with V: one sight line for each part that the pieces at x cut the way to V into. Beside a piece in that plane x is seen from just off it: that is not looked at,
// and x counts as visible.
void flat_sources(const exact::SceneQuery& scene, std::uint32_t point, const Apex& apex,
                  std::vector<VertexSource>& sources) {
  const exact::Complex& complex = scene.complex();
  const auto& pieces = complex.point_pieces[point];
  const auto add = [&](const Vector3& d) {
    const Point3& x = complex.points[point];
    sources.push_back(
        {point, x, d, x + d, {{d, CGAL::NULL_VECTOR, CGAL::NULL_VECTOR}, d, CGAL::NULL_VECTOR}, {}, false, true});
  };
  const std::vector<Vector3> directions = apex.into_cell(scene.cell(), {});
  if (directions.empty() || std::any_of(pieces.begin(), pieces.end(), [&](std::uint32_t t) {
        return exact::lies_in(scene.cell(), complex.planes[t]);
      })) {
    add(scene.cell().center() - complex.points[point]);
    sources.back().walk.unresolved = true;
    return;
  }
  for (const Vector3& d : directions) add(d);
}

}  // namespace

std::vector<Source> edge_sources(const exact::SceneQuery& scene, const Walker& walker,
                                 const std::vector<ContourEdge>& contours, const std::vector<std::vector<Point3>>& cuts,
                                 std::vector<Source> known_sources, std::uint64_t& walks) {
  const exact::Complex& complex = scene.complex();
  std::map<std::tuple<std::size_t, Point3>, Source> known;
  for (Source& s : known_sources) known.emplace(std::tuple(s.contour, s.y), std::move(s));
  std::vector<Source> sources;
  for (std::size_t c = 0; c < contours.size(); ++c) {
    const exact::Edge& e = complex.edges[contours[c].edge];
    const std::vector<Point3>& cut = cuts[contours[c].edge];
    std::vector<Point3> stops{complex.points[e.a]};
    if (before(complex.points[e.a], complex.points[e.b])) {
      stops.insert(stops.end(), cut.begin(), cut.end());
    } else {
      stops.insert(stops.end(), cut.rbegin(), cut.rend());
    }
    stops.push_back(complex.points[e.b]);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      Source s;
      s.contour = c;
      s.lo = stops[i];
      s.hi = stops[i + 1];
      s.y = exact::simple_between(complex.points[e.a], complex.points[e.b], s.lo, s.hi);
      sources.push_back(std::move(s));
    }
  }
  std::vector<Source*> unknown;
  for (Source& s : sources) {
    const auto it = known.find(std::tuple(s.contour, s.y));
    if (it == known.end()) {
      unknown.push_back(&s);
    } else {
      s.walk = std::move(it->second.walk);
      s.seed = it->second.seed;
      s.least = it->second.least;
    }
  }
  tbb::parallel_for(std::size_t{0}, unknown.size(), [&](std::size_t i) {
    Source& s = *unknown[i];
    s.walk = walker.walk(start_of(s, contours), s.seed);
    for (int attempt = 1; attempt < 4 && s.walk.special; ++attempt) {
      ask_elsewhere(s, attempt);
      s.walk = walker.walk(start_of(s, contours), s.seed);
    }
  });
  walks += unknown.size();
  return sources;
}

bool look_again(const exact::SceneQuery& scene, const Apex& apex, VertexSource& s, int attempt) {
  Point3 v = s.x + s.towards;
  if (attempt > 0) {
    std::vector<int> weights;
    for (std::size_t j = 0; j < scene.cell().vertices().size(); ++j)
      weights.push_back(1 + (attempt * 7 + static_cast<int>(j) * 5) % 11);
    exact::FT pull(1);
    for (int i = 0; i < attempt; ++i) pull = pull / exact::FT(8);
    v = exact::collapsed(v + pull * (scene.cell().interior_point(weights) - v));
    if (!apex.in_one_part(s.towards, v - s.x)) return false;
  }
  if (scene.crossings(v, s.x).degenerate) return false;
  s.v = v;
  s.probe = {{v - s.x, CGAL::NULL_VECTOR, CGAL::NULL_VECTOR}, v - s.x, CGAL::NULL_VECTOR};
  return true;
}

void ask_elsewhere(Source& s, int attempt) {
  s.y = s.lo + exact::FT(29 * attempt % 64 + 1) / exact::FT(67) * (s.hi - s.lo);
  s.y = exact::collapsed(s.y);
}

std::vector<VertexSource> vertex_sources(const exact::SceneQuery& scene, const Walker& walker,
                                         const std::function<const Apex&(std::uint32_t)>& corner,
                                         std::uint64_t& walks) {
  const exact::Complex& complex = scene.complex();
  const std::vector<Point3>& cell = scene.cell().vertices();
  std::vector<VertexSource> sources;
  for (std::uint32_t p = 0; p < complex.points.size(); ++p) {
    if (complex.point_pieces[p].empty()) continue;  // of a part of a complex, or inside the cell
    const Apex& apex = corner(p);
    const Point3& x = complex.points[p];
    if (apex.flat()) {
      flat_sources(scene, p, apex, sources);
      continue;
    }
    std::vector<Vector3> directions;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      std::vector<int> weights;
      for (std::size_t j = 0; j < cell.size(); ++j)
        weights.push_back(i == j ? 5003 : 3 + static_cast<int>((7 * j + 11 * i + p) % 13));
      const Vector3 d = scene.cell().interior_point(weights) - x;
      if (apex.has_sector_facing(d)) directions.push_back(d);
    }
    for (const Vector3& d : apex.into_cell(scene.cell(), directions)) directions.push_back(d);
    for (const Vector3& d : directions) sources.push_back(vertex_source(scene, p, apex, d));
  }
  tbb::parallel_for(std::size_t{0}, sources.size(), [&](std::size_t i) {
    if (!sources[i].walk.unresolved) sources[i].walk = walker.walk(start_of(sources[i]), kSourceSeed);
  });
  walks += sources.size();
  return sources;
}

}  // namespace clues::reference
