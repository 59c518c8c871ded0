// clues motion check, verify, conform, iut: the judges of motion bounds and of walks (D28 to D30), and the suite's cases put to a program.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/motion/motion_check.h"
#include "app/progress.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"
#include "validate/conform/program_subject.h"
#include "validate/motion/check_walk.h"
#include "validate/motion/judge_bounds.h"
#include "validate/motion/motion_conform.h"

namespace clues::app {
namespace {

struct BoundsRequest {
  std::string mesh, bounds, viewpoint;
  JsonOutput json;
  int threads = 0;
  std::uint64_t effort = validate::JudgeBoundsOptions{}.most_cubes;
};

struct WalkRequest {
  std::string walk;
  JsonOutput json;
};

struct ConformRequest {
  std::string program, suite = "vectors/motion";
  JsonOutput json;
  validate::MotionConformOptions options;
  int seconds = 10;
  bool all = false;
};

scene::MotionPoint parse_viewpoint(const std::string& text) {
  scene::MotionPoint point{};
  std::size_t from = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto comma = text.find(',', from);
    const bool last = i == 2;
    if ((comma == std::string::npos) != last) {
      throw scene::Error(scene::ErrorCode::bad_argument, "--viewpoint " + text + ": give it as X,Y,Z");
    }
    const auto token = std::string_view(text).substr(from, last ? std::string::npos : comma - from);
    const auto number = scene::parse_number(token);
    if (number.kind == scene::NumberKind::not_a_number) {
      throw scene::Error(scene::ErrorCode::bad_argument,
                         fmt::format("--viewpoint {}: '{}' is no number; give it as X,Y,Z", text, token));
    }
    if (number.kind == scene::NumberKind::non_finite) {
      throw scene::Error(scene::ErrorCode::non_finite, fmt::format("--viewpoint {}: '{}' is not finite", text, token));
    }
    point[i] = number.value;
    from = comma + 1;
  }
  return point;
}

int run_check(const BoundsRequest& request) {
  if (!request.json.file().empty()) require_writable_parent(request.json.file());
  require_apart({&request.json.file()}, {&request.mesh, &request.bounds});
  const auto mesh = scene::read_depth_mesh(request.mesh);
  const auto bounds = scene::read_motion_bounds(request.bounds);
  if (bounds.bounds.size() != mesh.triangles.size()) {
    throw scene::Error(scene::ErrorCode::malformed,
                       fmt::format("{}: {} bounds, but {} has {} triangles; there must be one for each", request.bounds,
                                   bounds.bounds.size(), request.mesh, mesh.triangles.size()));
  }
  if (mesh.triangles.empty()) {
    throw scene::Error(scene::ErrorCode::malformed, request.mesh + ": no triangle; nothing would be judged");
  }
  if (request.viewpoint.empty() && !bounds.viewpoint) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       request.bounds + " does not say for which viewpoint; give --viewpoint X,Y,Z");
  }
  const auto viewpoint = request.viewpoint.empty() ? *bounds.viewpoint : parse_viewpoint(request.viewpoint);
  if (bounds.viewpoint && *bounds.viewpoint != viewpoint) {
    throw scene::Error(scene::ErrorCode::bad_argument, request.bounds + " holds bounds for the viewpoint " +
                                                           scene::to_text(*bounds.viewpoint) + ", not for " +
                                                           scene::to_text(viewpoint));
  }
  validate::BoundsReport report;
  {
    ProgressBar bar("clues motion check");
    validate::JudgeBoundsOptions options;
    options.threads = request.threads;
    options.most_cubes = request.effort;
    options.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show("triangles", done, total); };
    report = validate::judge_motion_bounds(mesh, bounds.thresholds, viewpoint, bounds.bounds, options);
  }
  if (request.json.asked()) request.json.write(validate::to_json_text(report, mesh));
  if (!request.json.on_stdout()) print(validate::to_text(report, mesh));
  if (report.refuted != 0) return findings;
  return report.undecided != 0 ? not_everything_ran : fine;
}

int run_verify(const WalkRequest& request) {
  if (!request.json.file().empty()) require_writable_parent(request.json.file());
  require_apart({&request.json.file()}, {&request.walk});
  validate::WalkReport report;
  {
    ProgressBar bar("clues motion verify");
    report = validate::check_walk(request.walk, [&](std::uint64_t frames) { bar.show("frames", frames, 0); });
  }
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) print(validate::to_text(report));
  return report.sound() ? fine : findings;
}

int run_conform(const ConformRequest& request) {
  if (!request.json.file().empty()) require_writable_parent(request.json.file());
  require_outside(request.json.file(), request.suite);
  auto options = request.options;
  options.time = std::chrono::seconds(request.seconds);
  const auto report = validate::conform_motion(validate::read_motion_suite(request.suite),
                                               validate::split_command(request.program), options);
  if (report.results.empty()) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       request.suite + ": no case matches \"" + options.glob + "\"; nothing was asked");
  }
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) print(validate::to_text(report, request.all));
  if (report.unsound != 0 || report.failed != 0) return findings;
  return report.undecided != 0 ? not_everything_ran : fine;
}

void add_check(CLI::App& motion, int& status) {
  auto* command = motion.add_subcommand("check", "Judge motion bounds, whoever computed them: one claim a triangle");
  auto request = std::make_shared<BoundsRequest>();
  command->add_option("MESH", request->mesh, "The depth mesh: clues-depth-mesh/1 (JSON)")->required();
  command
      ->add_option("--bounds", request->bounds,
                   "The bounds: clues-motion-bounds/1 (JSON), with the thresholds that they are for")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--viewpoint", request->viewpoint,
                   "Where the bounds are said to hold; may be left out when FILE says it")
      ->type_name("X,Y,Z");
  command
      ->add_option("--effort", request->effort,
                   "How many cubes the proof of one constraint may take before it is given up")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
  command->add_option("--threads", request->threads, "0: one per core. The answer is the same")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  request->json.add_to(*command, "The judgement");
  command->footer(
      "DESCRIPTION\n"
      "  A bound m of a triangle claims: no viewpoint nearer than m to the given one violates a constraint of it.\n"
      "  proved     facing and edge length against the exact distance to the nearest violation; separation and the\n"
      "             Delaunay property by covering the ball with cubes in which an inequality shows it.\n"
      "  refuted    a viewpoint inside the ball is printed, as fractions, at which the constraint fails, exactly.\n"
      "  undecided  neither; what is printed is the radius up to which the claim is proved.\n"
      "  docs/motion.md has the constraints and the formats.\n\n"
      "EXAMPLES\n"
      "  clues motion check mesh.json --bounds bounds.json --viewpoint 0,0,1.5\n"
      "  clues motion check mesh.json --bounds bounds.json --json judgement.json\n\n"
      "EXIT CODES\n"
      "  0 all proved   1 a bound is refuted   2 bad usage or input   3 a bound stays undecided");
  command->callback([request, &status] { status = run_check(*request); });
}

void add_verify(CLI::App& motion, int& status) {
  auto* command = motion.add_subcommand("verify", "Check a whole walk: every constraint of every frame, exactly");
  auto request = std::make_shared<WalkRequest>();
  command->add_option("WALK", request->walk, "The walk: clues-motion-walk/1 (JSON lines)")->required();
  request->json.add_to(*command, "The report");
  command->footer(
      "DESCRIPTION\n"
      "  Looks at every triangle in every frame, whatever the program that walked has looked at: the mesh is closed, "
      "every\n"
      "  triangle faces the viewpoint, one direction is covered once (so the mesh projects one to one), and edge "
      "lengths,\n"
      "  separations and, where asked for, the Delaunay property keep the thresholds of the frame.\n\n"
      "EXAMPLES\n"
      "  clues motion verify walk.jsonl\n"
      "  clues motion verify walk.jsonl --json report.json\n\n"
      "EXIT CODES\n"
      "  0 every frame is valid   1 a frame is not   2 bad usage or input");
  command->callback([request, &status] { status = run_verify(*request); });
}

void add_conform(CLI::App& motion, int& status) {
  auto* command = motion.add_subcommand("conform", "Put the cases about motion bounds to a program");
  auto request = std::make_shared<ConformRequest>();
  command->add_option("--impl", request->program, "The program and its arguments, quoted as for the shell")
      ->type_name("CMD")
      ->required();
  command->add_option("--suite", request->suite, "The cases (default: vectors/motion)")->type_name("DIR");
  command->add_option("--case", request->options.glob, "Only the cases whose id matches (* and ?)")->type_name("GLOB");
  command->add_option("--time", request->seconds, "Seconds for one answer")->type_name("S")->check(CLI::Range(1, 3600));
  command->add_flag("-v,--verbose", request->all, "List the cases that are sound, too");
  request->json.add_to(*command, "The report");
  command->footer(
      "DESCRIPTION\n"
      "  The program reads one line of JSON a case (samples, triangles, thresholds, viewpoint) and answers with one "
      "line:\n"
      "  a bound for each triangle. The answers are judged as by `clues motion check`; tightness is what part of the "
      "known\n"
      "  sound bound is claimed. docs/motion.md has the lines, and a program in Python that can be copied.\n\n"
      "EXAMPLES\n"
      "  clues motion conform --impl 'clues motion iut'\n"
      "  clues motion conform --impl 'clues motion iut' --case 'edge-*' -v\n\n"
      "EXIT CODES\n"
      "  0 all sound   1 a bound is refuted, or an answer is missing   2 bad usage or input   3 a bound stays "
      "undecided");
  command->callback([request, &status] { status = run_conform(*request); });
}

void add_iut(CLI::App& motion, int& status) {
  auto* command = motion.add_subcommand("iut", "Answer the questions of `clues motion conform` with exact bounds");
  command->footer(
      "DESCRIPTION\n"
      "  Reads questions from standard input, one a line, and answers each with the bounds of the reference.\n\n"
      "EXAMPLES\n"
      "  clues motion conform --impl 'clues motion iut'");
  command->callback([&status] {
    validate::answer_motion_questions(std::cin, std::cout);
    status = fine;
  });
}

}  // namespace

void add_motion_check(CLI::App& motion, int& status) {
  add_check(motion, status);
  add_verify(motion, status);
  add_conform(motion, status);
  add_iut(motion, status);
}

}  // namespace clues::app
