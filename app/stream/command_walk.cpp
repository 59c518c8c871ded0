// clues walk: what a server sends to a viewer on a route through cells (D25).
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "reference/delta/stream_server.h"
#include "reference/visibility/first_order.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/route.h"
#include "scene/stream/stream_file.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct WalkRequest {
  std::string scene, cells, route, out;
  std::uint64_t steps = 0, seed = 1;
  int horizon = 0;
  MethodOptions method;
};

struct WalkFigures {
  std::uint64_t entered = 0, packets = 0, sent = 0, taken = 0, bytes = 0;
  std::uint64_t whole_lists = 0, whole_bytes = 0;  // had each cell's list been sent as a whole
};

int run_walk(const WalkRequest& request) {
  const auto options = request.method.to_reference();
  if (request.route.empty() == (request.steps == 0))
    throw Error(ErrorCode::bad_argument, "give one of --route and --steps (see `clues walk --help`)");
  require_writable_parent(request.out);
  require_apart({&request.out}, {&request.scene, &request.route, &request.cells});
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto cells = scene::parse_cells(request.cells);
  const auto neighbours = scene::neighbours_of(cells);
  const auto route = request.route.empty() ? scene::random_route(neighbours, request.steps, request.seed)
                                           : scene::read_route(request.route, cells.size());
  for (std::size_t i = 1; i < route.size(); ++i) {
    if (!scene::may_follow(cells[route[i - 1]].points, cells[route[i]].points))
      throw Error(ErrorCode::bad_argument, fmt::format("{}: step {}: cell {} has no whole face in common with cell {}",
                                                       request.route, i, route[i], route[i - 1]));
  }
  std::vector<std::vector<std::uint32_t>> lists;
  {
    ProgressBar bar("clues walk");
    for (const auto& cell : cells) {
      bar.show("cells", lists.size(), cells.size());
      lists.push_back(
          reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell.points), options).visible);
    }
  }
  reference::StreamServer server(mesh, lists, neighbours, request.horizon);
  std::string text = scene::to_line(
      scene::StreamHeader{scene::sha256_of_file(request.scene), request.cells, mesh.triangles.size(), cells.size()});
  WalkFigures figures;
  for (const std::uint32_t cell : route) {
    ++figures.entered;
    for (const auto& message : server.enter(cell)) {
      const std::string line = scene::to_line(message);
      ++figures.packets;
      figures.sent += message.plus.size();
      figures.taken += message.minus.size();
      figures.bytes += line.size();
      text += line;
    }
    figures.whole_lists += lists[cell].size();
    figures.whole_bytes += scene::to_line(reference::DisplayList(mesh).plus(lists[cell])).size();
  }
  if (!request.out.empty()) scene::write_file_atomically(request.out, text);
  print(
      fmt::format("cells entered  messages  triangles sent  taken away      bytes  whole lists: triangles      bytes\n"
                  "{:>13}  {:>8}  {:>14}  {:>10}  {:>9}  {:>22}  {:>9}\n",
                  figures.entered, figures.packets, figures.sent, figures.taken, figures.bytes, figures.whole_lists,
                  figures.whole_bytes));
  return fine;
}

}  // namespace

void add_walk_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("walk", "What a server sends to a viewer who goes from cell to cell");
  auto request = std::make_shared<WalkRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cells", request->cells, "The cells: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1")
      ->type_name("SPEC")
      ->required();
  command->add_option("--route", request->route, "Numbers of cells (x fastest), one after the other")
      ->type_name("FILE");
  command->add_option("--steps", request->steps, "Without --route: so many steps at random, from cell 0 on")
      ->type_name("N");
  command->add_option("--seed", request->seed, "Of the random steps (default: 1)")->type_name("N");
  command
      ->add_option("--horizon", request->horizon, "Send what is seen from all cells within so many steps (default: 0)")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  request->method.add_to(*command);
  command->add_option("-o,--out", request->out, "The messages, a line each (docs/delta.md)")->type_name("FILE");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Maps all cells, and writes down the messages of a server: what becomes visible is sent before the "
          "viewer enters\n"
          "  a cell, what is not visible any more is taken away afterwards. `clues conform --stream` judges such "
          "files,\n"
          "  whoever made them.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues walk town.obj --cells grid:2x2x1:box:0,0,1,4,4,2 --steps 10 -o walk.stream.jsonl\n"
      "  clues conform --stream walk.stream.jsonl --scene town.obj --cells grid:2x2x1:box:0,0,1,4,4,2\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_walk(*request); });
}

}  // namespace clues::app
