// clues check: judges one PVS for one scene and cell (D19, basic form).
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/commands/check_cells.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/progress.h"
#include "app/whole_level.h"
#include "scene/cell_spec.h"
#include "scene/levels/bsp_scene.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "validate/certificates/chain_search.h"
#include "validate/see_through/judge_layers.h"
#include "validate/verdicts/judge.h"
#include "validate/verdicts/judge_report.h"
#include "validate/visible_set/settle.h"

namespace clues::app {
namespace {

struct CheckRequest {
  std::string scene, cell, pvs, bake;
  bool all_cells = false, sight_lines_only = false;
  std::optional<double> far_plane;
  JsonOutput json;
  MethodOptions method;
};

// Every triangle blocks and counts.
void judge_plain(validate::Judgement& judgement, validate::Surroundings& around, const scene::TriangleMesh& mesh,
                 const exact::ConvexCell& cell, const std::vector<std::uint32_t>& pvs,
                 const reference::Options& options, ProgressBar& bar) {
  const auto map = reference::first_order_visibility(mesh, cell, options);
  validate::JudgeOptions judge_options;
  judge_options.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show("witnesses", done, total); };
  judgement = validate::judge_pvs(mesh, map, pvs, judge_options);
  if (mesh.triangles.size() <= validate::kSettleTriangles) {
    bar.show("exact visible set", 0, 1);
    validate::settle(judgement, mesh, cell, options.mode);
  }
  judgement.chains = validate::find_chains(mesh, map, validate::undecided(judgement));
  around.first_order_fractions = validate::first_order_fractions(mesh, map);
}

struct SceneAndList {
  scene::FlaggedMesh scene;
  std::vector<std::uint32_t> pvs;   // ascending
  std::optional<WholeLevel> level;  // that scene
};

// A level is judged with all sides of its hulls, since to leave out what blocks would accuse lists of what only cracks
// and small holes show. The lists of `clues map` are of the scene without the covered sides; drawn triangles have the
// same ids in both, and no others count.
SceneAndList read_what_is_judged(const CheckRequest& request, const std::vector<scene::Point>& cell) {
  const auto list_for = [&](const scene::FlaggedMesh& scene) {
    return scene::read_pvs(
        request.pvs, {scene.mesh.triangles.size(), scene::sha256_of_scene(request.scene), request.method.mode, cell});
  };
  const auto level = scene::read_level(request.scene);
  if (!level) {
    auto scene = scene::read_scene(request.scene);
    auto pvs = list_for(scene);
    return {std::move(scene), std::move(pvs), std::nullopt};
  }
  const auto mapped = scene::scene_of_level(*level).scene;
  auto pvs = list_for(mapped);
  std::erase_if(pvs, [&](std::uint32_t t) { return !mapped.counting(t); });
  WholeLevel whole(*level);
  auto scene = whole.scene();
  return {std::move(scene), std::move(pvs), std::move(whole)};
}

// What is missing and was seen by a line that is longer than this is undecided: a shorter one may be free, or none. How many there were.
std::size_t leave_what_is_beyond(validate::Judgement& judgement, double far) {
  const exact::FT square = exact::FT(far) * exact::FT(far);
  return take_back(judgement, [&](const validate::Witness& witness) {
    return judgement.triangles[witness.triangle] == validate::TriangleVerdict::missing_visible &&
           CGAL::squared_distance(witness.v, witness.p) > square;
  });
}

// On standard error, where the verdict hangs on how far the list claims to hold what is seen.
void say_how_far(const CheckRequest& request, const validate::Judgement& judgement, std::size_t beyond,
                 double of_level) {
  std::string said;
  if (beyond > 0) {
    said =
        fmt::format("{} missing triangles are left undecided: the sight lines found are longer than {}, the far plane",
                    beyond, *request.far_plane);
  } else if (!request.far_plane && of_level > 0 && judgement.verdict == validate::Verdict::unsound) {
    said = fmt::format(
        "{} was compiled with a far plane of {}: where the list leaves out what is farther away, say "
        "--far-plane {}",
        request.scene, of_level, of_level);
  }
  if (!said.empty()) std::fputs(fmt::format("clues check: {}\n", said).c_str(), stderr);
}

int run_check(const CheckRequest& request) {
  if (request.all_cells) {
    if (!request.cell.empty() || !request.pvs.empty())
      throw scene::Error(scene::ErrorCode::bad_argument,
                         "--all-cells judges lists of many cells; leave out --cell and --pvs");
    if (request.method.mode == "solid" || request.method.formulation != "plain")
      throw scene::Error(scene::ErrorCode::unsupported, "--all-cells: leave out --mode and --formulation");
    return check_all_cells({request.scene, request.bake, request.method.threads, request.sight_lines_only,
                            request.far_plane, request.json});
  }
  if (request.sight_lines_only)
    throw scene::Error(scene::ErrorCode::bad_argument, "--sight-lines-only needs --all-cells");
  if (!request.bake.empty())
    throw scene::Error(scene::ErrorCode::bad_argument, "--bake names the lists of many cells; it needs --all-cells");
  if (request.cell.empty() || request.pvs.empty())
    throw scene::Error(scene::ErrorCode::bad_argument,
                       "give --cell and --pvs, or --all-cells (see `clues check --help`)");
  auto options = request.method.to_reference();
  require_writable_parent(request.json.file());
  require_apart({&request.json.file()}, {&request.scene, &request.cell, &request.pvs});
  const auto spec = scene::parse_cell(request.cell);
  require_far_plane(request.far_plane);
  const auto [scene, pvs, level] = read_what_is_judged(request, spec.points);
  const auto& mesh = scene.mesh;
  if (!scene.is_plain() && request.method.mode == "solid") {
    throw scene::Error(scene::ErrorCode::unsupported,
                       request.scene + ": some triangles do not block or do not count; leave out --mode solid");
  }
  const auto cell = exact::ConvexCell::from_doubles(spec.points);

  std::size_t beyond = 0;
  validate::Judgement judgement;
  validate::Surroundings around{request.scene, spec.points, {}, {}, {}};
  {
    ProgressBar bar("clues check");
    options.progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
      bar.show(stage, done, total);
    };
    if (!scene.is_plain()) {
      auto found = validate::judge_see_through(scene, cell, pvs, options);
      judgement = std::move(found.judgement);
      around.first_order_fractions = std::move(found.first_order_fractions);
    } else {
      judge_plain(judgement, around, mesh, cell, pvs, options, bar);
    }
    if (level) level->take_back(judgement);
    if (request.far_plane.value_or(0) > 0) beyond = leave_what_is_beyond(judgement, *request.far_plane);
    around.counts = validate::count_weights(judgement);
    around.areas = validate::area_weights(judgement, mesh);
  }
  if (request.json.asked()) request.json.write(validate::to_json_text(judgement, around));
  if (!request.json.on_stdout()) print(validate::to_text(judgement, around));
  say_how_far(request, judgement, beyond, level ? level->far_plane() : 0);
  if (!judgement.contradictions.empty()) return oracle_contradiction;
  switch (judgement.verdict) {
    case validate::Verdict::sound:
      return fine;
    case validate::Verdict::unsound:
      return findings;
    case validate::Verdict::undecided:
      return not_everything_ran;
  }
  return oracle_contradiction;
}

}  // namespace

void add_check_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("check", "Judge a potentially visible set: is a visible triangle missing?");
  auto request = std::make_shared<CheckRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cell", request->cell, "The view cell")->type_name("SPEC");
  command
      ->add_option("--pvs", request->pvs,
                   "The PVS: one triangle id a line with # comments, or a *.json result of clues")
      ->type_name("FILE");
  command->add_flag("--all-cells", request->all_cells,
                    "Judge the lists of all cells: those that a level was shipped with, or those of --bake");
  command->add_option("--bake", request->bake, "With --all-cells: a store of clues bake")->type_name("FILE.bake");
  command->add_flag("--sight-lines-only", request->sight_lines_only,
                    "With --all-cells: look for holes by sight lines alone: quick, but no list is proved");
  command
      ->add_option("--far-plane", request->far_plane,
                   "A list need not hold what is farther away. Default: what a level says of those that were shipped "
                   "with it, with --all-cells; else, and for 0, it must")
      ->type_name("DISTANCE");
  request->method.add_to(*command);
  request->json.add_to(*command, "The judgement");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  unsound    a visible triangle is missing. The proof is printed: a point of the cell and a point of the\n"
          "             triangle, as fractions, between which nothing lies.\n"
          "  sound      every missing triangle is proved to be hidden.\n"
          "  undecided  a missing triangle is visible to the first-order method, but no free sight line was found.\n"
          "             Scenes of up to 60 triangles are searched exhaustively: there nothing stays undecided.\n"
          "  Listed triangles are exact (visible, with proof), first-order (no sight line was found) or loose "
          "(hidden).\n"
          "  For a first-order triangle the proof that the method must list it is a chain of points, each on the free\n"
          "  continuation of a sight line through the one before; where one was found it is printed.\n"
          "  Qo and Qu are the over- and underestimate of Bittner et al. (2005): triangles (or area) listed and "
          "hidden, and\n"
          "  visible and missing, over visible ones; from the lowest to the highest value that the undecided "
          "allow.\n"
          "  A level is judged with all sides of its hulls (docs/real-levels.md), whatever scene the list was made "
          "in, and\n"
          "  what is seen only through brushes stays undecided.\n\n"
          "ALL CELLS\n"
          "  The fast kernel says what may be seen from each cell; what is missing of that is looked for by sight "
          "lines that "
          "are\n"
          "  decided exactly. A hole is one with a confirmed sight line from the inner cell of a leaf "
          "(docs/real-levels.md); "
          "what has\n"
          "  none is undecided. Lines are aimed at what the kernel calls hidden, too: one that arrives is exit code 4. "
          "A table, "
          "and\n"
          "  the longest sight lines; --json has all of them. With --sight-lines-only there is no kernel: what lines "
          "reach "
          "from\n"
          "  the cell is seen, what of that is not listed is confirmed as above, and where no hole was found nothing "
          "is "
          "proved.\n"
          "  A level may have been compiled with a far plane: its lists leave out what is farther away, on purpose. "
          "Sight lines\n"
          "  that are longer accuse nobody then; what only such lines reach is counted as beyond. The level says so "
          "itself\n"
          "  (_farplanedist), or --far-plane does. With --cell and --far-plane, what is seen by a longer line alone is "
          "undecided.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues check town.obj --cell box:0,0,1,2,2,2 --pvs baked.txt\n"
      "  clues check town.obj --cell box:0,0,1,2,2,2 --pvs town.clues.json --json\n"
      "  clues check town.obj --cell box:0,0,1,2,2,2 --pvs baked.txt --json judgement.json\n"
      "  clues check level.bsp --all-cells --json level.json\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,8,8,2 -o town.bake\n"
      "  clues check town.obj --all-cells --bake town.bake\n\n"
      "EXIT CODES\n"
      "  0 sound   1 unsound   2 bad usage or input   3 undecided or beyond, or not all cells were judged\n"
      "  4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_check(*request); });
}

}  // namespace clues::app
