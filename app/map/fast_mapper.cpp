// clues map --kernel fast: one tree for all cells, then the closure of fastpath/ for each.
#include <fmt/format.h>
#include <algorithm>

#include "app/map/cell_mapper.h"
#include "exact/threads.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement/refinement.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

fastpath::RefineBy refine_by(validate::Refinement refinement) {
  if (refinement == validate::Refinement::cells) return fastpath::RefineBy::cells;
  return refinement == validate::Refinement::both ? fastpath::RefineBy::both : fastpath::RefineBy::backprojection;
}

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
    if (request_.refinement != validate::Refinement::none) return refined(cell, threads);
    const fastpath::FirstOrder found = exact::by_threads(threads, [&] {
      return fastpath::first_order_visibility(bvh_, cell.points, options_,
                                              {.regions = request_.with_map, .in_doubt = true});
    });
    MappedCell mapped;
    mapped.name = cell.name;
    const std::size_t triangles = bvh_.mesh().triangles.size();
    mapped.summary = fmt::format("{:>9}  {:>7}  {:>9}  {:>6}  {:>9}  {:>8}  {}\n", triangles, found.visible.size(),
                                 triangles - found.visible.size(), found.closure.mapped, found.conservative_fallbacks,
                                 found.in_doubt.size(), cell.name);
    scene::Result result = to_result(found, cell);
    result.stats["in_doubt"] = static_cast<std::int64_t>(found.in_doubt.size());
    put_result(mapped, std::move(result), request_, sha256_);
    return mapped;
  }
  const char* table_head() const override {
    return request_.refinement == validate::Refinement::none
               ? "triangles  visible     hidden  mapped  fallbacks  in doubt  cell\n"
               : "triangles  first-order  refined  witnessed  maps  fallbacks  cell\n";
  }

 private:
  MappedCell refined(const scene::CellSpec& cell, int threads) const {
    fastpath::RefinementOptions options;
    options.by = refine_by(request_.refinement);
    options.max_depth = request_.refine.max_depth;
    options.tolerance_area = request_.refine.tolerance_area;
    options.regions = request_.with_map;
    const fastpath::RefinedVisibility found =
        exact::by_threads(threads, [&] { return fastpath::refined_visibility(bvh_, cell.points, options_, options); });
    const fastpath::RefinementFigures& last = found.depths.back();
    MappedCell mapped;
    mapped.name = cell.name;
    mapped.summary = fmt::format("{:>9}  {:>11}  {:>7}  {:>9}  {:>4}  {:>9}  {}\n", bvh_.mesh().triangles.size(),
                                 found.first_order.visible.size(), found.visible.size(), last.witnessed, last.maps,
                                 found.first_order.conservative_fallbacks + found.conservative_fallbacks, cell.name);
    if (request_.cells.empty()) mapped.summary += depths_table(found.depths);
    scene::Result result = to_result(found.first_order, cell);
    result.method = request_.refinement == validate::Refinement::cells ? "subdivided" : "backprojected";
    result.visible = found.visible;
    const auto put = [&](const std::string& name, std::uint64_t value) {
      result.stats[name] = static_cast<std::int64_t>(value);
    };
    put("conservative_fallbacks", found.first_order.conservative_fallbacks + found.conservative_fallbacks);
    put("first_order_visible", found.first_order.visible.size());
    put("refinement_maps", last.maps);
    put("witnessed_visible", last.witnessed);
    for (std::size_t i = 0; i < found.depths.size(); ++i) {
      put(fmt::format("refinement_step_{:02}_parts", i), found.depths[i].parts);
      put(fmt::format("refinement_step_{:02}_visible", i), found.depths[i].visible);
    }
    put_result(mapped, std::move(result), request_, sha256_);
    return mapped;
  }

  // One line a depth; areas where they were asked for.
  static std::string depths_table(const std::vector<fastpath::RefinementFigures>& depths) {
    const bool areas = std::any_of(depths.begin(), depths.end(), [](const auto& d) { return d.first_order_area > 0; });
    std::string table = std::string("\nby              depth  parts  maps  viewpoints  visible  witnessed") +
                        (areas ? "   witnessed area     refined area       first-order" : "") + "\n";
    for (const auto& d : depths) {
      table += fmt::format("{:<14}  {:>5}  {:>5}  {:>4}  {:>10}  {:>7}  {:>9}",
                           d.backprojection ? "backprojection" : "cells", d.depth, d.parts, d.maps, d.viewpoints,
                           d.visible, d.witnessed);
      if (areas)
        table += fmt::format("  {:>15.6g}  {:>15.6g}  {:>15.6g}", d.witnessed_area, d.refined_area, d.first_order_area);
      table += "\n";
    }
    return table;
  }

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
    put("mapped_triangles", found.closure.mapped);
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
                                      {!request.fragments.empty(), "--fragments"},
                                      {!request.overlap_graph.empty(), "--overlap-graph"},
                                      {request.with_states, "--render-states"},
                                      {request.method.formulation != "plain", "--formulation"},
                                      {request.refine.retract, "--retract"},
                                      {request.simplify.asked(), "simplification"}}) {
    if (asked) {
      throw scene::Error(scene::ErrorCode::unsupported,
                         std::string(option) + " needs exact numbers; use --kernel exact with it");
    }
  }
  return std::make_unique<FastMapper>(mesh, sha256, request);
}

}  // namespace clues::app
