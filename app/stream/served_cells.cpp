#include "app/stream/served_cells.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "app/progress.h"
#include "app/stream/number_between.h"
#include "exact/cell/touching.h"
#include "reference/streams/area_worth.h"
#include "reference/streams/list_store.h"
#include "reference/streams/worth.h"
#include "reference/visibility/first_order.h"
#include "scene/bakes/bake_store.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/list_file.h"
#include "scene/stream/route.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

void require_same_scene(const CellsChoice& choice, const std::string& file, const std::string& sha256,
                        std::uint64_t triangles, const ServedCells& served) {
  if (sha256 != served.header.scene_sha256 || triangles != served.header.scene_triangles)
    throw Error(ErrorCode::bad_argument, file + ": is of another scene than " + choice.scene);
}

void add_cell(const std::string& name, const std::vector<scene::Point>& points, const std::vector<scene::Point>& inner,
              ServedCells& served) {
  served.cells.push_back({name, points});
  served.inner.push_back(inner.empty() ? points : inner);
}

void add_cells_of_bake(const CellsChoice& choice, ServedCells& served) {
  const scene::FinishedBake bake(choice.bake);
  const auto& plan = bake.plan();
  require_same_scene(choice, choice.bake, plan.scene_sha256, plan.triangles, served);
  served.header.cells = plan.question;
  for (std::uint32_t c = 0; c < plan.cells.size(); ++c) {
    add_cell(plan.cells[c].name, plan.cells[c].points, plan.cells[c].inner, served);
    served.lists.push_back(bake.cell(c).list);
  }
}

void add_cells_of_lists(const CellsChoice& choice, ServedCells& served) {
  const auto file = scene::read_lists(choice.lists);
  require_same_scene(choice, choice.lists, file.scene_sha256, file.scene_triangles, served);
  served.header.cells = file.question;
  for (const auto& cell : file.cells) add_cell(cell.name, cell.points, cell.inner, served);
  served.lists = reference::decoded_levels(reference::EdgeUsers(served.scene.mesh), file.levels).back();
}

std::string words_of(const reference::AreaWorth& worth, const ServedCells& served,
                     const std::vector<std::vector<std::uint32_t>>& lists, const reference::Dropping& grown) {
  const auto before = reference::plus_totals(worth, lists, served.neighbours);
  const auto after = reference::plus_totals(worth, grown.lists, served.neighbours);
  return fmt::format(
      "dropped: over all transitions {} packets + of {} are left, of {} bytes {}; lists have {} triangles more, of an "
      "area of {:.6g}\n",
      after.packets, before.packets, before.bytes, after.bytes, grown.given_up,
      area_given_up(worth, lists, grown.lists));
}

}  // namespace

double area_given_up(const reference::AreaWorth& worth, const std::vector<std::vector<std::uint32_t>>& lists,
                     const std::vector<std::vector<std::uint32_t>>& grown) {
  double area = 0;
  for (std::size_t c = 0; c < lists.size(); ++c) {
    const auto more = worth.area_of(reference::packets_of(lists[c], grown[c]).plus);
    area += more ? CGAL::to_double(*more) : std::numeric_limits<double>::infinity();
  }
  return area;
}

void CellsChoice::add_to(CLI::App& command) {
  command.add_option("SCENE", scene, std::string("The scene: ") + scene::scene_formats)->required();
  auto* grid =
      command.add_option("--cells", cells, "The cells: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1; they are mapped now")
          ->type_name("SPEC");
  auto* baked = command.add_option("--bake", bake, "The cells and lists of `clues bake` of this scene")
                    ->type_name("FILE")
                    ->excludes(grid);
  command.add_option("--lists", lists, "The same in a file of `clues delta lists`")
      ->type_name("FILE")
      ->excludes(grid)
      ->excludes(baked);
}

void SendChoice::add_to(CLI::App& command) {
  command.add_option("--horizon", horizon, "Send what is seen from all cells within so many steps (default: 0)")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  command
      .add_option(
          "--hierarchy", levels,
          "Send, behind what the viewer waits for, what is seen from the node that the cell is in, of up to 2^N "
          "cells (default: 0)")
      ->type_name("N")
      ->check(CLI::Range(0, 16));
  command.add_flag("--contours", contours,
                   "With --horizon or --hierarchy: say as well what of all that the client holds each cell sees, as "
                   "contours");
  command
      .add_option("--drop", drop,
                  "Send no `+` of so many triangles or fewer: cells before get them, on all routes (default: 0)")
      ->type_name("N")
      ->check(problem_of_count);
  command
      .add_option("--drop-area", drop_area,
                  "Send no `+` that keeps less than this area away from the cell before for each of its bytes; on all "
                  "routes (default: 0)")
      ->type_name("AREA")
      ->check(number_between(0, 1e300));
}

ServedCells served_cells(const CellsChoice& choice) {
  if (choice.cells.empty() + choice.bake.empty() + choice.lists.empty() != 2)
    throw Error(ErrorCode::bad_argument, "give one of --cells, --bake and --lists");
  ServedCells served;
  if (choice.has_lists()) {
    served.scene = scene::read_scene(choice.scene);
  } else {
    served.scene.mesh = scene::read_plain_scene(choice.scene);
  }
  served.header.scene_sha256 = scene::sha256_of_scene(choice.scene);
  served.header.scene_triangles = served.scene.mesh.triangles.size();
  if (choice.has_lists()) {
    if (choice.lists.empty()) {
      add_cells_of_bake(choice, served);
    } else {
      add_cells_of_lists(choice, served);
    }
    std::vector<exact::ConvexCell> hulls;
    for (const auto& cell : served.cells) hulls.push_back(exact::ConvexCell::from_doubles(cell.points));
    served.neighbours = exact::touching_cells(hulls);
  } else {
    served.header.cells = choice.cells;
    served.cells = scene::parse_cells(choice.cells);
    served.neighbours = scene::neighbours_of(served.cells);
  }
  if (served.cells.empty()) throw Error(ErrorCode::bad_argument, choice.bake + choice.lists + ": has no cells");
  served.header.cell_count = served.cells.size();
  return served;
}

SentLists lists_of(const ServedCells& served, const reference::Options& options, const SendChoice& send,
                   const char* who) {
  std::vector<std::vector<std::uint32_t>> lists = served.lists;
  if (lists.empty()) {
    ProgressBar bar(who);
    for (const auto& cell : served.cells) {
      bar.show("cells", lists.size(), served.cells.size());
      lists.push_back(
          reference::first_order_visibility(served.scene.mesh, exact::ConvexCell::from_doubles(cell.points), options)
              .visible);
    }
  }
  if (!send.drops()) return {std::move(lists), {}};
  const reference::AreaWorth worth(served.scene.mesh);
  const exact::FT area_of_a_byte(send.drop_area);
  auto grown = reference::without_poor_packets(lists, served.neighbours, [&](const auto& plus) {
    return plus.size() <= send.drop || (send.drop_area > 0 && worth.is_poor(plus, area_of_a_byte));
  });
  return {grown.lists, words_of(worth, served, lists, grown)};
}

reference::StreamStore store_of(const ServedCells& served, std::vector<std::vector<std::uint32_t>> lists,
                                const SendChoice& send) {
  reference::CellTree tree;
  if (send.levels > 0) tree = reference::cell_tree(served.cells, static_cast<std::size_t>(send.levels));
  reference::StreamStore store(served.scene.mesh, std::move(lists), served.neighbours, send.horizon, std::move(tree));
  if (send.contours) store.add_contours();
  return store;
}

scene::StreamHeader header_of(const ServedCells& served, const MethodOptions& method,
                              const reference::StreamStore& store) {
  scene::StreamHeader header = served.header;
  if (served.lists.empty()) header.mode = method.mode;
  header.lists_sha256 = store.digest();
  return header;
}

}  // namespace clues::app
