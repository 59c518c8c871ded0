// clues occluders: slices of the hidden space as virtual occluders (D27).
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/map/umbra_output.h"
#include "app/progress.h"
#include "app/stream/within_range.h"
#include "reference/delta/virtual_occluders.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/formats/number.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using reference::VirtualOccluder;
using scene::Error;
using scene::ErrorCode;

struct OccludersRequest {
  std::string scene, cell, bounds, out, with_scene, pvs;
  std::vector<std::string> planes;
  int threads = 0;
};

struct PlaneAcross {
  int axis = 2;
  double at = 0;
};

PlaneAcross plane_of(const std::string& text) {
  if (text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=') {
    const auto number = scene::parse_number(text.substr(2));
    if (number.kind == scene::NumberKind::finite) return {text[0] - 'x', number.value};
  }
  throw Error(ErrorCode::bad_argument, "--plane " + text + ": write x=NUMBER, y=NUMBER or z=NUMBER");
}

std::string name_of(const VirtualOccluder& o) { return fmt::format("{}={}", "xyz"[o.axis], o.at); }

json json_of(const VirtualOccluder& o) {
  json exact = json::array(), rounded = json::array(), triangles = json::array();
  for (const exact::Point3& p : o.exact.points) {
    exact.push_back({exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())});
    rounded.push_back(exact::to_double_estimate(p));
  }
  for (const auto& t : o.exact.triangles) triangles.push_back(t.corners);
  return {{"plane", name_of(o)},
          {"area_exact", exact::to_string_exact(o.area)},
          {"vertices_exact", std::move(exact)},
          {"vertices", std::move(rounded)},
          {"triangles", std::move(triangles)}};
}

std::string to_json_text(const std::vector<VirtualOccluder>& occluders, const OccludersRequest& request,
                         const scene::TriangleMesh& mesh, const scene::CellSpec& cell) {
  json slices = json::array();
  for (const auto& o : occluders) slices.push_back(json_of(o));
  const json out = {{"format", "clues-occluders/1"},
                    {"scene",
                     {{"file", fs::path(request.scene).filename().string()},
                      {"sha256", scene::sha256_of_scene(request.scene)},
                      {"triangles", mesh.triangles.size()}}},
                    {"cell", {{"vertices", cell.points}}},
                    {"slices", std::move(slices)}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

// The list of the scene's own triangles that are visible with the occluders in it.
std::vector<std::uint32_t> visible_with(const std::vector<VirtualOccluder>& occluders, const scene::TriangleMesh& mesh,
                                        const exact::ConvexCell& cell, const reference::Options& options) {
  auto visible = reference::first_order_visibility(reference::with_occluders(mesh, occluders), cell, options).visible;
  std::erase_if(visible, [&](std::uint32_t t) { return t >= mesh.triangles.size(); });
  return visible;
}

void check_outputs(const OccludersRequest& request) {
  const auto extension = fs::path(request.out).extension();
  if (!request.out.empty() && extension != ".json" && extension != ".off")
    throw Error(ErrorCode::bad_argument,
                request.out + ": occluders are written as *.off (rounded inwards) or *.json (exact)");
  if (!request.with_scene.empty() && fs::path(request.with_scene).extension() != ".off")
    throw Error(ErrorCode::bad_argument, request.with_scene + ": a scene with occluders is written as *.off");
  for (const std::string* file : {&request.out, &request.with_scene, &request.pvs}) require_writable_parent(*file);
  require_apart({&request.out, &request.with_scene, &request.pvs}, {&request.scene, &request.cell});
}

int run_occluders(const OccludersRequest& request) {
  std::vector<PlaneAcross> planes;
  for (const auto& text : request.planes) planes.push_back(plane_of(text));
  check_outputs(request);
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto spec = scene::parse_cell(request.cell);
  require_within_range(request.scene, mesh.points);
  require_within_range("--cell", spec.points);
  const auto cell = exact::ConvexCell::from_doubles(spec.points);
  std::vector<VirtualOccluder> occluders;
  std::optional<std::vector<std::uint32_t>> visible;
  {
    ProgressBar bar("clues occluders");
    reference::Options options;
    options.threads = request.threads;
    options.progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
      bar.show(stage, done, total);
    };
    const reference::Omega omega(mesh, cell, options);
    const auto umbra = checked_umbra(omega, mesh, request.bounds, request.threads);
    for (const PlaneAcross& plane : planes)
      occluders.push_back(reference::virtual_occluder(umbra, plane.axis, plane.at));
    if (!request.pvs.empty()) visible = visible_with(occluders, mesh, cell, options);
  }
  std::string table = "plane             area  rounded inwards  triangles  faces left out\n";
  std::uint64_t triangles = 0;
  for (const auto& o : occluders) {
    triangles += o.rounded.triangles.size();
    table += fmt::format("{:<10}  {:>10.6g}  {:>15.6g}  {:>9}  {:>14}\n", name_of(o), CGAL::to_double(o.area),
                         CGAL::to_double(o.rounded_area), o.rounded.triangles.size(), o.faces_left_out);
  }
  if (fs::path(request.out).extension() == ".json") {
    scene::write_file_atomically(request.out, to_json_text(occluders, request, mesh, spec));
  } else if (!request.out.empty()) {
    if (triangles == 0)
      throw Error(ErrorCode::bad_argument, "no plane meets the umbra; " + request.out + " would be empty");
    scene::write_file_atomically(request.out, scene::to_off_text(reference::with_occluders({}, occluders)));
  }
  if (!request.with_scene.empty())
    scene::write_file_atomically(request.with_scene, scene::to_off_text(reference::with_occluders(mesh, occluders)));
  if (visible) {
    scene::write_file_atomically(request.pvs, scene::to_pvs_text(*visible));
    table += fmt::format("visible with them: {} of {} triangles\n", visible->size(), mesh.triangles.size());
  }
  print(table);
  return fine;
}

}  // namespace

void add_occluders_command(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("occluders", "Cut the hidden space into planar occluders that stand for the scene");
  auto request = std::make_shared<OccludersRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cell", request->cell, "The view cell")->type_name("SPEC")->required();
  command->add_option("--plane", request->planes, "Where to cut: x=, y= or z= and a number; may be repeated")
      ->type_name("AXIS=X")
      ->required();
  command->add_option("--bounds", request->bounds, "The box that ends what is unbounded; it must hold the cell")
      ->type_name("box:...");
  command
      ->add_option("-o,--out", request->out,
                   "The occluders: *.off (rounded inwards, so that they hide nothing visible) or *.json (exact)")
      ->type_name("FILE");
  command->add_option("--with-scene", request->with_scene, "The scene with the occluders behind it; ids stay")
      ->type_name("FILE.off");
  command->add_option("--pvs", request->pvs, "The scene's triangles that are visible with the occluders in it")
      ->type_name("FILE");
  command->add_option("--threads", request->threads, "So many threads (default: as many as the machine has)")
      ->type_name("N")
      ->check(CLI::Range(0, 4096));
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  The part of a plane that lies in the umbra of the cell hides from it whatever is seen through that part "
          "only.\n"
          "  The umbra's certificate is checked first. Coordinates are rounded inwards, and each face is proved to lie "
          "in the\n"
          "  exact one; docs/delta.md says more.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues occluders town.obj --cell box:0,0,1,2,2,2 --plane z=5 -o town.occluders.off\n"
      "  clues occluders town.obj --cell box:0,0,1,2,2,2 --plane z=5 --plane x=1 --pvs with.pvs\n"
      "  clues check town.obj --cell box:0,0,1,2,2,2 --pvs with.pvs\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   3 the umbra is not closed where a limit was reached   4 an oracle "
      "contradicted\n"
      "  itself");
  command->callback([request, &status] { status = run_occluders(*request); });
}

}  // namespace clues::app
