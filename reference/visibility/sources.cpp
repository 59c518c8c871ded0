#include "reference/visibility/sources.h"

#include <tbb/parallel_for.h>

#include <map>
#include <tuple>

#include "exact/simple_point.h"

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

// x seen along d, or along a direction nearby in the same local face if that sight line is in special position.
VertexSource vertex_source(const exact::SceneQuery& scene, std::uint32_t point, const Apex& apex, const Vector3& d) {
  constexpr int kAttempts = 12;
  const Point3& x = scene.complex().points[point];
  const std::size_t n = scene.cell().vertices().size();
  VertexSource s{point, x, x + d, {}, {}, false};
  exact::FT pull(1);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (!scene.crossings(s.v, x).degenerate && (attempt == 0 || apex.in_one_face(d, s.v - x))) break;
    std::vector<int> weights;
    for (std::size_t j = 0; j < n; ++j) weights.push_back(1 + (attempt * 7 + static_cast<int>(j) * 5) % 11);
    pull = pull / exact::FT(8);
    s.v = exact::collapsed(x + d + pull * (scene.cell().interior_point(weights) - (x + d)));
  }
  s.probe = {{s.v - x, CGAL::NULL_VECTOR, CGAL::NULL_VECTOR}, s.v - x, CGAL::NULL_VECTOR, false};
  return s;
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
    }
  }
  tbb::parallel_for(std::size_t{0}, unknown.size(), [&](std::size_t i) {
    unknown[i]->walk = walker.walk(start_of(*unknown[i], contours), unknown[i]->seed);
  });
  walks += unknown.size();
  return sources;
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
  tbb::parallel_for(std::size_t{0}, sources.size(),
                    [&](std::size_t i) { sources[i].walk = walker.walk(start_of(sources[i]), kSourceSeed); });
  walks += sources.size();
  return sources;
}

}  // namespace clues::reference
