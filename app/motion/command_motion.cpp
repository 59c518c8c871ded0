// clues motion: a depth mesh follows a viewpoint through a scene (D28 to D30).
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/motion/motion_check.h"
#include "app/motion/motion_output.h"
#include "app/progress.h"
#include "fastpath/motion/walk.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/motion/motion_files.h"
#include "scene/motion/view_path.h"
#include "scene/motion/walk_file.h"
#include "scene/scenes/scene_io.h"

namespace clues::app {
namespace {

using fastpath::motion::Walk;
using fastpath::motion::WalkOptions;
using Bounds = WalkOptions::Bounds;

struct MotionRequest {
  std::string scene, path, csv, svg, walk_out, mesh_out, bounds_out, bounds = "sound";
  std::vector<std::string> ply;
  std::optional<std::uint64_t> frames;
  std::uint64_t every = 1;
  WalkOptions options;
  bool compare = false;
  JsonOutput json;
};

Bounds bounds_of(const std::string& name) {
  static const std::map<std::string, Bounds> names{{"sound", Bounds::sound},
                                                   {"none", Bounds::none},
                                                   {"rebuild", Bounds::rebuild},
                                                   {"sketch-unsound", Bounds::sketch_unsound}};
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  if (name == "sketch") {
    throw scene::Error(
        scene::ErrorCode::bad_argument,
        "--bounds sketch: the published bound is not sound, triangles fail unnoticed; if that is what you want "
        "to see, write --bounds sketch-unsound");
  }
  throw scene::Error(scene::ErrorCode::bad_argument,
                     fmt::format("--bounds {}: expected sound, none, rebuild or sketch-unsound", name));
}

struct FrameFile {
  std::uint64_t frame;
  std::string file;
};

std::vector<FrameFile> frame_files(const std::vector<std::string>& words, std::uint64_t last) {
  std::vector<FrameFile> files;
  for (const std::string& word : words) {
    const std::size_t colon = word.find(':');
    FrameFile f{0, colon == std::string::npos ? "" : word.substr(colon + 1)};
    const char* end = word.data() + (colon == std::string::npos ? 0 : colon);
    const auto parsed = std::from_chars(word.data(), end, f.frame);
    if (f.file.empty() || parsed.ec != std::errc() || parsed.ptr != end) {
      throw scene::Error(scene::ErrorCode::bad_argument,
                         fmt::format("--ply {}: expected FRAME:FILE, as 0:start.ply", word));
    }
    if (f.frame > last) {
      throw scene::Error(scene::ErrorCode::bad_argument, fmt::format("--ply {}: the last frame is {}", word, last));
    }
    files.push_back(std::move(f));
  }
  return files;
}

// Of this thread, which does all of the work: what else the machine does is not in it.
double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Run {
  std::vector<FrameReport> frames;
  double seconds = 0, slowest = 0;  // of moves alone
};

// `at_frame(k, walk)` after each, the first included.
template <class AtFrame>
Run run_walk(const fastpath::Bvh& bvh, const WalkOptions& options, const std::vector<scene::MotionPoint>& path,
             const std::string& title, const AtFrame& at_frame) {
  ProgressBar bar(title);
  Run run;
  Walk walk(bvh, options, path.front());
  run.frames.push_back(walk.first());
  at_frame(std::uint64_t{0}, walk);
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double start = processor_seconds();
    run.frames.push_back(walk.move_to(path[k]));
    const double seconds = processor_seconds() - start;
    run.seconds += seconds;
    run.slowest = std::max(run.slowest, seconds);
    at_frame(std::uint64_t{k}, walk);
    bar.show("frames", k, path.size() - 1);
  }
  return run;
}

std::string table_head() {
  return fmt::format("{:<15} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7} {:>10} {:>10}\n", "bounds", "examined", "tested",
                     "reused", "removed", "flipped", "inserted", "rebuilt", "ms a frame", "slowest ms");
}

std::string table_row(const std::string& name, const Run& run) {
  const WalkSummary s = summary_of(run.frames);
  const double frames = static_cast<double>(std::max<std::uint64_t>(s.frames, 1));
  return fmt::format("{:<15} {:>8.3f}% {:>7.3f}% {:>7.3f}% {:>8.2f} {:>8.2f} {:>8.2f} {:>7} {:>10.3f} {:>10.3f}\n",
                     name, s.examined, s.tested, s.reused, s.removed, s.flipped, s.inserted, s.rebuilt,
                     1000 * run.seconds / frames, 1000 * run.slowest);
}

int run_motion(const MotionRequest& request) {
  if (request.scene.empty())
    throw scene::Error(scene::ErrorCode::bad_argument, "SCENE is required (or check, or verify)");
  if (request.path.empty()) throw scene::Error(scene::ErrorCode::bad_argument, "--path is required");
  if (request.every == 0) throw scene::Error(scene::ErrorCode::bad_argument, "--every has to be at least 1");
  WalkOptions options = request.options;
  options.bounds = bounds_of(request.bounds);
  const auto refuse = [](const std::string& what) { throw scene::Error(scene::ErrorCode::bad_argument, what); };
  const scene::MotionThresholds& limits = options.thresholds;
  if (!std::isfinite(limits.kappa)) refuse(fmt::format("--kappa {}: give a finite number", limits.kappa));
  if (!(limits.sigma >= 0 && limits.sigma <= 1))
    refuse(fmt::format("--sigma {}: sin^2 of an angle is between 0 and 1", limits.sigma));
  if (options.samples > fastpath::motion::kMostSamples)
    refuse(fmt::format("--samples {}: at most {}", options.samples, fastpath::motion::kMostSamples));
  std::vector<const std::string*> outputs{&request.csv,      &request.svg,        &request.walk_out,
                                          &request.mesh_out, &request.bounds_out, &request.json.file()};
  const auto path = scene::read_view_path(request.path, request.frames);
  const auto plys = frame_files(request.ply, path.size() - 1);
  for (const FrameFile& f : plys) outputs.push_back(&f.file);
  for (const std::string* file : outputs) {
    if (!file->empty()) require_writable_parent(*file);
  }
  require_apart(outputs, {&request.scene, &request.path});
  const auto mesh = scene::read_drawn_scene(request.scene);
  const fastpath::Bvh bvh(mesh);

  scene::WalkWriter writer;
  std::string walk_text = request.walk_out.empty() ? "" : scene::WalkWriter::header();
  std::map<std::string, std::string> ply_texts;
  std::string mesh_text, bounds_text;
  const auto at_frame = [&](std::uint64_t k, const Walk& walk) {
    if (!request.walk_out.empty() && k % request.every == 0) {
      walk_text += writer.frame(walk.mesh_in_places(), path[k], options.thresholds);
    }
    for (const FrameFile& f : plys) {
      if (f.frame == k) ply_texts[f.file] = to_ply(walk.depth_mesh(), path[k]);
    }
    if (k + 1 < path.size()) return;
    if (!request.mesh_out.empty()) mesh_text = scene::to_json_text(walk.depth_mesh());
    if (!request.bounds_out.empty()) {
      bounds_text = scene::to_json_text(scene::MotionBounds{path[k], options.thresholds, walk.bounds_left()});
    }
  };
  const Run run = run_walk(bvh, options, path, "clues motion", at_frame);
  std::string table = table_head() + table_row(request.bounds, run);
  if (request.compare) {
    for (const char* name : {"none", "rebuild"}) {
      WalkOptions other = options;
      other.bounds = bounds_of(name);
      table += table_row(
          name, run_walk(bvh, other, path, std::string("clues motion, ").append(name), [](auto, const Walk&) {}));
    }
  }
  const std::string json =
      request.json.asked()
          ? to_json_text(run.frames, options, std::filesystem::path(request.scene).filename().string(), request.path)
          : "";
  if (!request.csv.empty()) scene::write_file_atomically(request.csv, to_csv(run.frames));
  if (!request.svg.empty()) scene::write_file_atomically(request.svg, to_svg(run.frames));
  if (!request.walk_out.empty()) scene::write_file_atomically(request.walk_out, walk_text);
  if (!request.mesh_out.empty()) scene::write_file_atomically(request.mesh_out, mesh_text);
  if (!request.bounds_out.empty()) scene::write_file_atomically(request.bounds_out, bounds_text);
  for (const auto& [file, text] : ply_texts) scene::write_file_atomically(file, text);
  if (request.json.asked()) request.json.write(json);
  if (!request.json.on_stdout()) {
    const WalkSummary s = summary_of(run.frames);
    print(fmt::format("{} triangles, {} samples, {} frames, way {:.3f}\n{}", s.triangles, s.samples, s.frames, s.way,
                      table));
  }
  return fine;
}

}  // namespace

void add_motion_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand(
      "motion", "Keep a depth mesh valid while the viewpoint moves, by motion bounds; judge such bounds");
  auto request = std::make_shared<MotionRequest>();
  command->add_option("SCENE", request->scene,
                      std::string("The scene: ") + scene::scene_formats + "; what is drawn of it");
  command
      ->add_option("--path", request->path,
                   "Where the viewpoint goes: FILE with x y z a line; orbit:x,y,z,r[,turns];\nwalk:x,y,z:x,y,z[:...]")
      ->type_name("PATH");
  command->add_option("--frames", request->frames, "So many (default: 600, or the lines of FILE)")
      ->type_name("N")
      ->check(problem_of_count);
  command->add_option("--samples", request->options.samples, "So many samples of the scene (default: 11000)")
      ->type_name("N");
  command->add_option("--seed", request->options.seed, "Of the directions of the samples (default: 1)")
      ->type_name("N")
      ->check(problem_of_count);
  command
      ->add_option("--kappa", request->options.thresholds.kappa,
                   "cot of the least angle of an edge (default: 2000, which is 5e-4 rad)")
      ->type_name("X");
  command
      ->add_option("--sigma", request->options.thresholds.sigma,
                   "sin^2 of the least angle between a vertex and the opposite edge (default: 4e-14)")
      ->type_name("X");
  command->add_flag("--delaunay", request->options.thresholds.delaunay, "Edges have to be locally Delaunay, too");
  command->add_option("--bounds", request->bounds, "sound (default), none, rebuild or sketch-unsound; see below")
      ->type_name("WHICH");
  command->add_flag("--compare", request->compare,
                    "Walk once more with none and with rebuild, and print all side by side");
  command->add_option("--csv", request->csv, "The numbers of each frame")->type_name("FILE");
  command->add_option("--svg", request->svg, "Draw shares of triangles over the frames")->type_name("FILE");
  command->add_option("--ply", request->ply, "The mesh of a frame (0: the first); may be repeated")
      ->type_name("FRAME:FILE");
  command->add_option("--walk-out", request->walk_out, "The meshes of all frames, for clues motion verify")
      ->type_name("FILE");
  command->add_option("--every", request->every, "Only each Nth frame goes into --walk-out")
      ->type_name("N")
      ->check(problem_of_count);
  command->add_option("--mesh-out", request->mesh_out, "The mesh of the last frame, for clues motion check")
      ->type_name("FILE");
  command->add_option("--bounds-out", request->bounds_out, "Its bounds, for clues motion check")->type_name("FILE");
  request->json.add_to(*command, "The numbers of each frame");
  command->footer(
      "DESCRIPTION\n"
      "  Samples the scene from the first viewpoint by sight lines, makes a mesh of triangles around it, and keeps it "
      "while\n"
      "  the viewpoint moves: every triangle faces it, no edge is seen shorter and no vertex nearer to the opposite "
      "edge "
      "than\n"
      "  the thresholds. A motion bound says of each triangle how far the viewpoint may go before that can fail; only\n"
      "  triangles whose bound has been used up are examined. What fails is mended by taking samples out or by flips.\n"
      "  --bounds none examines all triangles, rebuild samples anew in each frame. sketch-unsound takes the published "
      "bound,\n"
      "  with which triangles fail unnoticed: for comparison only.\n\n"
      "EXAMPLES\n"
      "  clues motion town.obj --path walk:0,-3,1:0,3,1 --frames 20 --samples 500\n"
      "  clues motion town.obj --path orbit:0,0,1,2 --frames 20 --samples 500 --delaunay --csv motion.csv --svg "
      "motion.svg\n"
      "  clues motion town.obj --path walk:0,-3,1:0,3,1 --frames 5 --samples 500 --walk-out walk.jsonl --ply "
      "5:last.ply\n"
      "  clues motion verify walk.jsonl\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, command, &status] {
    if (command->get_subcommands().empty()) status = run_motion(*request);
  });
  add_motion_check(*command, status);
  // What is said before the name of a subcommand would go unheard.
  for (auto* subcommand : command->get_subcommands({})) {
    for (auto* option : command->get_options()) subcommand->excludes(option);
  }
}

}  // namespace clues::app
