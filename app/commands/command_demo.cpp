// clues demo: real meshes and a city block, mapped, checked and drawn.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/demo/demo_alone.h"
#include "app/demo/demo_picture.h"
#include "app/demo/demo_scene.h"
#include "app/demo/self_check.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/view/page_data.h"
#include "app/view/viewer_page.h"
#include "scene/files/atomic_file.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/messages/percent.h"
#include "scene/messages/shell_word.h"
#include "scene/result.h"
#include "validate/verdicts/judge_report.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;

struct DemoRequest {
  std::string out = "demo-out";
  std::string mesh_dir;
  bool quick = false;
  int threads = 0;
};

constexpr std::uint64_t demo_seed = 1;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_map(const reference::VisibilityMap& map, double seconds) {
  const auto census = take_census(map);
  const auto& s = map.statistics;
  fmt::print(
      "  {} triangles: {} wholly visible, {} partly visible, {} hidden ({} % of the area that faces the cell is "
      "seen)\n",
      map.complex.input_triangles, census.wholly, census.partly, census.hidden,
      scene::percent(census.area_visible_estimate, census.area_facing_estimate, 1));
  fmt::print(
      "  {} wedges (SV-ME {}, SE-ME {}, SE-MV {}), {} compound vertices, {} regions, {} conservative fallbacks; {:.1f} "
      "s\n",
      map.wedges.size(), s.sv_me, s.se_me, s.se_mv, s.csv, map.regions.size(), s.conservative_fallbacks, seconds);
}

void print_check(const SelfCheck& check, double seconds) {
  fmt::print("  checks: {} points of hidden regions against the whole cell: {} seen; {} sight lines to them: {} free\n",
             check.hidden_points, check.hidden_points_seen, check.sight_lines, check.sight_lines_free);
  fmt::print(
      "  checks: own PVS is {}: {} of {} triangles have a confirmed sight line; with one left out it is {}; {:.1f} s\n",
      validate::to_string(check.own.verdict), check.own.exact,
      check.own.exact + check.own.first_order + check.own.loose,
      check.loss_is_caught ? "unsound, as it must be" : "NOT CAUGHT", seconds);
}

bool show(const DemoScene& demo, const DemoRequest& request, PageData& view) {
  fmt::print("{}: {}\n", demo.name, demo.title);
  std::fflush(stdout);
  ProgressBar bar("clues demo " + demo.name);
  const auto progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
    bar.show(stage, done, total);
  };
  reference::Options options;
  options.threads = request.threads;
  options.progress = progress;
  auto start = std::chrono::steady_clock::now();
  const auto map = reference::first_order_visibility(demo.mesh, exact::ConvexCell::from_doubles(demo.cell), options);
  bar.clear();
  print_map(map, seconds_since(start));
  std::fflush(stdout);

  start = std::chrono::steady_clock::now();
  const auto check = check_map(demo.mesh, map, request.quick ? 40 : 200, demo_seed, progress);
  bar.clear();
  print_check(check, seconds_since(start));

  const auto stem = fs::path(request.out) / demo.name;
  const auto file = [&](const char* suffix) { return fs::path(stem.string() + suffix); };
  const std::string off = scene::to_off_text(demo.mesh);
  scene::write_file_atomically(file(".off"), off);
  scene::write_file_atomically(file(".pvs"), scene::to_pvs_text(map.visible));
  scene::write_file_atomically(file(".ply"), to_ply_text(map));
  scene::write_file_atomically(file(".svg"), to_svg_text(map, demo.title));
  print(fmt::format("  wrote {}.svg (from above), .ply (coloured fragments), .off (the scene), .pvs\n", stem.string()));
  print(fmt::format("  try: clues check {} --cell {} --pvs {}\n\n", scene::shell_word(file(".off").string()),
                    box_spec(demo.cell), scene::shell_word(file(".pvs").string())));
  std::fflush(stdout);

  auto result = reference::to_result(map, {box_spec(demo.cell), demo.cell}, true);
  result.scene_file = demo.name + ".off";
  result.scene_sha256 = scene::sha256_of(off);
  result.scene_triangles = demo.mesh.triangles.size();
  view.add_scene(result.scene_file, demo.mesh, result.scene_sha256);
  view.add_result(demo.name + ".clues.json", result);
  return check.passed();
}

// A build without Node has no page; the demo has its pictures all the same.
void write_view(const PageData& view, const fs::path& page) {
  if (!has_view_page()) {
    print(
        "no page to look around in: this program was built without Node.js and npm (`./run build` installs them; run "
        "the "
        "demo again)\n");
    return;
  }
  scene::write_file_atomically(page, view_page(view.text()));
  print(fmt::format(
      "To look around in both scenes: open {} in a browser (xdg-open {}).\n"
      "Blue is seen from the cell, hatched orange is hidden. \"Stand in the cell\" shows what the list draws, beside "
      "everything.\n",
      page.string(), scene::shell_word(page.string())));
}

int run_demo(const DemoRequest& request) {
  fs::path meshes = request.mesh_dir;
  if (const char* named = std::getenv("CLUES_MESH_DIR"); meshes.empty() && named != nullptr) meshes = named;
  if (meshes.empty()) meshes = "build/demo-meshes";
  if (request.threads < 0) throw scene::Error(scene::ErrorCode::bad_argument, "--threads: use 0 (all cores) or more");
  // Both scenes are made before anything is written, so that a missing mesh leaves nothing behind.
  const auto animals = animals_scene(meshes, request.quick ? 40 : 200);
  const auto city = city_scene(request.quick ? 150 : 300, demo_seed);
  make_folder(request.out);
  PageData view;
  const bool animals_passed = show(animals, request, view);
  const bool city_passed = show(city, request, view);
  write_view(view, fs::path(request.out) / "view.html");
  if (animals_passed && city_passed) return fine;
  fmt::print(stderr, "clues: error: the demo contradicted itself; please report this\n");
  return oracle_contradiction;
}

}  // namespace

void add_demo_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("demo", "Show what clues does, on real meshes and on a generated city block");
  auto request = std::make_shared<DemoRequest>();
  command->add_option("--out", request->out, "The folder for pictures and scenes (default: demo-out)")
      ->type_name("DIR");
  command
      ->add_option(
          "--mesh-dir", request->mesh_dir,
          "The folder with elephant.off, cow.off and bull.off (default: $CLUES_MESH_DIR, then build/demo-meshes)")
      ->type_name("DIR");
  command->add_flag("--quick", request->quick, "Smaller scenes and fewer checks");
  command->add_option("--threads", request->threads, "How many threads may work; 0: all cores (default)")
      ->type_name("N");
  command->footer(
      "DESCRIPTION\n"
      "  Maps a cell at the side of a street in two scenes: animals (real meshes of the Debian package libcgal-demo, "
      "simplified, on a ground\n"
      "  between walls) and city (generated). Prints how many triangles are wholly, partly or not seen, checks the "
      "maps in three\n"
      "  independent ways, and writes for each scene\n"
      "    NAME.svg  from above: green is seen, dark red is hidden, grey faces away, blue is the view cell\n"
      "    NAME.ply  the fragments in the same colours, for any 3D viewer\n"
      "    NAME.off  the scene, and NAME.pvs, the answer: to go on with `clues map` and `clues check`\n"
      "  and view.html, a page with both scenes to look around in, in a browser (`clues view`).\n\n"
      "EXAMPLES\n"
      "  ./run demo                                              # builds, extracts the meshes, runs this\n"
      "  clues demo --quick --out demo-out --mesh-dir meshes\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 a map contradicted a check");
  command->callback([request, &status] { status = run_demo(*request); });
}

int demo_alone(std::vector<std::string> options) {
  prepare_program();
  CLI::App program{"clues - what can be seen from a region of space, exactly.", "clues"};
  int status = fine;
  add_demo_command(program, status);
  options.insert(options.begin(), "demo");
  return run_program(program, status, std::move(options));
}

}  // namespace clues::app
