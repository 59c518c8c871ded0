// clues map for scenes in which some triangles do not block or do not count (D22): lists, by the fast kernel, or by the exact one layer by layer.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/map/cell_mapper.h"
#include "exact/threads.h"
#include "fastpath/visibility/see_through.h"
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
    result.stats = {{"blocking_triangles", blocking_},
                    {"conservative_fallbacks", static_cast<std::int64_t>(fallbacks)},
                    {"counting_triangles", counting_}};
    MappedCell mapped;
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
    auto options = request_.method.to_reference();
    options.threads = threads;
    options.progress = progress;
    const auto map = reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(spec.points), options);
    fallbacks += map.statistics.conservative_fallbacks;
    return map.visible;
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
  for (const auto& [asked, option] : {std::pair{request.with_map, "--map"},
                                      {!request.umbra.file.empty(), "--umbra"},
                                      {!request.fragments.empty(), "--fragments"},
                                      {!request.overlap_graph.empty(), "--overlap-graph"},
                                      {request.refinement != validate::Refinement::none, "refinement"},
                                      {request.method.mode == "solid", "--mode solid"},
                                      {request.simplify.asked(), "simplification"}}) {
    if (asked) {
      throw scene::Error(
          scene::ErrorCode::unsupported,
          request.scene +
              ": some triangles do not block or do not count, and of such scenes only lists are made; leave out " +
              option);
    }
  }
  if (request.method.kernel == "fast" && request.method.formulation != "plain")
    throw scene::Error(scene::ErrorCode::unsupported, "--formulation needs exact numbers; use --kernel exact with it");
  return std::make_unique<SeeThroughMapper>(scene, sha256, request);
}

}  // namespace clues::app
