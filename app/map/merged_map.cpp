#include "app/map/merged_map.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace clues::app {

std::uint64_t MergedMap::vertex(const Vertex& exact) {
  const auto [at, is_new] = vertices_.emplace(exact, out_.mesh.vertices_exact.size());
  if (is_new) out_.mesh.vertices_exact.push_back(exact);
  return at->second;
}

void MergedMap::take(const scene::Result& from, const std::vector<std::uint32_t>& ids,
                     const std::vector<std::uint32_t>& wanted, bool hidden) {
  const auto is_wanted = [&](std::uint32_t t) { return std::binary_search(wanted.begin(), wanted.end(), t); };
  std::vector<std::vector<std::uint64_t>> places;  // per region of `from`: its place here, or none
  for (scene::MapRegion region : from.regions) {
    places.emplace_back();
    if (!is_wanted(region.triangle)) continue;
    region.triangle = ids[region.triangle];
    region.visible = region.visible && !hidden;
    places.back().push_back(out_.regions.size());
    out_.regions.push_back(std::move(region));
  }
  for (scene::MapSegment segment : from.segments) {
    if (!is_wanted(segment.triangle)) continue;
    segment.triangle = ids[segment.triangle];
    segment.boundary = segment.boundary && !hidden;
    out_.segments.push_back(std::move(segment));
  }
  take_mesh(from, places, hidden);
}

// A face is taken where one of its regions is. The faces on both sides of an edge are of the same triangles.
void MergedMap::take_mesh(const scene::Result& from, const std::vector<std::vector<std::uint64_t>>& places,
                          bool hidden) {
  std::vector<std::optional<std::uint64_t>> face_of;
  for (const auto& face : from.mesh.faces) {
    scene::MapMesh::Face taken;
    for (const auto r : face.regions) taken.regions.insert(taken.regions.end(), places[r].begin(), places[r].end());
    face_of.emplace_back();
    if (taken.regions.empty()) continue;
    for (const auto& ring : face.rings) {
      taken.rings.emplace_back();
      for (const auto v : ring) taken.rings.back().push_back(vertex(from.mesh.vertices_exact[v]));
    }
    face_of.back() = out_.mesh.faces.size();
    out_.mesh.faces.push_back(std::move(taken));
  }
  for (const auto& edge : from.mesh.edges) {
    if (!face_of[edge.faces.front()]) continue;
    scene::MapMesh::Edge taken{hidden && edge.kind == "ob" ? "dm" : edge.kind, {}, {}};
    for (std::size_t i = 0; i < 2; ++i) taken.ends[i] = vertex(from.mesh.vertices_exact[edge.ends[i]]);
    for (const auto f : edge.faces) taken.faces.push_back(face_of[f].value());
    out_.mesh.edges.push_back(std::move(taken));
  }
}

}  // namespace clues::app
