// clues lint: proves the conformance suite anew, and formats it.
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/cluster/cluster.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/progress.h"
#include "scene/messages/error.h"
#include "validate/motion/lint_motion.h"
#include "validate/multires/lint_multires.h"
#include "validate/processes/workers.h"
#include "validate/vectors/lint.h"

namespace clues::app {
namespace {

struct LintRequest {
  std::string folder = "vectors";
  JsonOutput json;
  validate::LintOptions options;
};

// The suites beside the one about visibility have proofs of their own.
int end_side_lint(const LintRequest& request, const validate::SideLintReport& report, const std::string& about,
                  const std::string& format) {
  if (request.json.asked()) request.json.write(validate::to_json_text(report, format));
  if (!request.json.on_stdout()) print(validate::to_text(report, about));
  if (!report.malformed.empty()) return bad_usage;
  if (!report.findings.empty()) return findings;
  if (report.selected == 0) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       request.folder + ": no case matches \"" + request.options.glob + "\"; nothing was proved");
  }
  return fine;
}

int run_lint(const LintRequest& request) {
  Cluster cluster;
  std::optional<std::string> question;
  if (!cluster.leads() && !(question = cluster.question())) return fine;
  auto options = request.options;
  if (options.accept && !options.write) {
    throw scene::Error(scene::ErrorCode::bad_argument, "--accept goes with --write (see `clues lint --help`)");
  }
  require_writable_parent(request.json.file());
  require_outside(request.json.file(), request.folder);
  const validate::SideLintOptions side{options.glob, options.write, options.accept};
  if (validate::is_motion_suite(request.folder)) {
    return end_side_lint(request, validate::lint_motion_suite(request.folder, side), "motion", "clues-motion-lint/1");
  }
  if (validate::is_multires_suite(request.folder)) {
    return end_side_lint(request, validate::lint_multires_suite(request.folder, side), "maps of surfaces",
                         "clues-multires-lint/1");
  }
  options.jobs = cluster.threads(options.jobs);
  if (options.jobs == 0) options.jobs = static_cast<int>(std::thread::hardware_concurrency());
  const auto processes = [&](const validate::Work& work) {
    return std::make_unique<validate::Workers>(options.jobs, work, std::nullopt);
  };
  if (!cluster.leads()) {
    validate::serve_lint(
        request.folder, options,
        cluster.serves(*question, processes, options.jobs, "clues lint: other cases than on the first rank"));
    return fine;
  }
  options.pool = cluster.pools(processes, options.jobs);
  validate::LintReport report;
  {
    ProgressBar bar("clues lint: other cases than on the first rank");
    options.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show("cases", done, total); };
    report = validate::lint_suite(request.folder, options);
  }
  if (request.json.asked()) request.json.write(validate::to_json_text(report));
  if (!request.json.on_stdout()) print(validate::to_text(report));
  bool malformed = false, unfinished = false, contradiction = false;
  for (const auto& finding : report.findings) {
    malformed |= finding.kind == validate::LintKind::malformed;
    unfinished |= finding.kind == validate::LintKind::unfinished;
    contradiction |= finding.kind == validate::LintKind::contradiction;
  }
  if (contradiction) return oracle_contradiction;
  if (malformed) return bad_usage;
  if (unfinished) return not_everything_ran;
  if (!report.findings.empty()) return findings;
  if (report.selected == 0) {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       request.folder + ": no case matches \"" + options.glob + "\"; nothing was proved");
  }
  return fine;
}

}  // namespace

void add_lint_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("lint", "Prove every expectation of the conformance suite anew");
  auto request = std::make_shared<LintRequest>();
  auto& options = request->options;
  command->add_option("DIR", request->folder, "The suite (default: vectors)");
  command
      ->add_option("--case", options.glob, "Prove only the cases whose id matches (* and ?); all files are still read")
      ->type_name("GLOB");
  command->add_flag("--write", options.write,
                    "Write the files in their canonical form, fill in expectations that are missing, and bring\n"
                    "index.json up to date");
  command->add_flag("--accept", options.accept,
                    "With --write: also replace expectations that proved wrong. Without it they are shown and kept");
  command->add_option("--jobs", options.jobs, "How many processes may work; 0: one per core. The answer is the same")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  request->json.add_to(*command, "The report");
  command->footer(
      "DESCRIPTION\n"
      "  Every triangle that must be visible has a witness, checked in rational arithmetic, or meets the cell.\n"
      "  Every triangle called umbra is proved hidden twice: by the exact first-order map (it lies outside Omega) "
      "and,\n"
      "  without the map, by an exhaustive search; inside Omega the search alone is the proof. The point-occlusion\n"
      "  oracle, which shares no algorithm with these, is asked about points of every hidden triangle and about the\n"
      "  end of every witness. The first-order visible set is computed anew. Files must have their canonical form,\n"
      "  ids must be unique and may not vanish from index.json, and counts must agree.\n"
      "  vectors/motion, the cases about motion bounds, is a suite of its own: bounds called sound are proved, those "
      "called\n"
      "  unsound refuted (docs/motion.md). vectors/multires is about surfaces and their maps (docs/maps.md).\n\n"
      "EXAMPLES\n"
      "  clues lint\n"
      "  clues lint vectors/motion\n"
      "  clues lint vectors/multires\n"
      "  clues lint vectors --case 'edge-*' --jobs 2\n"
      "  clues lint my-cases --write\n"
      "  mpirun -n 2 clues lint                                          # docs/clusters.md\n\n"
      "EXIT CODES\n"
      "  0 all is proved   1 findings   2 bad usage, or a file is malformed\n"
      "  3 a process that proved a case was killed   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_lint(*request); });
}

}  // namespace clues::app
