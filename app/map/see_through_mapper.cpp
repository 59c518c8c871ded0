// clues map for scenes in which some triangles do not block or do not count (D22): lists, by the fast kernel, or by the exact one layer by layer; and by
// the exact one regions, triangle by triangle, and the umbra of what blocks.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/map/cell_mapper.h"
#include "app/map/merged_map.h"
#include "exact/threads.h"
#include "fastpath/visibility/see_through.h"
#include "reference/visibility/map/omega.h"
#include "scene/messages/error.h"
#include "validate/see_through/layers.h"

namespace clues::app {
namespace {

class SeeThroughMapper : public CellMapper {
 public:
  SeeThroughMapper(const scene::FlaggedMesh& scene, std::string sha256, const MapRequest& request)
      : scene_(scene), sha256_(std::move(sha256)), request_(request) {
    const auto total = static_cast<std::uint32_t>(scene.mesh.triangles.size());
    for (std::uint32_t t = 0; t < total; ++t) {
      blocking_ += scene.blocking(t) ? 1 : 0;
      counting_ += scene.counting(t) ? 1 : 0;
    }
    if (request.method.kernel == "fast") fast_ = std::make_unique<fastpath::SeeThroughScene>(scene);
  }

  MappedCell map(const scene::CellSpec& spec, int threads, const reference::Progress& progress) const override {
    std::vector<std::uint32_t> visible;
    std::uint64_t fallbacks = 0;
    if (request_.method.kernel == "fast") {
      const auto found = exact::by_threads(
          threads, [&] { return fastpath::visible_through(*fast_, spec.points, fastpath::LocalMapOptions{}); });
      visible = found.counting(scene_);
      fallbacks = found.conservative_fallbacks;
    } else {
      visible = validate::visible_in_layers(
          scene_, [&](const scene::TriangleMesh& mesh) { return exactly(mesh, spec, threads, progress, fallbacks); });
    }
    scene::Result result;
    result.scene_triangles = scene_.mesh.triangles.size();
    result.cell = spec.points;
    result.kernel = request_.method.kernel;
    result.mode = request_.method.mode;
    result.visible = visible;
    result.stats = {{"blocking_triangles", blocking_}, {"counting_triangles", counting_}};
    MappedCell mapped;
    if (request_.with_map) put_regions(result, spec, threads, fallbacks);
    if (!request_.umbra.file.empty()) put_umbra(mapped, spec, threads, progress);
    result.stats["conservative_fallbacks"] = static_cast<std::int64_t>(fallbacks);
    if (request_.covered_sides) result.stats["covered_hull_sides_left_out"] = *request_.covered_sides;
    mapped.name = spec.name;
    mapped.summary = fmt::format("{:>9}  {:>8}  {:>8}  {:>7}  {:>9}  {}\n", scene_.mesh.triangles.size(), blocking_,
                                 counting_, visible.size(), fallbacks, spec.name);
    put_result(mapped, std::move(result), request_, sha256_);
    return mapped;
  }
  const char* table_head() const override { return "triangles  blocking  counting  visible  fallbacks  cell\n"; }

 private:
  std::vector<std::uint32_t> exactly(const scene::TriangleMesh& mesh, const scene::CellSpec& spec, int threads,
                                     const reference::Progress& progress, std::uint64_t& fallbacks) const {
    const auto map = reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(spec.points),
                                                       options_for(threads, progress));
    fallbacks += map.statistics.conservative_fallbacks;
    return map.visible;
  }

  reference::Options options_for(int threads, const reference::Progress& progress) const {
    auto options = request_.method.to_reference();
    options.threads = threads;
    options.progress = progress;
    return options;
  }

  // What the layers proved hidden stays hidden, whatever it looks like alone.
  void put_regions(scene::Result& result, const scene::CellSpec& spec, int threads, std::uint64_t& fallbacks) const {
    result.has_map = true;
    MergedMap merged(result);
    const auto blocking = scene::blocking_ids(scene_);
    if (!blocking.empty()) {
      scene::Result opaque = map_of(scene::part_of(scene_.mesh, blocking), spec, threads, fallbacks);
      std::vector<std::uint32_t> counting;
      for (std::uint32_t t = 0; t < blocking.size(); ++t) {
        if (scene_.counting(blocking[t])) counting.push_back(t);
      }
      merged.take(opaque, blocking, counting, false);
      result.wedges = std::move(opaque.wedges);
    }
    for (std::uint32_t t = 0; t < scene_.mesh.triangles.size(); ++t) {
      if (scene_.blocking(t)) continue;
      const auto alone = validate::asked_alone(scene_, t);
      const bool listed = std::binary_search(result.visible.begin(), result.visible.end(), t);
      merged.take(map_of(alone.mesh, spec, threads, fallbacks), alone.ids, {alone.triangle}, !listed);
    }
  }

  scene::Result map_of(const scene::TriangleMesh& mesh, const scene::CellSpec& spec, int threads,
                       std::uint64_t& fallbacks) const {
    const auto map =
        reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(spec.points), options_for(threads, {}));
    fallbacks += map.statistics.conservative_fallbacks;
    return reference::to_result(map, spec, true);
  }

  void put_umbra(MappedCell& mapped, const scene::CellSpec& spec, int threads,
                 const reference::Progress& progress) const {
    const reference::Omega omega(scene::part_of(scene_.mesh, scene::blocking_ids(scene_)),
                                 exact::ConvexCell::from_doubles(spec.points), options_for(threads, progress));
    UmbraOutput umbra = make_umbra(omega, scene_, spec, request_.scene, sha256_, request_.umbra, threads);
    mapped.umbra_bytes = std::move(umbra.bytes);
    mapped.umbra_summary = std::move(umbra.summary);
  }

  const scene::FlaggedMesh& scene_;
  std::string sha256_;
  const MapRequest& request_;
  std::unique_ptr<fastpath::SeeThroughScene> fast_;
  std::int64_t blocking_ = 0, counting_ = 0;
};

}  // namespace

std::unique_ptr<CellMapper> see_through_mapper(const scene::FlaggedMesh& scene, const std::string& sha256,
                                               const MapRequest& request) {
  for (const auto& [asked, option] : {std::pair{!request.fragments.empty(), "--fragments"},
                                      {request.with_states, "--render-states"},
                                      {!request.overlap_graph.empty(), "--overlap-graph"},
                                      {request.refinement != validate::Refinement::none, "refinement"},
                                      {request.method.mode == "solid", "--mode solid"},
                                      {request.simplify.asked(), "simplification"}}) {
    if (asked) {
      throw scene::Error(scene::ErrorCode::unsupported,
                         request.scene +
                             ": some triangles do not block or do not count, and of such scenes only lists, maps and "
                             "umbrae are made; leave out " +
                             option);
    }
  }
  if (request.method.kernel == "fast" && (request.with_map || !request.umbra.file.empty()))
    throw scene::Error(scene::ErrorCode::unsupported, "--map and --umbra need exact numbers; use --kernel exact");
  if (request.method.kernel == "fast" && request.method.formulation != "plain")
    throw scene::Error(scene::ErrorCode::unsupported, "--formulation needs exact numbers; use --kernel exact with it");
  return std::make_unique<SeeThroughMapper>(scene, sha256, request);
}

}  // namespace clues::app
