// clues maps: a hierarchy of a surface, with a map to its base domain that is proved one to one (D31 to D33).
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>

#include "app/commands.h"
#include "app/commands/maps_check.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/maps/maps_output.h"
#include "app/progress.h"
#include "reference/multires/features.h"
#include "reference/multires/hierarchy.h"
#include "scene/files/atomic_file.h"
#include "scene/formats/number.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/multires/feature_file.h"
#include "scene/multires/hierarchy_file.h"
#include "validate/multires/check_hierarchy.h"

namespace clues::app {
namespace {

struct MapsRequest {
  std::string mesh, features, out, patches, base_out;
  std::uint64_t base = 200;
  JsonOutput json;
};

// --features: a number is an angle in degrees, anything else a file.
void add_features(const std::string& given, const scene::TriangleMesh& mesh, reference::HierarchyOptions& options) {
  if (given.empty()) return;
  const auto number = scene::parse_number(given);
  if (number.kind == scene::NumberKind::not_a_number) {
    const auto read = scene::read_features(given);
    options.features = read.edges;
    options.fixed = read.vertices;
    return;
  }
  if (number.kind != scene::NumberKind::finite || number.value < 0 || number.value > 180) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--features {}: an angle is from 0 to 180 degrees", given));
  }
  options.features = reference::sharp_edges(mesh, std::cos(number.value * std::numbers::pi / 180));
}

int run_maps(const MapsRequest& request) {
  if (request.mesh.empty()) throw scene::Error(scene::ErrorCode::bad_argument, "MESH is required (or verify)");
  const std::vector<const std::string*> outputs{&request.out, &request.patches, &request.base_out,
                                                &request.json.file()};
  for (const std::string* file : outputs) {
    if (!file->empty()) require_writable_parent(*file);
  }
  require_apart(outputs, {&request.mesh, &request.features});
  const auto mesh = scene::read_mesh(request.mesh);
  const auto census = reference::checked_surface(mesh, request.mesh);
  reference::HierarchyOptions options;
  options.base_triangles = request.base;
  add_features(request.features, mesh, options);
  scene::Hierarchy hierarchy;
  {
    ProgressBar bar("clues maps");
    options.progress = [&](std::uint64_t left) {
      bar.show("triangles taken away", mesh.triangles.size() - left, mesh.triangles.size());
    };
    hierarchy = reference::build_hierarchy(mesh, options, request.mesh);
  }
  // What is written is what was judged: the text, read again.
  const std::string text = scene::to_text(hierarchy);
  const auto report = validate::check_hierarchy(scene::parse_hierarchy(text, "the hierarchy"));
  if (!report.sound()) {
    print(validate::to_text(report), stderr);
    return oracle_contradiction;
  }
  if (!request.out.empty()) scene::write_file_atomically(request.out, text);
  if (!request.patches.empty()) scene::write_file_atomically(request.patches, patches_to_ply(hierarchy));
  if (!request.base_out.empty()) scene::write_file_atomically(request.base_out, base_to_off(hierarchy));
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) {
    print(fmt::format("{} vertices, {} triangles, {} components, genus {}, {} boundaries\n", census.vertices,
                      census.triangles, census.components, census.genus(), census.boundaries) +
          validate::to_text(report));
    if (hierarchy.base.size() > request.base) {
      print(fmt::format("the base domain has more than {} triangles: no vertex that is left can be removed\n",
                        request.base));
    }
  }
  return fine;
}

}  // namespace

void add_maps_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand(
      "maps", "Map a surface to a base domain of few triangles, proved one to one; judge such maps");
  auto request = std::make_shared<MapsRequest>();
  command->add_option("MESH", request->mesh, "A surface, closed or with boundary: OBJ, OFF, PLY or STL");
  command->add_option("--base", request->base, "End with the first level of at most N triangles (default: 200)")
      ->type_name("N");
  command
      ->add_option("--features", request->features,
                   "Edges that stay edges: sharper than an angle in degrees, or those of a FILE (docs/maps.md)")
      ->type_name("ANGLE|FILE");
  command->add_option("-o,--out", request->out, "The hierarchy with its map, for clues maps verify")->type_name("FILE");
  command->add_option("--base-out", request->base_out, "The base domain (OFF)")->type_name("FILE");
  command
      ->add_option("--patches", request->patches,
                   "The input, cut along the base domain, a colour for each base triangle (PLY)")
      ->type_name("FILE");
  request->json.add_to(*command, "The table of the levels");
  command->footer(
      "DESCRIPTION\n"
      "  Takes away vertices level by level, each time as many as are independent, and closes the holes; what is left "
      "is the "
      "base\n"
      "  domain. Every point of the surface gets a place on it. The map is written down as a common triangulation of "
      "both, of\n"
      "  which every piece is turned right on both sides, in whole numbers: that proves that it is one to one. It is "
      "judged "
      "before\n"
      "  it is written, by a program that recomputes all of it.\n\n"
      "EXAMPLES\n"
      "  clues maps ball.off --base 20 -o ball.maps --patches ball.ply\n"
      "  clues maps verify ball.maps\n"
      "  clues maps ball.off --base 20 --features 40 --json ball.json\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input (no surface: the message says where)   4 an oracle contradicted itself");
  command->callback([request, command, &status] {
    if (command->get_subcommands().empty()) status = run_maps(*request);
  });
  add_maps_check(*command, status);
}

}  // namespace clues::app
