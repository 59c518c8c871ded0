// clues maps: a hierarchy of a surface, with a map to its base domain that is proved one to one (D31 to D33).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/commands/maps_check.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/maps/maps_output.h"
#include "app/maps/remesh_output.h"
#include "app/progress.h"
#include "fastpath/multires/build.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/remesh.h"
#include "reference/multires/smoothing.h"
#include "reference/multires/stars/features.h"
#include "scene/files/atomic_file.h"
#include "scene/formats/number.h"
#include "scene/mesh/bounds.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/multires/attributes.h"
#include "scene/multires/feature_file.h"
#include "scene/multires/hierarchy_file.h"
#include "validate/multires/check_hierarchy.h"
#include "validate/multires/check_remesh.h"

namespace clues::app {
namespace {

struct MapsRequest {
  std::string mesh, features, out, patches, base_out, remesh, proof, checker, svg, kernel = "exact";
  std::uint64_t base = 200;
  std::optional<int> uniform;
  int smooth = 0;
  std::optional<double> adaptive;
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

double longest_side(const scene::TriangleMesh& mesh) {
  const auto [low, high] = scene::bounds_of(mesh.points);
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

// Squares of distances must neither overflow nor vanish: else there is no bound that an error could be reached by.
void require_measurable(const scene::TriangleMesh& mesh, const std::string& name) {
  double largest = 0;
  for (const auto& p : mesh.points) {
    for (const double x : p) largest = std::max(largest, std::abs(x));
  }
  const auto refuse = [&](const std::string& what) {
    throw scene::Error(scene::ErrorCode::unsupported, fmt::format("--adaptive: {}: {}", name, what));
  };
  if (!(largest < 0x1p500))
    refuse(fmt::format("a coordinate is as large as {}; errors are bounded for coordinates below 2^500", largest));
  if (const double side = longest_side(mesh); !(side > 0x1p-500))
    refuse(fmt::format("the longest side of the box is {}; errors are bounded for boxes above 2^-500", side));
}

// How far the two are apart, and what part of the box that is, where both are numbers.
std::string distances_text(const scene::RemeshProof& proof, double side) {
  if (!std::isfinite(proof.to_remesh) || !std::isfinite(proof.to_input))
    return "coordinates are too large for bounds of how far it and the input are apart";
  const auto text = [&](double distance) {
    const double percent = 100 * distance / side;
    return std::isfinite(percent) ? fmt::format("{:.4g} ({:.3g} % of the box)", distance, percent)
                                  : fmt::format("{:.4g}", distance);
  };
  return fmt::format("no point of the input is farther from it than {}, none of it farther from the input than {}",
                     text(proof.to_remesh), text(proof.to_input));
}

void check_remesh(const MapsRequest& request) {
  if (request.uniform && request.adaptive)
    throw scene::Error(scene::ErrorCode::bad_argument, "--uniform or --adaptive, not both");
  if ((request.remesh.empty() && request.checker.empty()) != (!request.uniform && !request.adaptive)) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       "--uniform L and --adaptive EPS say how --remesh FILE (or --checker FILE) is made: give one of "
                       "them, and the file");
  }
  if (request.smooth != 0 && !request.uniform)
    throw scene::Error(scene::ErrorCode::bad_argument, "--smooth is about remeshes of --uniform L, which is missing");
  if (request.smooth < 0 || request.smooth > 1000)
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--smooth {}: a number of rounds is from 0 to 1000", request.smooth));
  if (!request.proof.empty() && request.remesh.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "--proof is about a remesh: --remesh FILE is missing");
  }
  if (request.adaptive && !(*request.adaptive > 0 && *request.adaptive <= 100)) {
    throw scene::Error(
        scene::ErrorCode::bad_argument,
        fmt::format("--adaptive {}: percent of the longest side of the bounding box, above 0", *request.adaptive));
  }
  const int most = reference::RemeshOptions{}.most;
  if (request.uniform && (*request.uniform < 0 || *request.uniform > most)) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--uniform {}: a level is from 0 to {}", *request.uniform, most));
  }
  if (!request.remesh.empty()) require_remesh_format(request.remesh);
}

struct RemeshAnswer {
  std::string file, proof, checker, row;
  bool reached = true;
};
// What it did to angles.
std::string smooth(const MapsRequest& request, const scene::Hierarchy& hierarchy, bool single,
                   reference::Remesh& remesh) {
  ProgressBar bar("clues maps, smoothing");
  reference::SmoothingOptions options;
  options.rounds = request.smooth;
  options.single = single;
  options.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show("vertices", done, total); };
  const auto before = reference::neighbour_angles_estimate(remesh.mesh);
  const std::uint64_t moves = reference::smooth(remesh, hierarchy, options);
  const auto after = reference::neighbour_angles_estimate(remesh.mesh);
  return fmt::format(
      "smoothed: {} moves; angles between neighbouring triangles, in degrees: {:.1f} at most and {:.2f} in the mean, "
      "they were {:.1f} and {:.2f}\n",
      moves, after.largest, after.mean, before.largest, before.mean);
}

// Adds E7 to the report: what was made is judged before it is written.
RemeshAnswer remesh(const MapsRequest& request, const scene::Hierarchy& hierarchy,
                    const scene::MeshAttributes& attributes, validate::HierarchyReport& report) {
  const double side = longest_side(hierarchy.input);
  reference::RemeshOptions options;
  options.single = is_of_floats(request.remesh);
  if (request.uniform) options.level = *request.uniform;
  if (request.adaptive) options.error = *request.adaptive / 100 * side;
  ProgressBar bar("clues maps, remesh");
  options.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show("base triangles", done, total); };
  auto made = reference::remeshed(hierarchy, options);
  RemeshAnswer answer;
  if (request.smooth > 0) answer.row = smooth(request, hierarchy, options.single, made);
  const auto carried = reference::carried(made, hierarchy.input, attributes);
  if (!request.remesh.empty()) answer.file = remesh_to_file(made, carried.attributes, request.remesh);
  if (!request.checker.empty()) answer.checker = checker_to_ply(made, hierarchy.input);
  answer.proof = scene::to_text(made.proof);
  validate::check_remesh(hierarchy, made.mesh,
                         scene::parse_remesh_proof(answer.proof, "the proof of the remesh",
                                                   hierarchy.input.points.size(), hierarchy.input.triangles.size()),
                         options.single, report);
  answer.reached = made.reached;
  answer.row += fmt::format("remesh: {} vertices, {} triangles; {}\n", made.mesh.points.size(),
                            made.mesh.triangles.size(), distances_text(made.proof, side));
  if (carried.across_seams > 0) {
    answer.row += fmt::format(
        "{} triangles of the remesh lie across a seam of the texture; as --features FILE, seams stay edges\n",
        carried.across_seams);
  }
  if (!made.reached)
    answer.row +=
        "the error that was asked for was not reached: the map is too narrow in places for the grids, or for 4^8 parts "
        "of a base triangle\n";
  return answer;
}

// The same, whoever makes it.
scene::Hierarchy built(const MapsRequest& request, const scene::TriangleMesh& mesh,
                       reference::HierarchyOptions options) {
  ProgressBar bar("clues maps");
  options.progress = [&](std::uint64_t left) {
    bar.show("triangles taken away", mesh.triangles.size() - left, mesh.triangles.size());
  };
  if (request.kernel == "exact") return reference::build_hierarchy(mesh, options, request.mesh);
  fastpath::multires::BuildOptions fast;
  fast.base_triangles = options.base_triangles;
  fast.features = options.features;
  fast.fixed = options.fixed;
  fast.progress = options.progress;
  return fastpath::multires::build_hierarchy(mesh, fast, request.mesh);
}

int run_maps(const MapsRequest& request) {
  if (request.mesh.empty()) throw scene::Error(scene::ErrorCode::bad_argument, "MESH is required (or verify)");
  const std::vector<const std::string*> outputs{&request.out,     &request.patches,    &request.base_out,
                                                &request.remesh,  &request.proof,      &request.svg,
                                                &request.checker, &request.json.file()};
  for (const std::string* file : outputs) {
    if (!file->empty()) require_writable_parent(*file);
  }
  require_apart(outputs, {&request.mesh, &request.features});
  check_remesh(request);
  const auto mesh = scene::read_mesh(request.mesh);
  const auto census = reference::checked_surface(mesh, request.mesh);
  if (request.adaptive) require_measurable(mesh, request.mesh);
  if (is_of_floats(request.remesh)) require_floats(mesh);
  scene::MeshAttributes attributes;
  if (request.uniform || request.adaptive) attributes = scene::read_attributes(request.mesh, mesh);
  reference::HierarchyOptions options;
  options.base_triangles = request.base;
  add_features(request.features, mesh, options);
  const auto hierarchy = built(request, mesh, options);
  // What is written is what was judged: the text, read again.
  const std::string text = scene::to_text(hierarchy);
  auto report = validate::check_hierarchy(scene::parse_hierarchy(text, "the hierarchy"));
  RemeshAnswer answer;
  if (report.sound() && (request.uniform || request.adaptive)) answer = remesh(request, hierarchy, attributes, report);
  if (!report.sound()) {
    print(validate::to_text(report), stderr);
    return oracle_contradiction;
  }
  if (!request.out.empty()) scene::write_file_atomically(request.out, text);
  if (!request.remesh.empty()) scene::write_file_atomically(request.remesh, answer.file);
  if (!request.checker.empty()) scene::write_file_atomically(request.checker, answer.checker);
  if (!request.proof.empty()) scene::write_file_atomically(request.proof, answer.proof);
  if (!request.patches.empty()) scene::write_file_atomically(request.patches, patches_to_ply(hierarchy));
  if (!request.base_out.empty()) scene::write_file_atomically(request.base_out, base_to_off(hierarchy));
  if (!request.svg.empty()) scene::write_file_atomically(request.svg, base_to_svg(hierarchy));
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) {
    print(fmt::format("{} vertices, {} triangles, {} components, genus {}, {} boundaries\n", census.vertices,
                      census.triangles, census.components, census.genus(), census.boundaries) +
          validate::to_text(report) + answer.row);
    if (hierarchy.base.size() > request.base) {
      print(fmt::format("the base domain has more than {} triangles: no vertex that is left can be removed\n",
                        request.base));
    }
  }
  return answer.reached ? fine : not_everything_ran;
}

}  // namespace

void add_maps_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand(
      "maps", "Map a surface to a base domain of few triangles, proved one to one; judge such maps");
  auto request = std::make_shared<MapsRequest>();
  command->add_option("MESH", request->mesh, "A surface, closed or with boundary: OBJ, OFF, PLY or STL");
  command->add_option("--base", request->base, "End with the first level of at most N triangles (default: 200)")
      ->type_name("N")
      ->check([](const std::string& given) {  // else -1 would be read as the largest number that there is
        return given.find('-') == std::string::npos ? std::string() : "a number of triangles is 0 or more";
      });
  command
      ->add_option("--kernel", request->kernel,
                   "Made by the exact reference, or fast: with filtered doubles, by all threads; the same bytes")
      ->check(CLI::IsMember({"exact", "fast"}))
      ->capture_default_str();
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
  command->add_option("--svg", request->svg, "The base domain drawn in the same colours")->type_name("FILE");
  command
      ->add_option("--uniform", request->uniform, "Mesh the surface anew, every base triangle in 4^L (with --remesh)")
      ->type_name("L");
  command
      ->add_option("--adaptive", request->adaptive,
                   "Mesh it anew, as fine as an error asks for: percent of the longest side of its box (with --remesh)")
      ->type_name("EPS");
  command
      ->add_option(
          "--remesh", request->remesh,
          "Where that mesh goes: .ply, .obj, .off, .glb or .gltf, with the texture coordinates and colours of MESH")
      ->type_name("FILE");
  command
      ->add_option("--smooth", request->smooth,
                   "Move its vertices on the surface, N times each, so that they lie more evenly (with --uniform)")
      ->type_name("N");
  command
      ->add_option(
          "--checker", request->checker,
          "A checkerboard on the base domain, as the map draws it on the input (PLY; with --uniform or --adaptive)")
      ->type_name("FILE");
  command->add_option("--proof", request->proof, "Why that mesh is as near as is said, for clues maps verify --proof")
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
      "  it is written, by a program that recomputes all of it. --uniform and --adaptive mesh the surface anew over "
      "the base "
      "domain\n"
      "  and bound, with proof, how far the two are apart, both ways.\n\n"
      "EXAMPLES\n"
      "  clues maps ball.off --base 20 -o ball.maps --patches ball.ply\n"
      "  clues maps verify ball.maps\n"
      "  clues maps ball.off --base 20 --kernel fast -o ball.maps\n"
      "  clues maps ball.off --base 20 --features 40 --json ball.json\n"
      "  clues maps ball.off --base 20 --uniform 2 --remesh uniform.ply --proof uniform.proof\n"
      "  clues maps verify ball.maps --remesh uniform.ply --proof uniform.proof\n"
      "  clues maps ball.off --base 20 --uniform 3 --smooth 3 --remesh smooth.ply --checker checker.ply\n"
      "  clues maps ball.off --base 20 --adaptive 5 --remesh adaptive.glb\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input (no surface: the message says where)   3 --adaptive was not reached   4 an "
      "oracle "
      "contradicted itself");
  command->callback([request, command, &status] {
    if (command->get_subcommands().empty()) status = run_maps(*request);
  });
  add_maps_check(*command, status);
}

}  // namespace clues::app
