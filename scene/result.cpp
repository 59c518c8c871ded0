// The result file "clues-result/1": the visible set (D7) and, on request, the map (D15).
#include "scene/result.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/simplification.h"

namespace clues::scene {
namespace {

using Json = nlohmann::json;  // an object's keys are sorted

const char* side_name(bool front) { return front ? "front" : "back"; }

// Doubles round-trip; one past the range of doubles (its exact text stands beside it) becomes null.
Json to_json(const MapRegion& region) {
  Json json = {{"triangle", region.triangle},
               {"side", side_name(region.front)},
               {"visible", region.visible},
               {"rings", region.rings}};
  if (region.area_fraction.empty()) {
    json["area_estimate"] = region.area_estimate;
  } else {
    json["area_fraction"] = region.area_fraction;
    json["rings_exact"] = region.rings_exact;
  }
  return json;
}

Json to_json(const MapMesh& mesh) {
  Json faces = Json::array(), edges = Json::array();
  for (const auto& f : mesh.faces) faces.push_back({{"regions", f.regions}, {"rings", f.rings}});
  for (const auto& e : mesh.edges) edges.push_back({{"kind", e.kind}, {"ends", e.ends}, {"faces", e.faces}});
  return {{"vertices_exact", mesh.vertices_exact}, {"faces", std::move(faces)}, {"edges", std::move(edges)}};
}

Json to_json(const MapSegment& segment) {
  return {{"triangle", segment.triangle},
          {"side", side_name(segment.front)},
          {"boundary", segment.boundary},
          {"exact", segment.exact},
          {"points", segment.points}};
}

Json to_json(const MapWedge& wedge) {
  return {{"kind", wedge.kind},
          {"generation", wedge.generation},
          {"exact", wedge.exact},
          {"points", wedge.points},
          {"unbounded", wedge.unbounded}};
}

template <class Item>
Json to_array(const std::vector<Item>& items) {
  Json array = Json::array();
  for (const auto& item : items) array.push_back(to_json(item));
  return array;
}

Json to_json(const Result& result) {
  Json json = {
      {"format", "clues-result/1"},
      {"scene", {{"file", result.scene_file}, {"sha256", result.scene_sha256}, {"triangles", result.scene_triangles}}},
      {"cell", {{"vertices", result.cell}}},
      {"method", result.method},
      {"kernel", result.kernel},
      {"mode", result.mode},
      {"visible", result.visible},
      {"stats", result.stats}};
  json["stats"].emplace("conservative_fallbacks", 0);  // unless it is there
  if (result.has_map) {
    json["regions"] = to_array(result.regions);
    for (std::size_t i = 0; i < result.regions.size() && result.has_render_states; ++i)
      json["regions"][i]["render_states"] = result.regions[i].render_states;
    json["mesh"] = to_json(result.mesh);
    json["segments"] = to_array(result.segments);
    json["wedges"] = to_array(result.wedges);
  }
  return json;
}

// File names need not be UTF-8; JSON must.
std::string dumped(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json to_json(const Simplification::Figures& figures) {
  return {{"occlusion_regions", figures.occlusion_regions},
          {"boundary_segments", figures.boundary_segments},
          {"hidden_area_estimate", figures.hidden_area},
          {"visible_triangles", figures.visible_triangles}};
}

}  // namespace

std::string to_json_text(const Result& result) { return dumped(to_json(result)); }

std::string to_json_text(const Result& result, const Simplification& simplification) {
  Json json = to_json(result);
  json["simplification"] = {{"min_occlusion", simplification.min_occlusion},
                            {"simplify_boundaries", simplification.simplify_boundaries},
                            {"before", to_json(simplification.before)},
                            {"after", to_json(simplification.after)}};
  if (simplification.intersect_planes) {
    json["simplification"]["intersect_planes"] = *simplification.intersect_planes;
    json["simplification"]["inside_corners"] = simplification.inside_corners;
    json["simplification"]["by_planes"] = simplification.by_planes;
  }
  return dumped(json);
}

}  // namespace clues::scene
