// clues serve: a server of streams (D25) on standard input and output.
#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "reference/delta/stream_server.h"
#include "reference/visibility/first_order.h"
#include "scene/cell_spec.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/route.h"
#include "scene/stream/stream_file.h"

namespace clues::app {
namespace {

struct ServeRequest {
  std::string scene, cells;
  int horizon = 0;
  MethodOptions method;
};

void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

int run_serve(const ServeRequest& request) {
  const auto options = request.method.to_reference();
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto cells = scene::parse_cells(request.cells);
  const auto neighbours = scene::neighbours_of(cells);
  std::vector<std::vector<std::uint32_t>> lists;
  {
    ProgressBar bar("clues serve");
    for (const auto& cell : cells) {
      bar.show("cells", lists.size(), cells.size());
      lists.push_back(
          reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell.points), options).visible);
    }
  }
  reference::StreamServer server(mesh, lists, neighbours, request.horizon);
  say(scene::to_line(
      scene::StreamHeader{scene::sha256_of_file(request.scene), request.cells, mesh.triangles.size(), cells.size()}));
  std::string line;
  for (std::uint64_t number = 1; std::getline(std::cin, line); ++number) {
    const auto asked = scene::parse_stream_request(line, fmt::format("standard input:{}", number), cells.size());
    std::string answer;
    for (const auto& message : asked.resumes ? server.resume(asked.route, asked.have) : server.enter(asked.cell))
      answer += scene::to_line(message);
    say(answer + scene::stream_end_line(server.messages()));
  }
  return fine;
}

}  // namespace

void add_serve_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("serve", "Send a client what becomes visible, cell by cell, over a pipe");
  auto request = std::make_shared<ServeRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cells", request->cells, "The cells: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1")
      ->type_name("SPEC")
      ->required();
  command
      ->add_option("--horizon", request->horizon, "Send what is seen from all cells within so many steps (default: 0)")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  request->method.add_to(*command);
  command->footer(
      std::string("DESCRIPTION\n"
                  "  Maps all cells, prints a header, and answers each line of standard input, {\"enter\": N} or "
                  "{\"resume\": {...}},\n"
                  "  with the messages of that step (docs/delta.md). `clues conform --stream-server` puts routes to "
                  "such programs.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues conform --stream-server 'clues serve town.obj --cells grid:2x2x1:box:0,0,1,4,4,2' --scene town.obj "
      "--cells grid:2x2x1:box:0,0,1,4,4,2\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input, or a line that is no request   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_serve(*request); });
}

}  // namespace clues::app
