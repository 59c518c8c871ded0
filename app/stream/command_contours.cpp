// clues delta contours: the maps of cells, found again from that of a cell that holds them (D26), and what that takes in bytes.
#include "app/stream/command_contours.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "app/stream/number_between.h"
#include "app/stream/served_cells.h"
#include "reference/contours/contour_code.h"
#include "reference/contours/list_contour.h"
#include "reference/delta/delta.h"
#include "scene/bakes/packed_list.h"
#include "scene/cell_spec.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"

namespace clues::app {
namespace {

using reference::FlatSet;
using scene::Error;
using scene::ErrorCode;

struct ContoursRequest {
  std::string scene, parent, cells, bake;
  double reach = 0;
  MethodOptions method;
};

struct SizesOfCell {
  std::string name;
  std::size_t seeds = 0, segments = 0;
  std::size_t list = 0, delta = 0, contours = 0, packed = 0;  // bytes
  std::uint64_t in_full = 0;
  const char* decoded = "";
};

bool holds(const std::vector<FlatSet>& a, const std::vector<FlatSet>& b) {
  for (std::size_t s = 0; s < a.size(); ++s) {
    if (!subtract(b[s], a[s]).empty()) return false;
  }
  return true;
}

// Maps, codes, decodes and compares.
class Contours {
 public:
  Contours(const scene::TriangleMesh& mesh, const exact::ConvexCell& parent, const reference::Options& options,
           double reach)
      : mesh_(mesh),
        options_(options),
        reach_(reach),
        sides_(reference::input_sides(mesh, options.mode)),
        parent_(reference::first_order_visibility(mesh, parent, options)),
        known_(reference::visible_on(sides_, mesh, parent_)) {}

  SizesOfCell of(const scene::CellSpec& spec) const {
    const auto cell = exact::ConvexCell::from_doubles(spec.points);
    const auto map = reference::first_order_visibility(mesh_, cell, options_);
    const auto seen = reference::visible_on(sides_, mesh_, map);
    const auto wanted =
        reach_ > 0 ? reference::with_far_sides_of(sides_, mesh_, known_, seen, cell, exact::FT(reach_)) : seen;
    const auto label = reference::contour_label(sides_, mesh_, known_, wanted);
    reference::PlaneTable planes(mesh_, cell);
    planes.add_wedges(map);
    const auto code = reference::encoded_contours(sides_, mesh_, known_, label, planes);
    const auto back =
        reference::flooded(sides_, mesh_, known_, reference::decoded_contours(sides_, mesh_, known_, cell, code.bytes));
    if (!holds(back, seen)) throw Error(ErrorCode::internal, "cell " + spec.name + ": decoding lost what is visible");
    const auto triangles = static_cast<std::uint32_t>(mesh_.triangles.size());
    const auto packets = reference::packets_of(parent_.visible, map.visible);
    SizesOfCell sizes{spec.name, label.seeds.size(), label.segments.size()};
    sizes.list = scene::packed_list(map.visible, triangles).size();
    sizes.delta = scene::packed_list(packets.minus, triangles).size();
    sizes.contours = code.bytes.size();
    sizes.packed = scene::packed_bytes(code.bytes).size();
    sizes.in_full = code.ends_in_full;
    sizes.decoded = holds(seen, back) ? "exact" : "conservative";
    return sizes;
  }

 private:
  const scene::TriangleMesh& mesh_;
  reference::Options options_;
  double reach_;
  std::vector<reference::InputSide> sides_;
  reference::VisibilityMap parent_;
  std::vector<FlatSet> known_;
};

// Of a bake there are lists only. From each cell to each neighbour: what comes, and what goes, as a list of it or as the
// contour of what stays.
int run_list_contours(const ContoursRequest& request) {
  const ServedCells served = served_cells({request.scene, {}, request.bake});
  const reference::EdgeUsers edges(served.scene.mesh);
  const auto triangles = static_cast<std::uint32_t>(served.scene.mesh.triangles.size());
  std::uint64_t transitions = 0, whole = 0, plus = 0, minus = 0, contours = 0, packed = 0, listed = 0, seeds = 0,
                boundary = 0;
  for (std::uint32_t a = 0; a < served.lists.size(); ++a) {
    for (const std::uint32_t b : served.neighbours[a]) {
      const auto &from = served.lists[a], &to = served.lists[b];
      const auto packets = reference::packets_of(from, to);
      std::vector<std::uint32_t> stays;
      std::set_intersection(from.begin(), from.end(), to.begin(), to.end(), std::back_inserter(stays));
      const auto contour = reference::list_contour(edges, from, stays);
      const std::string bytes = reference::to_bytes(contour);
      if (reference::flooded_list(edges, from, reference::parse_list_contour(bytes, edges)) != stays)
        throw Error(ErrorCode::internal, fmt::format("cells {} to {}: decoding gave another list", a, b));
      ++transitions;
      whole += scene::packed_list(to, triangles).size();
      plus += scene::packed_list(packets.plus, triangles).size();
      minus += scene::packed_list(packets.minus, triangles).size();
      listed += reference::to_bytes({packets.minus, {}}).size() - 1;  // behind it an empty boundary
      contours += bytes.size();
      packed += scene::packed_bytes(bytes).size();
      seeds += contour.seeds.size();
      boundary += contour.boundary.size();
    }
  }
  const auto mean = [&](std::uint64_t sum) {
    return static_cast<double>(sum) / static_cast<double>(std::max<std::uint64_t>(transitions, 1));
  };
  print(
      fmt::format("{} transitions; bytes for each, on average:\n"
                  "  list {:.1f}   delta {:.1f} (+ {:.1f}, - {:.1f}; - as differences of ids {:.1f})\n"
                  "  contours in place of - {:.1f}, packed {:.1f}\n"
                  "  ({:.1f} seeds, {:.1f} edges)\n",
                  transitions, mean(whole), mean(plus + minus), mean(plus), mean(minus), mean(listed), mean(contours),
                  mean(packed), mean(seeds), mean(boundary)));
  return fine;
}

int run_contours(const ContoursRequest& request) {
  if (!request.bake.empty()) return run_list_contours(request);
  if (request.parent.empty() || request.cells.empty())
    throw Error(ErrorCode::bad_argument, "give --parent and --cells, or --bake");
  const auto options = request.method.to_reference();
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto parent = exact::ConvexCell::from_doubles(scene::parse_cell(request.parent).points);
  const auto cells = scene::parse_cells(request.cells);
  for (const auto& cell : cells) {
    for (const auto& p : cell.points) {
      if (!parent.contains(exact::to_exact(p)))
        throw Error(ErrorCode::bad_cell, "cell " + cell.name + ": is not inside of --parent");
    }
    // T6 asks for int C in int P. C lies in P, so one point of int C in int P is enough.
    if (!parent.interior_contains(exact::ConvexCell::from_doubles(cell.points).center()))
      throw Error(ErrorCode::bad_cell,
                  "cell " + cell.name + ": lies in the border of --parent; give a larger --parent");
  }
  std::vector<SizesOfCell> rows;
  {
    ProgressBar bar("clues delta contours");
    bar.show("cells", 0, cells.size() + 1);
    const Contours contours(mesh, parent, options, request.reach);
    for (const auto& cell : cells) {
      bar.show("cells", rows.size() + 1, cells.size() + 1);
      rows.push_back(contours.of(cell));
    }
  }
  std::string text = fmt::format("{:<10} {:>6} {:>9} {:>8}  {:>8} {:>8} {:>9} {:>8}  {}\n", "cell", "seeds", "segments",
                                 "in full", "list", "delta", "contours", "packed", "decoded");
  for (const auto& r : rows)
    text += fmt::format("{:<10} {:>6} {:>9} {:>8}  {:>8} {:>8} {:>9} {:>8}  {}\n", r.name, r.seeds, r.segments,
                        r.in_full, r.list, r.delta, r.contours, r.packed, r.decoded);
  print(text);
  return fine;
}

}  // namespace

void add_delta_contours(CLI::App& delta, int& status) {
  auto* command = delta.add_subcommand("contours", "Maps of cells from the map of a cell that holds them");
  auto request = std::make_shared<ContoursRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--parent", request->parent, "The cell whose map is known")->type_name("SPEC");
  auto* cells =
      command->add_option("--cells", request->cells, "Cells inside of it, as `clues map --cells`")->type_name("SPEC");
  command->add_option("--bake", request->bake, "Whole triangles, of all transitions between neighbours in this bake")
      ->type_name("FILE")
      ->excludes(cells);
  command
      ->add_option(
          "--reach", request->reach,
          "Take what is farther than so many diameters of the cell as the parent sees it; 0: nothing (default)")
      ->type_name("X")
      ->check(number_between(0, 1e6));
  request->method.add_to(*command);
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Maps the parent and each cell, codes where the cell's map ends within the parent's as labels of "
          "edges and\n"
          "  vertices, decodes that again, floods the parent's map from the seeds, and compares (docs/delta.md). "
          "Bytes:\n"
          "  the list of what is visible and the list of what is not any more, both packed by zstd; the "
          "contours, plain\n"
          "  and packed.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues delta contours town.obj --parent box:0,0,1,4,4,2 --cells grid:2x2x1:box:0,0,1,4,4,2\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 -o town.bake && clues delta contours town.obj --bake "
      "town.bake\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_contours(*request); });
}

}  // namespace clues::app
