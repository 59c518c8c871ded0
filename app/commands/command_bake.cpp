// clues bake: the lists of all cells of a scene, in one store.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/bake/bake_cells.h"
#include "app/bake/bake_export.h"
#include "app/bake/bake_ranks.h"
#include "app/cluster/cluster.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/interrupt.h"
#include "app/json_output.h"
#include "app/progress.h"
#include "app/shard.h"
#include "exact/threads.h"
#include "fastpath/bakes/baker.h"
#include "fastpath/bakes/cell_groups.h"
#include "fastpath/solids/find_solids.h"
#include "scene/bakes/bake_store.h"
#include "scene/levels/bsp_scene.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "validate/see_through/exact_lister.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

// In levels less is lost where a map is given up: what solids do not hide is listed.
constexpr std::uint64_t kEffort = 500, kEffortInLevels = 50;
// Of solids that are found in a scene. With more of them sections take longer than maps (10,000 boxes: 7 s for a cell, and 1.3 GB).
constexpr std::size_t kMostSolidsForMaps = 4096;
constexpr int kTries = 7;  // what these kernels do: raised when that changes, so that no store has lists of two kinds

struct BakeRequest {
  std::string scene, cells, out, kernel = "fast", up, exported;
  std::size_t group = 1;
  std::optional<std::uint64_t> effort;  // of the fast kernel; none: as the scene is
  std::vector<std::string> merged;
  std::string shard;
  int threads = 0;
  JsonOutput json;
};

char up_of(const BakeRequest& request) {
  if (!request.up.empty()) return request.up[0];
  const auto extension = scene::lower_case_extension(request.scene);
  return extension == ".gltf" || extension == ".glb" ? 'y' : 'z';
}

// Everything that the lists depend on, but for the scene.
std::string question_of(const BakeRequest& request, const BakeCells& cells, std::uint64_t effort) {
  nlohmann::json question{{"cells", request.cells},
                          {"cells_sha256", cells.bytes.empty() ? "" : scene::sha256_of(cells.bytes)},
                          {"kernel", request.kernel},
                          {"group", request.group},
                          {"up", std::string(1, up_of(request))}};
  if (request.kernel == "fast") question["effort"] = effort;
  if (request.kernel != "exact") question["tries"] = kTries;
  return question.dump();
}

scene::BakePlan plan_of(const BakeRequest& request, const std::string& sha256, const scene::FlaggedMesh& scene,
                        BakeCells cells, std::uint64_t effort) {
  scene::BakePlan plan;
  plan.scene_file = fs::path(request.scene).filename().string();
  plan.scene_sha256 = sha256;
  plan.triangles = static_cast<std::uint32_t>(scene.mesh.triangles.size());
  plan.question = question_of(request, cells, effort);
  plan.note = std::move(cells.note);
  plan.cells = std::move(cells.cells);
  fastpath::bakes::add_groups(plan, request.group);
  return plan;
}

// Of a map with more fallbacks much was given up.
constexpr std::uint64_t kLoose = 200;

struct Summary {
  std::uint64_t cells = 0, least = 0, most = 0, all = 0, fallbacks = 0, mapped = 0, counting = 0;
  std::uint64_t tight = 0, loose = 0;  // cells without a fallback, and with more than kLoose
  std::uint64_t most_fallbacks = 0;    // of a cell
  std::string loosest;                 // its name
  double average() const { return static_cast<double>(all) / static_cast<double>(cells); }
};

Summary summary_of(const scene::FinishedBake& bake, const scene::FlaggedMesh& scene) {
  Summary s;
  for (std::uint32_t i = 0; i < bake.plan().cells.size(); ++i) {
    const auto cell = bake.cell(i);
    s.least = i == 0 ? cell.list.size() : std::min<std::uint64_t>(s.least, cell.list.size());
    s.most = std::max<std::uint64_t>(s.most, cell.list.size());
    s.all += cell.list.size();
    s.mapped += static_cast<std::uint64_t>(cell.mapped);
    const auto fallbacks = static_cast<std::uint64_t>(cell.fallbacks);
    s.fallbacks += fallbacks;
    s.tight += fallbacks == 0 ? 1 : 0;
    s.loose += fallbacks > kLoose ? 1 : 0;
    if (fallbacks <= s.most_fallbacks) continue;
    s.most_fallbacks = fallbacks;
    s.loosest = bake.plan().cells[i].name;
  }
  s.cells = bake.plan().cells.size();
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) s.counting += scene.counting(t) ? 1 : 0;
  return s;
}

void report(const BakeRequest& request, const Summary& s, const std::string& note) {
  if (request.json.asked()) {
    const nlohmann::json json{{"format", "clues-bake-summary/1"},
                              {"bake", request.out},
                              {"cells", s.cells},
                              {"counting_triangles", s.counting},
                              {"listed_average", s.average()},
                              {"listed_least", s.least},
                              {"listed_most", s.most},
                              {"fallbacks", s.fallbacks},
                              {"tight", s.tight},
                              {"loose", s.loose},
                              {"mapped", s.mapped},
                              {"bytes", fs::file_size(request.out)},
                              {"note", note}};
    request.json.write(json.dump(2) + "\n");
  }
  if (request.json.on_stdout()) return;
  print(
      fmt::format("{:>7}  {:>9}  {:>8}  {:>7}  {:>7}  {:>9}  {:>9}\n"
                  "{:>7}  {:>9}  {:>8.1f}  {:>7}  {:>7}  {:>9}  {:>9}\n{}\n",
                  "cells", "triangles", "listed", "least", "most", "fallbacks", "bytes", s.cells, s.counting,
                  s.average(), s.least, s.most, s.fallbacks, fs::file_size(request.out), note));
  if (s.tight == s.cells) return;
  print(fmt::format("{} of {} lists without a fallback; {} with more than {}; most are in cell {}: {}\n", s.tight,
                    s.cells, s.loose, kLoose, s.loosest, s.most_fallbacks));
}

// What could only be found when hours are over, or with a store begun that nobody can use.
void require_unspoilt(const BakeRequest& request) {
  if (request.effort && request.kernel != "fast")
    throw Error(
        ErrorCode::bad_argument,
        fmt::format("--effort: only the fast kernel gives maps up; leave it out, or --kernel {}", request.kernel));
  std::vector<const std::string*> inputs{&request.scene, &request.cells};
  for (const auto& file : request.merged) inputs.push_back(&file);
  require_apart({&request.out, &request.json.file(), &request.exported}, inputs);
  if (request.exported.empty()) return;
  require_exportable(request.exported);
  std::error_code ignored;
  if (fs::equivalent(fs::absolute(request.out).parent_path(), request.exported, ignored))
    throw Error(ErrorCode::bad_argument,
                request.exported + ": must be empty when " + request.out + " is exported; name another folder");
}

fastpath::bakes::ListerMaker lister_for(const BakeRequest& request, std::uint64_t effort,
                                        const scene::FlaggedMesh& scene, const std::vector<scene::Polytope>& brushes,
                                        const scene::BakePlan& plan) {
  namespace solids = fastpath::solids;
  if (request.kernel == "exact") return validate::exact_lister();
  auto found = brushes.empty() ? solids::find_solids(scene) : solids::solids_of(brushes);
  const bool too_many = brushes.empty() && found.size() > kMostSolidsForMaps;
  if (request.kernel == "fast" && (found.empty() || too_many)) return fastpath::bakes::fast_lister(effort);
  std::vector<std::vector<scene::Point>> cells;
  for (const auto& cell : plan.cells) cells.push_back(cell.points);
  auto all = std::make_shared<const solids::Solids>(std::move(found), solids::bounds_of_questions(scene, cells));
  if (request.kernel == "solids") return fastpath::bakes::solid_lister(std::move(all));
  return fastpath::bakes::fast_lister(effort, std::move(all));
}

int run_bake(const BakeRequest& request) {
  Cluster cluster;
  std::optional<std::string> question;
  if (!cluster.leads() && !(question = cluster.question())) return fine;
  const Shard shard = parse_shard(request.shard);
  if (cluster.leads()) {  // the others write nothing
    require_writable_parent(request.out);
    require_writable_parent(request.json.file());
    require_unspoilt(request);
  }
  std::optional<scene::BspFile> level;
  scene::FlaggedMesh scene;
  std::vector<scene::Polytope> brushes;  // of a level
  const auto sha256 = sha256_around(request.scene, [&] {
    level = scene::read_level(request.scene);
    if (!level) {
      scene = scene::read_scene(request.scene);
      return;
    }
    auto of_level = scene::scene_of_level(*level);
    scene = std::move(of_level.scene);
    brushes = std::move(of_level.solids);
  });
  const std::uint64_t effort = request.effort.value_or(level ? kEffortInLevels : kEffort);
  const auto plan = plan_of(request, sha256, scene,
                            parse_bake_cells(request.cells, request.scene, scene, level, up_of(request)), effort);
  const int threads = cluster.threads(request.threads);
  if (!cluster.leads()) {
    serve_bake(cluster, threads, scene, plan, lister_for(request, effort, scene, brushes, plan), *question);
    return fine;
  }
  if (!fs::exists(request.out)) {  // else they are looked at when it is open, and only if it is not finished
    for (const auto& file : request.merged) scene::BakeStore::require_store_of(plan, file);
  }
  {
    scene::BakeStore store(request.out, plan);
    if (!store.is_finished()) {
      for (const auto& file : request.merged)
        std::fputs(fmt::format("clues bake: {} cells from {}\n", store.take_from(file), file).c_str(), stderr);
      const auto make_lister = lister_for(request, effort, scene, brushes, plan);
      const auto& stop = catch_interrupts();
      std::uint64_t done = 0;
      {
        ProgressBar bar("clues bake");
        const fastpath::bakes::BakeProgress progress = [&](std::uint64_t cells) {
          bar.show(cluster.alone() ? "cells" : fmt::format("cells by {} ranks", cluster.size()), done = cells,
                   plan.cells.size());
        };
        if (!cluster.alone()) {
          bake_by_ranks(cluster, threads, scene, plan, store, make_lister, shard, stop, progress);
        } else {
          exact::by_threads(threads, [&] {
            fastpath::bakes::bake(scene, plan, store, make_lister, shard.index, shard.count, stop, progress);
          });
        }
      }
      if (stop)
        throw Unfinished(fmt::format("{}: interrupted with {} of {} cells; the same command goes on", request.out, done,
                                     plan.cells.size()));
      if (!store.has_all_cells()) {
        print(fmt::format("{}: shard {} is done; --merge brings shards together\n", request.out, request.shard));
        return fine;
      }
      store.finish();
    }
  }
  const scene::FinishedBake baked(request.out);
  if (!request.exported.empty()) export_bake(request.exported, baked, scene);
  report(request, summary_of(baked, scene), plan.note);
  return fine;
}

}  // namespace

void add_bake_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("bake", "List what may be seen from every cell of a scene or level");
  auto request = std::make_shared<BakeRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cells", request->cells, "The view cells: grid:..., leaves, auto:SIZE, or a file")
      ->type_name("CELLS")
      ->required();
  command->add_option("-o,--out", request->out, "The store, one file; where it is there already, the bake goes on")
      ->type_name("FILE.bake")
      ->required();
  command->add_option("--kernel", request->kernel, "fast; solids, which is rough and quick; or exact for small scenes")
      ->check(CLI::IsMember({"fast", "solids", "exact"}))
      ->capture_default_str();
  command
      ->add_option("--group", request->group,
                   "Map so many neighbouring cells in what the box around them sees; 1: each in the scene")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 20))
      ->capture_default_str();
  command
      ->add_option("--effort", request->effort,
                   "With the fast kernel: give up a map beyond this, for each triangle mapped, and list what is not " +
                       fmt::format("proved hidden; 0: never (default: {}; {} in levels)", kEffort, kEffortInLevels))
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 32));
  command->add_option("--up", request->up, "Which way is up, for --cells auto (default: y in glTF files, else z)")
      ->check(CLI::IsMember({"y", "z"}));
  command->add_option("--threads", request->threads, "Threads, of each rank under mpirun; 0: all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command
      ->add_option("--export", request->exported,
                   "Also write plain lists and the flat file for engines, into a new folder")
      ->type_name("FOLDER");
  command->add_option("--shard", request->shard, "Map only a share, the I-th of N, for one of N machines")
      ->type_name("I/N");
  command
      ->add_option("--merge", request->merged,
                   "Take over what stores of this bake hold, of shards for instance, before mapping what is missing")
      ->type_name("FILE.bake...");
  request->json.add_to(*command, "The summary");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Lists for each cell the triangles of which some point may be seen from some point of it; none that "
          "is visible is left\n"
          "  out. The store is one SQLite file (docs/bakes.md). What is finished is in it at once: after Ctrl-C, "
          "or worse, the same\n"
          "  command goes on, and the file that it ends with has the same bytes as if nothing had happened, "
          "whatever --threads says.\n"
          "  In glTF files and levels some triangles do not block (docs/real-levels.md). The fast kernel lists "
          "those of them that it\n"
          "  cannot prove to be hidden.\n"
          "  Most maps take an effort of 5 to 50, and some had no end in minutes. A map is given up at a sixteenth of "
          "--effort. Then\n"
          "  the cell is mapped in all that counts, with two fifths of the effort, or with fewer hulls of brushes; "
          "where that takes\n"
          "  too much, too, what the map before does not prove to be hidden is listed. That is sound, and lists are "
          "longer; what is\n"
          "  listed without a proof counts as a fallback.\n"
          "  --kernel solids asks only what walls hide: closed convex parts of the scene, or the brushes of a level "
          "(docs/solids.md).\n"
          "  That takes a fraction of the time, and its lists are longer. The fast kernel asks only about what it "
          "lists.\n\n") +
      bake_cells_help +
      "\n\nEXAMPLES\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,8,8,2 -o town.bake\n"
      "  clues bake level.bsp --cells leaves -o level.bake --export engine\n"
      "  clues bake town.obj --cells auto:16:2 -o walkable.bake --json\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,8,8,2 --shard 1/2 -o first.bake\n"
      "  clues bake town.obj --cells grid:2x2x1:box:0,0,1,8,8,2 --merge first.bake -o all.bake\n"
      "  mpirun -n 2 clues bake town.obj --cells grid:2x2x1:box:0,0,1,8,8,2 -o ranks.bake   # docs/clusters.md\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   3 interrupted: the same command goes on   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_bake(*request); });
}

}  // namespace clues::app
