#include "app/stream/served_cells.h"

#include <utility>

#include "app/progress.h"
#include "exact/cell/touching.h"
#include "reference/delta/worth.h"
#include "reference/visibility/first_order.h"
#include "scene/bakes/bake_store.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/route.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

void add_cells_of_bake(const CellsChoice& choice, ServedCells& served) {
  const scene::FinishedBake bake(choice.bake);
  if (bake.plan().scene_sha256 != served.header.scene_sha256)
    throw Error(ErrorCode::bad_argument, choice.bake + ": is of another scene than " + choice.scene);
  served.header.cells = bake.plan().question;
  std::vector<exact::ConvexCell> hulls;
  for (std::uint32_t c = 0; c < bake.plan().cells.size(); ++c) {
    const auto& place = bake.plan().cells[c];
    served.cells.push_back({place.name, place.points});
    served.inner.push_back(place.inner.empty() ? place.points : place.inner);
    served.lists.push_back(bake.cell(c).list);
    hulls.push_back(exact::ConvexCell::from_doubles(place.points));
  }
  served.neighbours = exact::touching_cells(hulls);
}

}  // namespace

void CellsChoice::add_to(CLI::App& command) {
  command.add_option("SCENE", scene, std::string("The scene: ") + scene::scene_formats)->required();
  auto* grid =
      command.add_option("--cells", cells, "The cells: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1; they are mapped now")
          ->type_name("SPEC");
  command.add_option("--bake", bake, "The cells and lists of `clues bake` of this scene")
      ->type_name("FILE")
      ->excludes(grid);
}

ServedCells served_cells(const CellsChoice& choice) {
  if (choice.cells.empty() == choice.bake.empty())
    throw Error(ErrorCode::bad_argument, "give one of --cells and --bake");
  ServedCells served;
  if (choice.bake.empty()) {
    served.scene.mesh = scene::read_plain_scene(choice.scene);
  } else {
    served.scene = scene::read_scene(choice.scene);
  }
  served.header.scene_sha256 = scene::sha256_of_file(choice.scene);
  served.header.scene_triangles = served.scene.mesh.triangles.size();
  if (choice.bake.empty()) {
    served.header.cells = choice.cells;
    served.cells = scene::parse_cells(choice.cells);
    served.neighbours = scene::neighbours_of(served.cells);
  } else {
    add_cells_of_bake(choice, served);
  }
  if (served.cells.empty()) throw Error(ErrorCode::bad_argument, choice.bake + ": has no cells");
  served.header.cell_count = served.cells.size();
  return served;
}

std::vector<std::vector<std::uint32_t>> lists_of(const ServedCells& served, const reference::Options& options,
                                                 std::size_t drop, const char* who) {
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
  if (drop == 0) return lists;
  return reference::without_poor_packets(std::move(lists), served.neighbours,
                                         [drop](const auto& plus) { return plus.size() <= drop; })
      .lists;
}

scene::StreamHeader header_of(const ServedCells& served, const MethodOptions& method,
                              const reference::StreamStore& store) {
  scene::StreamHeader header = served.header;
  if (served.lists.empty()) header.mode = method.mode;
  header.lists_sha256 = store.digest();
  return header;
}

}  // namespace clues::app
