// clues maps verify: the judge of hierarchies, and of other programs' maps (E1 to E7).
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/commands/maps_check.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/maps/remesh_output.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy_file.h"
#include "scene/scenes/scene_io.h"
#include "validate/multires/check_hierarchy.h"
#include "validate/multires/check_plain_map.h"
#include "validate/multires/check_remesh.h"

namespace clues::app {
namespace {

struct MapsVerifyRequest {
  std::string file, input, base, remesh, proof;
  JsonOutput json;
};

int verify_plain(const MapsVerifyRequest& request) {
  const auto report = validate::check_plain_map(scene::read_mesh(request.input), scene::read_mesh(request.base),
                                                scene::read_plain_map(request.file), request.file);
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) print(validate::to_text(report));
  switch (report.verdict) {
    case validate::PlainVerdict::proved:
      return fine;
    case validate::PlainVerdict::refuted:
      return findings;
    case validate::PlainVerdict::undecided:
      break;
  }
  return not_everything_ran;
}

int run_maps_verify(const MapsVerifyRequest& request) {
  if (!request.json.file().empty()) require_writable_parent(request.json.file());
  require_apart({&request.json.file()},
                {&request.file, &request.input, &request.base, &request.remesh, &request.proof});
  if (request.input.empty() != request.base.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "--input and --base go together: a plain map needs both meshes");
  }
  if (request.remesh.empty() != request.proof.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "--remesh and --proof go together: a mesh, and why it is near");
  }
  if (!request.input.empty() && !request.remesh.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "--remesh is judged beside a hierarchy, not a plain map");
  }
  if (!request.input.empty()) return verify_plain(request);
  const auto hierarchy = scene::read_hierarchy(request.file);
  auto report = validate::check_hierarchy(hierarchy);
  if (!request.remesh.empty()) {
    const auto proof =
        scene::read_remesh_proof(request.proof, hierarchy.input.points.size(), hierarchy.input.triangles.size());
    validate::check_remesh(hierarchy, scene::read_scene(request.remesh).mesh, proof, is_of_floats(request.remesh),
                           report);
  }
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) print(validate::to_text(report));
  return report.sound() ? fine : findings;
}

}  // namespace

void add_maps_check(CLI::App& maps, int& status) {
  auto* command = maps.add_subcommand("verify", "Judge a hierarchy of clues maps, or any program's map");
  auto request = std::make_shared<MapsVerifyRequest>();
  command->add_option("FILE", request->file, "A hierarchy (clues maps -o), or with --input and --base a plain map")
      ->required();
  command->add_option("--input", request->input, "The mesh that is mapped")->type_name("MESH");
  command->add_option("--base", request->base, "The mesh that it is mapped to")->type_name("MESH");
  command->add_option("--remesh", request->remesh, "A mesh of clues maps --remesh, to judge beside its hierarchy")
      ->type_name("MESH");
  command->add_option("--proof", request->proof, "What clues maps --proof wrote beside it")->type_name("FILE");
  request->json.add_to(*command, "The verdict");
  command->footer(
      "DESCRIPTION\n"
      "  Of a hierarchy everything is recomputed from the file: that every level is a surface, that what was removed "
      "is "
      "independent,\n"
      "  that every flattened star is embedded, where every vertex goes, and that the pieces of the overlay are "
      "positive and "
      "fill\n"
      "  every triangle. A plain map has a line for each vertex of the input: the number of a base triangle, from 0, "
      "and two or "
      "three\n"
      "  coordinates in it (decimal, hex or p/q). Its triangles over several base triangles stay undecided. Of a "
      "remesh "
      "it is\n"
      "  judged that it covers the base domain and the input once, and that the two are as near as the proof says.\n\n"
      "EXAMPLES\n"
      "  clues maps verify ball.maps\n"
      "  clues maps verify ball.maps --remesh uniform.ply --proof uniform.proof\n"
      "  clues maps verify plain.txt --input octahedron.off --base octahedron.off\n\n"
      "EXIT CODES\n"
      "  0 verified   1 something is wrong   2 bad usage or input   3 a plain map that is neither proved nor refuted");
  command->callback([request, &status] { status = run_maps_verify(*request); });
}

}  // namespace clues::app
