// clues map --kernel exact: the reference, and what is derived from its map.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/map/cell_mapper.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/map/omega.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/traversal/overlap.h"
#include "scene/messages/percent.h"
#include "validate/stream/fragments_file.h"

namespace clues::app {
namespace {

std::string table_line(const std::string& name, const reference::VisibilityMap& map) {
  const auto census = take_census(map);
  const std::string share = scene::percent(census.area_visible_estimate, census.area_facing_estimate, 2);
  const std::string in_doubt = map.method == "first-order" ? std::to_string(map.in_doubt.size()) : "-";
  return fmt::format("{:>9}  {:>6}  {:>6}  {:>6}  {:>10} %  {:>9}  {:>8}  {}\n", map.complex.input_triangles,
                     census.wholly, census.partly, census.hidden, share, map.statistics.conservative_fallbacks,
                     in_doubt, name);
}

std::string overlap_graph_of(const reference::VisibilityMap& map) {
  const exact::SceneQuery scene(map.complex, map.cell);
  return reference::to_graphviz(reference::overlap_of_occluders(scene), scene);
}

class ExactMapper : public CellMapper {
 public:
  ExactMapper(const scene::TriangleMesh& mesh, std::string sha256, const MapRequest& request)
      : mesh_(mesh), sha256_(std::move(sha256)), request_(request) {}

  MappedCell map(const scene::CellSpec& spec, int threads, const reference::Progress& progress) const override {
    auto options = request_.method.to_reference();
    options.threads = threads;
    options.progress = progress;
    const auto cell = exact::ConvexCell::from_doubles(spec.points);
    if (request_.refinement != validate::Refinement::none) return simplified(refined(cell, options), spec, threads);
    reference::Omega omega(mesh_, cell, options);
    if (request_.umbra.file.empty()) return simplified(std::move(omega).take_map(), spec, threads);
    if (progress) progress("umbra", 0, 1);
    MappedCell out = mapped(omega.map(), spec);
    UmbraOutput umbra = make_umbra(omega, scene::FlaggedMesh{mesh_, {}, {}, {}}, spec, request_.scene, sha256_,
                                   request_.umbra, threads);
    out.umbra_bytes = std::move(umbra.bytes);
    out.umbra_summary = std::move(umbra.summary);
    return out;
  }
  const char* table_head() const override {
    return "triangles  wholly  partly  hidden  visible area  fallbacks  in doubt  cell\n";
  }

 private:
  reference::VisibilityMap refined(const exact::ConvexCell& cell, const reference::Options& options) const {
    reference::Bounds bounds(mesh_, cell, options);
    validate::refine(bounds, request_.refinement, request_.refine.to_reference());
    return bounds.refined_map(request_.refinement == validate::Refinement::cells ? "subdivided" : "backprojected");
  }
  MappedCell mapped(const reference::VisibilityMap& map, const scene::CellSpec& spec,
                    const std::optional<scene::Simplification>& simplification = {},
                    const std::string& about_simplification = "") const {
    MappedCell out;
    out.name = spec.name;
    put_result(out, reference::to_result(map, spec, request_.with_map, request_.with_states), request_, sha256_,
               simplification);
    out.summary = table_line(spec.name, map) + about_simplification;
    if (!request_.overlap_graph.empty()) out.overlap_graph = overlap_graph_of(map);
    if (!request_.fragments.empty()) put_fragments(map, out);
    return out;
  }
  void put_fragments(const reference::VisibilityMap& map, MappedCell& out) const {
    auto record = validate::fragments_of(map);
    record.scene_file = std::filesystem::path(request_.scene).filename().string();
    record.scene_sha256 = sha256_;
    out.fragments_bytes = validate::to_bytes_of(record, request_.fragments);
    out.fragments_summary =
        fmt::format("fragments: {} triangles, {} corners\n", record.fragments.size(), record.exact.size());
  }
  MappedCell simplified(const reference::VisibilityMap& map, const scene::CellSpec& spec, int threads) const {
    if (!request_.simplify.asked()) return mapped(map, spec);
    const auto simpler = reference::with_simpler_occlusion(map, request_.simplify.to_reference(threads));
    const scene::Simplification record = record_of(simpler, request_.simplify);
    return mapped(simpler.map, spec, record, summary_of(simpler, record));
  }

  const scene::TriangleMesh& mesh_;
  std::string sha256_;
  const MapRequest& request_;
};

}  // namespace

std::unique_ptr<CellMapper> exact_mapper(const scene::TriangleMesh& mesh, const std::string& sha256,
                                         const MapRequest& request) {
  return std::make_unique<ExactMapper>(mesh, sha256, request);
}

}  // namespace clues::app
