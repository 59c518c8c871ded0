// clues map --kernel fast: one tree for all cells, then the closure of fastpath/ for each.
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "app/cell_mapper.h"
#include "fastpath/visibility/first_order.h"
#include "scene/error.h"

namespace clues::app {
namespace {

class FastMapper : public CellMapper {
 public:
  FastMapper(const scene::TriangleMesh& mesh, std::string sha256, const MapRequest& request)
      : bvh_(mesh), sha256_(std::move(sha256)), request_(request) {
    if (request.method.mode == "solid") {
      fastpath::require_solid(mesh);
      options_.mode = fastpath::SideMode::solid;
    }
  }

  MappedCell map(const scene::CellSpec& cell, int threads, const reference::Progress& progress) const override {
    if (progress) progress("cell", 0, 1);
    fastpath::FirstOrder found;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] { found = fastpath::first_order_visibility(bvh_, cell.points, options_, request_.with_map); });
    MappedCell mapped;
    mapped.name = cell.name;
    const std::size_t triangles = bvh_.mesh().triangles.size();
    mapped.summary =
        fmt::format("{:>9}  {:>7}  {:>9}  {:>6}  {:>9}  {}\n", triangles, found.visible.size(),
                    triangles - found.visible.size(), found.part.size(), found.conservative_fallbacks, cell.name);
    mapped.bytes = bytes_of(to_result(found, cell), request_, sha256_);
    return mapped;
  }
  const char* table_head() const override { return "triangles  visible     hidden  mapped  fallbacks  cell\n"; }

 private:
  scene::Result to_result(const fastpath::FirstOrder& found, const scene::CellSpec& cell) const {
    scene::Result result;
    result.scene_triangles = bvh_.mesh().triangles.size();
    result.cell = cell.points;
    result.kernel = "fast";
    result.mode = request_.method.mode;
    result.visible = found.visible;
    const auto put = [&](const char* name, std::uint64_t value) {
      result.stats[name] = static_cast<std::int64_t>(value);
    };
    put("conservative_fallbacks", found.conservative_fallbacks);
    put("csv", found.counts.csv);
    put("degenerate_triangles", bvh_.degenerate().size());
    put("exact_decisions", found.counts.exact_decisions);
    put("mapped_triangles", found.part.size());
    put("passes", found.closure.passes);
    put("rounds", found.counts.rounds);
    put("walks", found.counts.walks);
    put("wedges", found.counts.wedges);
    if (!request_.with_map) return result;
    result.has_map = true;
    for (const fastpath::LocalRegion& region : found.regions) {
      scene::MapRegion out;
      out.triangle = region.triangle;
      out.front = region.front;
      out.visible = region.visible;
      out.area_estimate = region.area_estimate;
      out.rings.push_back(region.outline_estimate);
      result.regions.push_back(std::move(out));
    }
    return result;
  }

  fastpath::Bvh bvh_;
  std::string sha256_;
  const MapRequest& request_;
  fastpath::LocalMapOptions options_;
};

}  // namespace

std::unique_ptr<CellMapper> fast_mapper(const scene::TriangleMesh& mesh, const std::string& sha256,
                                        const MapRequest& request) {
  for (const auto& [asked, option] : {std::pair{!request.umbra.file.empty(), "--umbra"},
                                      {!request.overlap_graph.empty(), "--overlap-graph"},
                                      {request.with_states, "--render-states"},
                                      {request.method.formulation != "plain", "--formulation"},
                                      {request.simplify.asked(), "simplification"},
                                      {request.refinement != validate::Refinement::none, "refinement"}}) {
    if (asked) {
      throw scene::Error(scene::ErrorCode::unsupported,
                         std::string(option) + " needs exact numbers; use --kernel exact with it");
    }
  }
  return std::make_unique<FastMapper>(mesh, sha256, request);
}

}  // namespace clues::app
