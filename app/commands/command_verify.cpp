// clues verify: is an umbra what it claims to be? (T2, D18)
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "exact/complex/complex.h"
#include "scene/cell_spec.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"
#include "validate/certificates/umbra_certificate.h"
#include "validate/certificates/umbra_file.h"

namespace clues::app {
namespace {

struct VerifyRequest {
  std::string scene, cell, umbra;
  bool solid = false, list = false;
};

int run_verify(const VerifyRequest& request) {
  const auto scene = scene::read_scene(request.scene);
  const auto& mesh = scene.mesh;
  if (request.solid && !scene.is_plain())
    throw scene::Error(scene::ErrorCode::unsupported,
                       request.scene + ": some triangles do not block or do not count; leave out --solid");
  const auto cell = exact::ConvexCell::from_doubles(scene::parse_cell(request.cell).points);
  if (request.solid) exact::require_solid(exact::build_complex(mesh, &cell));  // D4
  const auto facets = validate::read_umbra(request.umbra, mesh.triangles.size()).facets;
  const auto verdict = validate::check_umbra_certificate(scene, cell, facets);
  if (!verdict.valid) {
    std::fputs(fmt::format("not an umbra: {}\n", verdict.reason).c_str(), stdout);
    return findings;
  }
  std::vector<std::uint32_t> hidden;
  std::size_t asked = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!scene.counting(t)) continue;
    ++asked;
    if (validate::proves_hidden(mesh, cell, facets, t, true) &&
        (request.solid || validate::proves_hidden(mesh, cell, facets, t, false)))
      hidden.push_back(t);
  }
  std::string text = fmt::format("umbra: {} facets, volume {:.6g}: nothing in it can be seen from the cell\n",
                                 facets.size(), validate::enclosed_volume(facets).get_d());
  text += fmt::format("hidden triangles: {} of {}\n", hidden.size(), asked);
  if (request.list) {
    for (const auto t : hidden) text += fmt::format("{}\n", t);
  }
  std::fputs(text.c_str(), stdout);
  return fine;
}

}  // namespace

void add_verify_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("verify", "Verify an umbra: can really nothing in it be seen from the cell?");
  auto request = std::make_shared<VerifyRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cell", request->cell, "The view cell")->type_name("SPEC")->required();
  command->add_option("--umbra", request->umbra, "The umbra: JSON as `clues map --umbra` writes it")
      ->type_name("FILE")
      ->required();
  command->add_flag(
      "--solid", request->solid,
      "Ask for the fronts of triangles only, as in solid mode; the mesh must be closed and consistently oriented");
  command->add_flag("--list", request->list, "List the triangles that the umbra proves hidden");
  command->footer(
      std::string("DESCRIPTION\n"
                  "  Reads a list of triangles that claims to be the surface of a space that nothing of the cell can "
                  "see. Checks, in\n"
                  "  exact arithmetic and without any of the code that computes maps: each lies in a surface of the "
                  "scene, or has the\n"
                  "  cell on the inner side of its plane; together they are closed; the cell is outside. Then says how "
                  "many triangles\n"
                  "  of the scene this proves hidden. A surface has to be one that blocks (docs/real-levels.md).\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --umbra town.umbra.json\n"
      "  clues verify town.obj --cell box:0,0,1,2,2,2 --umbra town.umbra.json\n\n"
      "EXIT CODES\n"
      "  0 it is an umbra   1 it is not; one line says why   2 bad usage or input");
  command->callback([request, &status] { status = run_verify(*request); });
}

}  // namespace clues::app
