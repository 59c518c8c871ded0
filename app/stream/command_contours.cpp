// clues delta contours: the maps of cells, each coded within that of a cell that holds it (D26), and what that takes in bytes.
#include "app/stream/command_contours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "app/stream/number_between.h"
#include "app/stream/served_cells.h"
#include "app/stream/within_range.h"
#include "reference/contours/contour_maker.h"
#include "reference/contours/list_contour.h"
#include "reference/delta/delta.h"
#include "scene/bakes/packed_list.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/contour_file.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct ContoursRequest {
  std::string scene, parent, cells, bake, out;
  double reach = 0;
  int levels = 0;
  MethodOptions method;
};

// A cell of the file to be, and the one around it.
struct PlacedCell {
  scene::CellSpec spec;
  std::uint32_t within = 0;  // as scene::ContourCell
  bool is_around = false;
};

// Of the cells of a grid, those that a coarser one joins are named as it; "i,j,k" in the grid that is half as fine.
std::string name_in_half(const std::string& name) {
  std::array<std::uint64_t, 3> at{};
  if (std::sscanf(name.c_str(), "%lu,%lu,%lu", &at[0], &at[1], &at[2]) != 3) return "";
  return fmt::format("{},{},{}", at[0] / 2, at[1] / 2, at[2] / 2);
}

// The parent, then the levels below it, then the cells: parents first.
std::vector<PlacedCell> placed_cells(const ContoursRequest& request) {
  std::vector<std::vector<scene::CellSpec>> levels{scene::parse_cells(request.cells)};
  std::vector<std::vector<std::size_t>> above;  // of each cell of a level, its place in the next
  for (int i = 0; i < request.levels; ++i) {
    std::vector<scene::CellSpec> joined;
    std::map<std::string, std::size_t> places;
    above.emplace_back();
    for (const auto& cell : levels.back()) {
      const std::string name = name_in_half(cell.name);
      if (name.empty()) throw Error(ErrorCode::bad_argument, "--levels: --cells has to be a grid of several cells");
      const auto [at, is_new] = places.try_emplace(name, joined.size());
      if (is_new) joined.push_back({name, {}});
      auto& points = joined[at->second].points;
      points.insert(points.end(), cell.points.begin(), cell.points.end());
      above.back().push_back(at->second);
    }
    levels.push_back(std::move(joined));
  }
  std::vector<PlacedCell> out{{scene::parse_cell(request.parent), 0, true}};
  out[0].spec.name = "parent";
  std::size_t first_above = 0;
  for (std::size_t level = levels.size(); level-- > 0;) {
    const std::size_t first = out.size();
    for (std::size_t c = 0; c < levels[level].size(); ++c) {
      const std::size_t place = level + 1 == levels.size() ? 0 : first_above + above[level][c];
      if (level > 0) levels[level][c].name = fmt::format("{} (level {})", levels[level][c].name, level);
      out.push_back({levels[level][c], static_cast<std::uint32_t>(1 + place), level > 0});
    }
    first_above = first;
  }
  return out;
}

void require_within(const PlacedCell& cell, const std::vector<PlacedCell>& cells) {
  const auto& around = cells[cell.within - 1];
  const auto hull = exact::ConvexCell::from_doubles(around.spec.points);
  const char* const named = cell.within == 1 ? "--parent" : "the cell around it";
  for (const auto& p : cell.spec.points) {
    if (!hull.contains(exact::to_exact(p)))
      throw Error(ErrorCode::bad_cell, fmt::format("cell {}: is not inside of {}", cell.spec.name, named));
  }
  const auto inner = exact::ConvexCell::from_doubles(cell.spec.points);
  // T6 asks for int C in int P. C lies in P, so one point of int C in int P is enough.
  if (!hull.interior_contains(inner.center()))
    throw Error(ErrorCode::bad_cell,
                fmt::format("cell {}: lies in the border of {}; give a larger --parent", cell.spec.name, named));
  if (hull.dimension() < 3 && inner.dimension() < hull.dimension())
    throw Error(ErrorCode::bad_cell,
                fmt::format("cell {}: has fewer dimensions than {}, which is not solid, and may see "
                            "what that does not; give a solid --parent, or cells of one kind",
                            cell.spec.name, named));
}

// One line of the table. `lists`: of the maps of cells before.
std::string line_of(const scene::ContourFile& file, const reference::MadeContours& made,
                    const std::vector<std::vector<std::uint32_t>>& lists) {
  const auto number = static_cast<std::uint32_t>(file.cells.size() - 1);
  const scene::ContourCell& cell = file.cells[number];
  const auto triangles = static_cast<std::uint32_t>(file.scene_triangles);
  const std::string bytes = scene::contour_bytes(file.cells, number);
  const std::string delta =
      cell.within == 0
          ? "-"
          : fmt::format("{}",
                        scene::packed_list(reference::packets_of(lists[cell.within - 1], made.visible).minus, triangles)
                            .size());
  return fmt::format("{:<16} {:>6} {:>9} {:>8}  {:>8} {:>8} {:>9} {:>8}  {}\n", cell.name, made.seeds, made.segments,
                     made.counts.in_full, scene::packed_list(made.visible, triangles).size(), delta, bytes.size(),
                     scene::packed_bytes(bytes).size(), cell.exact ? "exact" : "conservative");
}

// Of a bake there are lists only. From each cell to each neighbour: what comes, and what goes, as a list of it or as the
// contour of what stays.
int run_list_contours(const ContoursRequest& request) {
  const ServedCells served = served_cells({request.scene, {}, request.bake, {}});
  const reference::EdgeUsers edges(served.scene.mesh);
  reference::ListFloods floods(edges);
  const auto triangles = static_cast<std::uint32_t>(served.scene.mesh.triangles.size());
  std::uint64_t transitions = 0, whole = 0, plus = 0, minus = 0, contours = 0, packed = 0, listed = 0, seeds = 0,
                boundary = 0;
  for (std::uint32_t a = 0; a < served.lists.size(); ++a) {
    for (const std::uint32_t b : served.neighbours[a]) {
      const auto &from = served.lists[a], &to = served.lists[b];
      const auto packets = reference::packets_of(from, to);
      std::vector<std::uint32_t> stays;
      std::set_intersection(from.begin(), from.end(), to.begin(), to.end(), std::back_inserter(stays));
      const auto contour = floods.contour(from, stays);
      const std::string bytes = reference::to_bytes(contour);
      if (floods.list(from, reference::parse_list_contour(bytes, edges)) != stays)
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
  if (!request.bake.empty()) {
    if (!request.out.empty() || request.levels > 0)
      throw Error(ErrorCode::unsupported, "-o and --levels: of --cells only; lists of a bake have no regions");
    return run_list_contours(request);
  }
  if (request.parent.empty() || request.cells.empty())
    throw Error(ErrorCode::bad_argument, "give --parent and --cells, or --bake");
  const auto options = request.method.to_reference();
  require_writable_parent(request.out);
  require_apart({&request.out}, {&request.scene, &request.parent, &request.cells});
  scene::TriangleMesh mesh;
  const auto sha256 = sha256_around(request.scene, [&] { mesh = scene::read_plain_scene(request.scene); });
  const auto cells = placed_cells(request);
  require_within_range(request.scene, mesh.points);
  for (const auto& cell : cells) require_within_range("cell " + cell.spec.name, cell.spec.points);
  for (const auto& cell : cells) {
    if (cell.within != 0) require_within(cell, cells);
  }
  reference::ContourMaker maker(mesh, options, request.reach);
  std::vector<std::vector<std::uint32_t>> lists;
  std::string text = fmt::format("{:<16} {:>6} {:>9} {:>8}  {:>8} {:>8} {:>9} {:>8}  {}\n", "cell", "seeds", "segments",
                                 "in full", "list", "delta", "contours", "packed", "decoded");
  {
    ProgressBar bar("clues delta contours");
    for (const auto& cell : cells) {
      bar.show("cells", lists.size(), cells.size());
      const auto& made =
          maker.add(cell.spec.name, exact::ConvexCell::from_doubles(cell.spec.points), cell.within, cell.is_around);
      text += line_of(maker.file(), made, lists);
      lists.push_back(made.visible);
    }
  }
  if (!request.out.empty()) {
    auto file = maker.file();
    file.scene_sha256 = sha256;
    const std::string bytes = scene::to_bytes(file);
    scene::write_file_atomically(request.out, bytes);
    text += fmt::format("{}: {} cells in {} bytes\n", request.out, file.cells.size(), bytes.size());
  }
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
  command
      ->add_option("--levels", request->levels,
                   "So many levels of cells between the parent and those of the grid, each joining two along each axis "
                   "(default: 0)")
      ->type_name("N")
      ->check(number_between(0, 20));
  command->add_option("-o,--out", request->out, "The contours, for `clues delta decode` (docs/delta.md)")
      ->type_name("FILE");
  request->method.add_to(*command);
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Maps the parent and each cell, codes where a cell's map ends within that of the cell around it as labels "
          "of\n"
          "  edges and vertices, decodes that again, floods from the seeds, and compares (docs/delta.md). The parent "
          "is\n"
          "  coded within whole triangles, so with -o the file and the scene are all that decoding needs. Bytes:\n"
          "  the list of what is visible, and the list of what is not any more, both packed by zstd; the contours, "
          "plain\n"
          "  and packed.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues delta contours town.obj --parent box:0,0,1,4,4,2 --cells grid:2x2x1:box:0,0,1,4,4,2\n"
      "  clues delta contours town.obj --parent box:0,0,1,4,4,2 --cells grid:4x4x1:box:0,0,1,4,4,2 --levels 1 -o "
      "town.contours\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 -o town.bake && clues delta contours town.obj --bake "
      "town.bake\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_contours(*request); });
}

}  // namespace clues::app
