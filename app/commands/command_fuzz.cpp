// clues fuzz, clues shrink, clues replay: campaigns on random scenes, and what becomes of their findings.
#include <fmt/format.h>
#include <signal.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/cluster/cluster.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/shard.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/findings/dials.h"
#include "fuzz/oracles/oracle.h"
#include "fuzz/shrinking/finding_folder.h"
#include "fuzz/shrinking/promote.h"
#include "scene/duration.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "validate/processes/workers.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct FuzzRequest {
  fuzz::CampaignOptions options;
  std::string subject = "reference";
  std::vector<std::string> scenes;
  std::uint64_t cases = 0;
  std::string time, case_time, shard, agreement;
  std::uint64_t lines = 0;  // 0: as usual
  bool no_dials = false;
};

constexpr const char* usual_time = "60";
// Of --subject all: one of each kind. "fast" is compared with the reference.
constexpr std::array all_subjects{"reference", "fast", "maps", "motion", "deltas", "bakes", "streams", "levels"};

// "fast" and "1/16": "fast/16".
std::string compared(const std::string& subject, const std::string& share) {
  if (share.empty() || (share == "1/1" && subject == "fast")) return subject;
  const std::string name = subject + (share.starts_with("1/") ? share.substr(1) : "");
  if (subject != "fast" || name == "fast" || !fuzz::cases_for_a_comparison(name))
    throw Error(ErrorCode::bad_argument, "--agreement " + share + ": give 1/N, N up to 1000000, with --subject fast");
  return name;
}

// "levels" and 65536: "levels/65536".
std::string with_lines(const std::string& subject, std::uint64_t lines) {
  if (lines == 0 || (lines == fuzz::lines_of_each_level(subject))) return subject;
  if (subject != "levels") throw Error(ErrorCode::bad_argument, "--lines: give it with --subject levels");
  return fmt::format("{}/{}", subject, lines);
}

// What the campaign of one subject is put to.
fuzz::GivenScenes scenes_for(const fuzz::Subject& subject, const std::vector<std::string>& paths) {
  const bool takes_levels = subject.trial() && subject.trial()->takes_levels();
  return takes_levels ? fuzz::read_given_levels(paths) : fuzz::read_given_scenes(paths);
}

// Of rank 0, or of the only one. `options` are of this subject.
int run_campaign_of(const fuzz::Subject& subject, fuzz::CampaignOptions& options) {
  ProgressBar bar("clues fuzz");
  const auto begin = std::chrono::steady_clock::now();
  std::uint64_t first = UINT64_MAX;
  options.progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
    first = std::min(first, done);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    bar.show(fmt::format("{} ({:.1f}/s)", stage, static_cast<double>(done - first) / std::max(seconds, 0.001)), done,
             total);
  };
  options.stop = &catch_interrupts();
  const auto summary = fuzz::run_campaign(options, subject);
  bar.clear();
  print(to_text(summary, options.out));
  std::fprintf(stderr, "clues fuzz: %.1f s, %.1f cases a second\n", summary.seconds_now,
               static_cast<double>(summary.cases_now) / std::max(summary.seconds_now, 0.001));
  return summary.exit_code();
}

// One campaign after the other, each in a folder of its own and with an equal part of the time, so that each store is that of one subject: its plan, its counters, its findings.
int run_all(const FuzzRequest& request) {
  if (!request.options.generators.empty() || !request.options.oracles.empty() || !request.scenes.empty())
    throw Error(
        ErrorCode::bad_argument,
        "--subject all: --generator, --oracle and --scenes are of one subject; give them in a campaign of that one");
  std::error_code error;
  std::filesystem::create_directories(request.options.out, error);
  if (error)
    throw Error(ErrorCode::file_unwritable,
                request.options.out.string() + ": cannot make this folder: " + error.message());
  int worst = fine;
  for (const char* name : all_subjects) {
    fuzz::CampaignOptions options = request.options;
    options.out /= name;
    for (auto& folder : options.merged) folder /= name;
    if (options.time) *options.time /= static_cast<std::int64_t>(all_subjects.size());
    print(fmt::format("SUBJECT {}: {}\n", name, scene::printable(options.out.string())));
    const std::string kind = name;
    const auto subject = fuzz::make_subject(kind == "fast"     ? compared(kind, request.agreement)
                                            : kind == "levels" ? with_lines(kind, request.lines)
                                                               : kind);
    const int code = run_campaign_of(*subject, options);
    // Contradictions are worse than findings, and these than a campaign that is vacuous or was interrupted.
    const auto rank = [](int c) { return c == oracle_contradiction ? 3 : c == findings ? 2 : c == fine ? 0 : 1; };
    if (rank(code) > rank(worst)) worst = code;
    if (options.stop->load()) return rank(worst) > 1 ? worst : not_everything_ran;
  }
  return worst;
}

int run_fuzz(FuzzRequest& request) {
  Cluster cluster;
  std::optional<std::string> question;
  if (!cluster.leads() && !(question = cluster.question())) return fine;
  auto& options = request.options;
  if (request.cases > 0) options.cases = request.cases;
  if (request.time.empty() && !options.cases) request.time = usual_time;
  if (!request.time.empty()) options.time = scene::parse_duration("--time", request.time);
  if (!request.case_time.empty()) {
    const auto limit = scene::parse_duration("--case-time", request.case_time);
    options.time_for_one = std::chrono::ceil<std::chrono::seconds>(limit);
  }
  options.dials = !request.no_dials;
  const Shard shard = parse_shard(request.shard);
  options.shard = shard.index;
  options.shards = shard.count;
  if (shard.count > 1 && !options.cases)
    throw Error(ErrorCode::bad_argument, "--shard: say with --cases where all shards end");
  if (shard.count > 1 && options.errors > 0)
    throw Error(ErrorCode::bad_argument, "--shard: a shard cannot know when all have --errors; leave that out");
  if (request.subject == "all") {
    if (options.seek_pairs)
      throw Error(ErrorCode::bad_argument, "--seek-pairs: give it in a campaign of one subject that has a map");
    if (!cluster.alone())
      throw Error(ErrorCode::bad_argument, "--subject all: under mpirun give each subject a command of its own");
    return run_all(request);
  }
  const auto subject = fuzz::make_subject(with_lines(compared(request.subject, request.agreement), request.lines));
  options.given = scenes_for(*subject, request.scenes);
  const auto processes = [&](const validate::Work& work) {
    return std::make_unique<validate::Workers>(options.jobs, work, options.time_for_one);
  };
  if (!cluster.leads()) {
    fuzz::serve_campaign(
        options, *subject,
        cluster.serves(*question, processes, options.jobs, "clues fuzz: other scenes than on the first rank"));
    return fine;
  }
  options.pool = cluster.pools(processes, options.jobs);
  return run_campaign_of(*subject, options);
}

struct FolderRequest {
  std::string folder, subject, suite, id, time = usual_time;
  bool run_subject = false;
  std::uint64_t steps = fuzz::ShrinkLimits{}.steps;
};

// The user's, or the finding's. A command line that a file names is shown, and run only where the user asked for that.
std::unique_ptr<fuzz::Subject> subject_of(const FolderRequest& request, const fuzz::SavedFinding& saved) {
  if (!request.subject.empty()) return fuzz::make_subject(request.subject);
  if (fuzz::is_program(saved.subject)) {
    const std::string command = scene::printable(saved.subject);
    if (!request.run_subject)
      throw Error(ErrorCode::bad_argument, request.folder +
                                               ": the finding is about the program that runs as: " + command +
                                               "; read that line, then give --run-subject to run it, or --subject");
    std::fprintf(stderr, "clues: running the subject of the finding: %s\n", command.c_str());
  }
  return fuzz::make_subject(saved.subject);
}

// A subject that fails is not one that is mended.
std::string flaw_now(const fuzz::Finding& finding, const fuzz::Subject& subject) {
  try {
    return fuzz::flaw_of(finding, subject);
  } catch (const fuzz::NoAnswer& error) {
    throw Unfinished(subject.name() + ": the subject gives no answer: " + error.what());
  }
}

int run_replay(const FolderRequest& request) {
  const auto saved = fuzz::load_finding(request.folder);
  const auto subject = subject_of(request, saved);
  if (!request.suite.empty()) {
    if (subject->trial())
      throw Error(ErrorCode::bad_argument, "--promote: the finding is about no view cell; the suite has no such cases");
    fuzz::promote(saved.finding, request.id, request.suite);
    std::printf("%s: has the case %s now, with proofs\n", scene::printable(request.suite).c_str(), request.id.c_str());
  }
  const std::string flaw = flaw_now(saved.finding, *subject);
  if (!flaw.empty()) {
    std::printf("not reproduced: %s\n", scene::printable(flaw).c_str());
    return fine;
  }
  std::printf("reproduced: %s, %zu triangles\n  %s\n", scene::printable(saved.finding.signature()).c_str(),
              saved.finding.where.mesh.triangles.size(), scene::printable(saved.finding.explanation).c_str());
  return findings;
}

int run_shrink(const FolderRequest& request) {
  const auto time = scene::parse_duration("--time", request.time);
  auto saved = fuzz::load_finding(request.folder);
  const auto subject = subject_of(request, saved);
  const std::string flaw = flaw_now(saved.finding, *subject);
  if (!flaw.empty()) throw Error(ErrorCode::bad_argument, request.folder + ": there is nothing to shrink: " + flaw);
  const auto before = saved.finding.where.mesh.triangles.size();
  const auto shrunk = fuzz::shrink(saved.finding, *subject, {request.steps, time});
  saved.finding = shrunk.finding;
  saved.steps += shrunk.steps;
  saved.subject = subject->name();
  fuzz::save_finding(saved, request.folder);
  std::printf("%zu -> %zu triangles in %llu steps\n", before, saved.finding.where.mesh.triangles.size(),
              static_cast<unsigned long long>(shrunk.steps));
  return fine;
}

std::string fuzz_footer() {
  std::string text =
      "DESCRIPTION\n"
      "  Makes scenes, asks the subject what the cell sees, and looks for visible triangles that it denies. Every "
      "finding has\n"
      "  a witness: a sight line in fractions, confirmed by a checker that shares nothing with the search. Each is "
      "shrunk,\n"
      "  verified and saved in a folder of DIR; DIR/findings.sqlite remembers progress, counters and findings. The "
      "same\n"
      "  command goes on where the last run ended, however it ended; with more --cases it goes further.\n"
      "  Case n is a pure function of the seed and n, so findings do not depend on --jobs.\n"
      "\nSUBJECT\n"
      "  reference      the exact first-order reference of clues (default)\n"
      "  fast           the fast path, compared with the reference too; \"fast/16\", or --agreement 1/16: in one case\n"
      "                 of 16, which the case's name says\n"
      "  subdivided, backprojected\n"
      "                 the reference refined to depth 2, its hidden regions included\n"
      "  fast:subdivided, fast:backprojected\n"
      "                 the fast path refined to depth 3\n"
      "  solids         what closed convex parts of the scene do not hide (docs/solids.md)\n"
      "  maps, motion, deltas, bakes, streams, levels\n"
      "                 what answers no cell, or many, or one of a whole level, see below\n"
      "  all            a campaign of each kind, one after the other: reference, fast and the six above, in folders "
      "of\n"
      "                 their names in DIR; --cases and --errors are of each, --time is shared out\n"
      "  COMMAND LINE   a program, run once for each scene; {scene}, {cell} and {pvs} stand for an OFF file, an OBJ "
      "file of\n"
      "                 the cell's points, and the list of visible triangle ids that it has to write, one a line;\n"
      "                 {mode} for sheet or solid (without it, answer as for sheet). Without these words the three\n"
      "                 files are appended. It has 60 s, and must exit with 0.\n"
      "\nGENERATORS\n";
  for (const auto& g : fuzz::all_generators({})) text += fmt::format("  {:<22} {}\n", g.name, g.degeneracy);
  text += "\nDIALS (turned in every other case, one to three of them)\n";
  for (const auto& d : fuzz::all_dials()) text += fmt::format("  {:<22} {}\n", d.name, d.what);
  text += "\nORACLES\n";
  for (const auto& o : fuzz::all_oracles()) text += fmt::format("  {:<22} {}\n", o->name(), o->what());
  for (const char* name : fuzz::trial_names) {
    const auto subject = fuzz::make_subject(name);
    text += fmt::format(
        "\nSUBJECT {}: {}\n  Its generators and oracles; {}, and no dials are turned\n", name, subject->trial()->what(),
        subject->trial()->takes_levels() ? "--scenes are levels (bsp), glTF scenes or meshes" : "it takes no --scenes");
    for (const auto& g : subject->trial()->generators({})) text += fmt::format("  {:<22} {}\n", g.name, g.degeneracy);
    for (const auto& c : subject->trial()->checks()) text += fmt::format("  {:<22} {}\n", c.name, c.what);
  }
  return text +
         "\nEXAMPLES\n"
         "  clues fuzz --time 10m --jobs 2 --out fuzz-out\n"
         "  clues fuzz --subject './bake {scene} {cell} -o {pvs}' --seed 7 --cases 1000 --errors 5 --out fuzz-bake\n"
         "  clues fuzz --subject fast --agreement 1/16 --cases 400 --out fuzz-quick\n"
         "  clues fuzz --subject maps --cases 40 --out fuzz-maps\n"
         "  clues fuzz --subject motion --cases 110 --out fuzz-motion\n"
         "  clues fuzz --subject deltas --cases 6 --out fuzz-deltas\n"
         "  clues fuzz --subject bakes --cases 16 --out fuzz-bakes\n"
         "  clues fuzz --subject streams --cases 6 --out fuzz-streams\n"
         "  clues fuzz --subject levels --scenes level.bsp --cases 8 --out fuzz-levels\n"
         "  clues fuzz --subject levels --lines 20000 --cases 4 --out fuzz-lines\n"
         "  clues fuzz --seek-pairs --cases 400 --out fuzz-pairs\n"
         "  clues fuzz --subject all --time 1h --jobs 2 --out fuzz-all\n"
         "  clues fuzz --generator axis_boxes --oracle sight-lines --cases 50 --out fuzz-boxes\n"
         "  clues fuzz --generator umbrellas:1 --cases 50 --out fuzz-gaps            # gaps of one ulp only\n"
         "  clues fuzz --scenes vectors --scenes meshes --time 10m --out fuzz-scenes\n"
         "  clues fuzz --cases 60 --shard 1/2 --out fuzz-first\n"
         "  clues fuzz --cases 60 --shard 2/2 --out fuzz-second\n"
         "  clues fuzz --cases 60 --merge fuzz-first fuzz-second --out fuzz-both\n"
         "  mpirun -n 2 clues fuzz --cases 60 --out fuzz-ranks               # docs/clusters.md\n"
         "\nFILES\n"
         "  DIR/findings.sqlite, and a folder for each finding (docs/fuzzing.md)\n"
         "\nEXIT CODES\n"
         "  0 no finding   1 findings   2 bad usage or input   3 interrupted, or vacuous: something that the campaign "
         "must meet\n"
         "  never occurred (asked of long campaigns, or with --require-coverage)   4 an oracle contradicted itself";
}

void add_subject(CLI::App& command, std::string& subject, const char* help) {
  command.add_option("--subject", subject, help)->type_name("SUBJECT");
}

void add_run_subject(CLI::App& command, bool& run_subject) {
  command.add_flag("--run-subject", run_subject,
                   "Run the command line that the finding names. Read it first: it runs with your rights");
}

}  // namespace

void add_fuzz_commands(CLI::App& program, int& status) {
  auto* fuzz = program.add_subcommand("fuzz", "Search for scenes in which something visible is called hidden");
  auto request = std::make_shared<FuzzRequest>();
  auto& options = request->options;
  add_subject(*fuzz, request->subject,
              "What is tested: reference (default), another name, or a command line, see below");
  fuzz->add_option("--seed", options.seed, "Which scenes (default 1)")->type_name("N")->check(problem_of_count);
  fuzz->add_option("--first", options.first, "Number of the first scene of each generator (default 0)")
      ->type_name("N")
      ->check(problem_of_count);
  fuzz->add_option("--cases", request->cases, "Cases in all, those of earlier runs in DIR included")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}));
  fuzz->add_option("--time", request->time,
                   "For new cases: 90 or 90s, 10m, 2h (default 60 without --cases); shrinking comes on top")
      ->type_name("T");
  fuzz->add_option("--case-time", request->case_time,
                   "Processor time of one case, after which it is a finding without end (default 5m)")
      ->type_name("T");
  fuzz->add_option("--jobs", options.jobs, "Processes that work at once, of each rank under mpirun (default 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  fuzz->add_option("--generator", options.generators,
                   "Only this generator; may be repeated. NAME:D: with its dial at D, 0 to 7")
      ->type_name("NAME");
  fuzz->add_option(
          "--scenes", request->scenes,
          "A mesh, a vector file or a folder of them, to be cut up or mutated; for --subject levels a level; may be "
          "repeated")
      ->type_name("PATH");
  fuzz->add_flag("--no-dials", request->no_dials,
                 "All settings of the engines as usual, all scenes where they are made");
  fuzz->add_option("--agreement", request->agreement,
                   "With --subject fast: ask the reference about one case in N only (default 1/1)")
      ->type_name("1/N");
  fuzz->add_option("--lines", request->lines, "With --subject levels: sight lines of each case (default 4096)")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  fuzz->add_flag("--seek-pairs", options.seek_pairs,
                 "Choose the cases: first of generators, dials and settings that still show pairs of rules which were "
                 "never met in one case");
  fuzz->add_option("--oracle", options.oracles, "Only this oracle; may be repeated")->type_name("NAME");
  fuzz->add_option("--errors", options.errors, "Stop at this many different findings; 0: never (default)")
      ->type_name("N")
      ->check(problem_of_count);
  fuzz->add_flag("--require-coverage", options.require_coverage,
                 "Exit with 3 where something that the campaign must meet never occurred, however short it was");
  auto* shard = fuzz->add_option("--shard", request->shard,
                                 "Judge only a share of the --cases, the I-th of N, for one of N machines")
                    ->type_name("I/N");
  fuzz->add_option("--merge", options.merged,
                   "Take over first what all shards of this campaign hold, once they are done")
      ->type_name("DIR...")
      ->excludes(shard);
  fuzz->add_option("--out", options.out, "Folder of the campaign (default fuzz-out)")->type_name("DIR");
  fuzz->footer(fuzz_footer());
  fuzz->callback([request, &status] { status = run_fuzz(*request); });

  auto folder = std::make_shared<FolderRequest>();
  auto* replay = program.add_subcommand("replay", "Verify a finding of clues fuzz");
  replay->add_option("FINDING", folder->folder, "Its folder")->required();
  add_subject(*replay, folder->subject, "Ask this subject instead of the one that the finding names");
  add_run_subject(*replay, folder->run_subject);
  auto* suite = replay
                    ->add_option("--promote", folder->suite,
                                 "Also add the scene to the conformance suite in this folder, as a case of found.json")
                    ->type_name("SUITE");
  auto* id =
      replay->add_option("--id", folder->id, "The id of the new case, such as gap-beside-a-pillar")->type_name("ID");
  suite->needs(id);
  id->needs(suite);
  replay->footer(
      "DESCRIPTION\n"
      "  Refuses files that were changed after they were saved; checks the witness exactly; asks the subject again.\n"
      "  A subject that is a program runs only with --run-subject, or as you name it with --subject.\n"
      "  With --promote, what is visible and hidden in the new case is proved as `clues lint` does; where that fails\n"
      "  the suite stays as it was.\n"
      "\nEXAMPLES\n"
      "  clues replay fuzz-bake/sight-lines-hidden-visible-axis_boxes --run-subject\n"
      "  clues replay received-finding --subject './bake {scene} {cell} -o {pvs}'\n"
      "  clues replay fuzz-bake/sight-lines-hidden-visible-axis_boxes --run-subject --promote vectors --id "
      "gap-beside-a-box\n"
      "\nEXIT CODES\n"
      "  0 the subject no longer fails   1 reproduced   2 bad usage or input, or the finding was changed\n"
      "  3 the subject gives no answer");
  replay->callback([folder, &status] { status = run_replay(*folder); });

  auto* shrink = program.add_subcommand("shrink", "Make a finding of clues fuzz smaller");
  shrink
      ->add_option("FINDING", folder->folder,
                   "Its folder; our files in it are written again, with the original as it was")
      ->required();
  add_subject(*shrink, folder->subject, "Ask this subject instead of the one that the finding names");
  add_run_subject(*shrink, folder->run_subject);
  shrink->add_option("--max-steps", folder->steps, "Scenes put to the subject at most (default 600)")
      ->type_name("N")
      ->check(problem_of_count);
  shrink->add_option("--time", folder->time, "At most: 90 or 90s, 10m, 2h (default 60)")->type_name("T");
  shrink->footer(
      "DESCRIPTION\n"
      "  Fewer triangles, fewer points of the cell, shorter coordinates; the same oracle and verdict throughout, with "
      "a new\n"
      "  witness at every step. Deterministic unless the time ends it.\n"
      "\nEXAMPLES\n"
      "  clues shrink fuzz-bake/sight-lines-hidden-visible-axis_boxes --run-subject --max-steps 2000 --time 10m\n"
      "\nEXIT CODES\n"
      "  0 fine   2 bad usage or input, or the finding no longer shows itself");
  shrink->callback([folder, &status] { status = run_shrink(*folder); });
}

}  // namespace clues::app
