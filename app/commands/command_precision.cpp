// clues precision: how far the map may be from the truth, and what refinement makes of it.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "validate/verdicts/precision.h"

namespace clues::app {
namespace {

struct PrecisionRequest {
  std::string scene, cell, out, svg;
  JsonOutput json;
  MethodOptions method;
  RefineChoice refine;
};

int run_precision(const PrecisionRequest& request) {
  const auto options = request.method.to_reference();
  const auto refinement = request.refine.refinement(validate::Refinement::cells);
  const auto refine = request.refine.to_reference();
  request.refine.check_retract(refinement);
  for (const std::string* path : {&request.out, &request.json.file(), &request.svg}) require_writable_parent(*path);
  require_apart({&request.out, &request.json.file(), &request.svg}, {&request.scene, &request.cell});
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto cell = exact::ConvexCell::from_doubles(scene::parse_cell(request.cell).points);
  reference::Bounds bounds(mesh, cell, options);
  const auto report = validate::refine(bounds, refinement, refine);
  const std::string text = validate::to_json_text(report, std::filesystem::path(request.scene).filename().string(),
                                                  scene::sha256_of_scene(request.scene));
  if (!request.out.empty()) scene::write_file_atomically(request.out, text);
  if (!request.svg.empty()) scene::write_file_atomically(request.svg, validate::to_svg(report));
  request.json.write(text);
  if (!request.json.on_stdout()) std::fputs(validate::to_table(report).c_str(), stdout);
  return fine;
}

}  // namespace

void add_precision_command(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("precision", "Say how far from exact the map of a cell is, and what refinement gains");
  auto request = std::make_shared<PrecisionRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cell", request->cell, "The view cell")->type_name("SPEC")->required();
  request->method.add_to(*command);
  request->refine.add_to(*command);
  request->json.add_to(*command, "The report");
  command->add_option("-o,--out", request->out, "The JSON report goes into this file too")->type_name("FILE");
  command->add_option("--svg", request->svg, "Draw the excess area against the depth")->type_name("FILE");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Two exact bounds enclose what is visible: what single points of the cell see is certainly visible\n"
          "  (witnessed), and what is outside the refined map is certainly hidden. The excess is the area between "
          "them.\n"
          "  It shrinks with the depth, from both sides. Default: --refine cell.\n"
          "  The work is that of many maps; start with small scenes and small depths.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues precision room.obj --cell box:0,0,1,2,2,2 --max-depth 3\n"
      "  clues precision room.obj --cell box:0,0,1,2,2,2 --refine both --json --svg excess.svg\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_precision(*request); });
}

}  // namespace clues::app
