// clues conform: runs the conformance suite against an implementation, and says what came of it.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/cluster/cluster.h"
#include "app/commands.h"
#include "app/commands/conform_stream.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/progress.h"
#include "app/shard.h"
#include "scene/duration.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/messages/shell_word.h"
#include "validate/conform/program_subject.h"
#include "validate/conform/report.h"
#include "validate/conform/result_files.h"
#include "validate/conform/runner.h"
#include "validate/processes/thread_pool.h"
#include "validate/vectors/reader.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

struct ConformRequest {
  std::string implementation, results, export_to, suite;
  std::vector<std::string> globs, flags, topics;
  std::string level = "full", shard;
  int jobs = 0;
  std::string time_limit = "10";
  std::int64_t memory_limit = 0, errors = 0;
  std::string expect_failures, junit;
  JsonOutput json;
  bool every_case = false;
};

[[noreturn]] void fail_usage(const std::string& message) {
  throw Error(ErrorCode::bad_argument, message + " (see `clues conform --help`)");
}

validate::Selection selection_of(const ConformRequest& request) {
  validate::Selection selection;
  selection.case_globs = request.globs;
  selection.flags = request.flags;
  selection.topics = request.topics;
  if (request.level != "core" && request.level != "full") fail_usage("--level " + request.level + ": use core or full");
  selection.core_only = request.level == "core";
  const Shard shard = parse_shard(request.shard);
  selection.shard = shard.index + 1;
  selection.shards = shard.count;
  return selection;
}

fs::path own_path() { return fs::read_symlink("/proc/self/exe"); }

// Beside the installed program, or in the source folder.
fs::path find_suite(const std::string& given) {
  if (!given.empty()) return given;
  const fs::path installed = own_path().parent_path().parent_path() / "share" / "clues" / "vectors";
  for (const fs::path& folder : {installed, fs::path("vectors")}) {
    if (fs::exists(folder / "index.json")) return folder;
  }
  throw Error(ErrorCode::file_not_found,
              "no conformance suite in " + installed.string() + " nor in ./vectors; give its folder with --suite DIR");
}

bool is_library(const std::string& implementation) { return implementation.ends_with(".so"); }

std::unique_ptr<validate::Subject> make_subject(const ConformRequest& request) {
  if (!request.results.empty()) return std::make_unique<validate::ResultFiles>(request.results);
  validate::ProgramLimits limits;
  limits.time = scene::parse_duration("--time-limit", request.time_limit, std::chrono::hours(24));
  if (request.memory_limit < 0 || request.memory_limit > 1000000000) {
    fail_usage(fmt::format("--memory-limit {}: give megabytes, 0 (no limit) to 10^9", request.memory_limit));
  }
  limits.memory_bytes = static_cast<std::uint64_t>(request.memory_limit) * 1000000;
  if (!is_library(request.implementation)) {
    return std::make_unique<validate::ProgramSubject>(validate::split_command(request.implementation), limits);
  }
  if (!fs::exists(request.implementation)) {
    throw Error(ErrorCode::file_not_found,
                request.implementation + ": no such file; give the path of a shared library");
  }
  const std::vector<std::string> words{own_path().string(), "iut", "--library", request.implementation};
  return std::make_unique<validate::ProgramSubject>(words, limits);
}

// The command that runs the same subject under the same limits, but for the selection.
std::string repeat_command(const ConformRequest& request, const fs::path& suite) {
  std::string command = "clues conform --suite " + scene::shell_word(suite.string());
  if (!request.results.empty()) return command + " --results " + scene::shell_word(request.results);
  command += " --impl " + scene::shell_word(request.implementation);
  if (request.time_limit != "10") command += " --time-limit " + request.time_limit;
  if (request.memory_limit != 0) command += fmt::format(" --memory-limit {}", request.memory_limit);
  return command;
}

// A name under which an answer would be looked for.
void require_no_answer(const std::string& output, const std::string& results) {
  if (!results.empty() && (output.ends_with(".clues.json") || output.ends_with(".pvs") || output.ends_with(".txt")))
    require_outside(output, results);
}

int run_conform(const ConformRequest& request) {
  Cluster cluster;
  std::optional<std::string> question;
  if (!cluster.leads() && !(question = cluster.question())) return fine;
  if (!request.implementation.empty() + !request.results.empty() + !request.export_to.empty() != 1) {
    fail_usage("give exactly one of --impl, --results and --export");
  }
  if (request.jobs < 0 || request.jobs > 4096)
    fail_usage(fmt::format("--jobs {}: use 0 (all cores) to 4096", request.jobs));
  if (request.errors < 0) fail_usage(fmt::format("--errors {}: use 0 (never stop) or more", request.errors));
  require_writable_parent(request.json.file());
  require_writable_parent(request.junit);
  std::vector<std::string> read{request.expect_failures, request.implementation};
  if (!request.implementation.empty() && !is_library(request.implementation)) {
    const auto words = validate::split_command(request.implementation);  // the adapter is often one of them
    read.insert(read.end(), words.begin(), words.end());
  }
  std::vector<const std::string*> inputs;
  for (const std::string& file : read) inputs.push_back(&file);
  require_apart({&request.json.file(), &request.junit}, inputs);
  const auto selection = selection_of(request);
  const auto folder = find_suite(request.suite);
  require_outside(request.json.file(), folder);
  require_no_answer(request.json.file(), request.results);
  const auto suite = validate::read_suite(folder);
  const auto cases = validate::select_cases(suite, selection);
  validate::RunOptions options;
  if (!request.expect_failures.empty())
    options.expected = validate::read_expected_failures(request.expect_failures, suite);
  if (cases.empty()) {
    std::fprintf(stderr, "clues: nothing was executed: none of the %zu cases of %s fits the selection\n", suite.size(),
                 scene::printable(folder.string()).c_str());
    return not_everything_ran;
  }
  if (!request.export_to.empty()) {
    validate::export_cases(cases, request.export_to);
    print(fmt::format("{} cases in {}\n", cases.size(), request.export_to));
    return fine;
  }

  const auto subject = make_subject(request);
  const int jobs = cluster.threads(request.jobs);
  options.jobs = jobs > 0 ? jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  options.error_limit = static_cast<std::uint64_t>(request.errors);
  const auto threads = [&](const validate::Work& work) {
    return std::make_unique<validate::ThreadPool>(options.jobs, work);
  };
  if (!cluster.leads()) {
    validate::serve_cases(
        *subject, cases, options,
        cluster.serves(*question, threads, options.jobs, "clues conform: other cases than on the first rank"));
    return fine;
  }
  options.pool = cluster.pools(threads, options.jobs);
  validate::Run run;
  {
    ProgressBar bar("clues conform: other cases than on the first rank");
    options.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show("cases", done, total); };
    run = validate::run_cases(*subject, cases, options);
  }
  validate::ReportContext context;
  context.about = subject->about();
  context.version = CLUES_VERSION;
  context.suite = folder.string();
  context.subject = request.results.empty() ? request.implementation : request.results;
  context.repeat = repeat_command(request, folder);
  if (request.json.asked()) request.json.write(validate::to_json_text(run, context));
  if (!request.junit.empty()) scene::write_file_atomically(request.junit, validate::to_junit_text(run, context));
  print(validate::to_text(run, context, request.every_case), request.json.on_stdout() ? stderr : stdout);
  if (run.executed() == 0) std::fputs("clues: nothing was executed: not one case was answered\n", stderr);
  return validate::exit_code(run);
}

constexpr const char* footer = R"(DESCRIPTION
  Puts the cases of the suite to an implementation and compares each answer, a potentially visible set (PVS), with what the
  suite proves about the case: which triangles are visible from the cell, and which are hidden.

  tight             exactly the visible triangles
  conservative      all visible triangles, and others
  unsound           a visible triangle is missing; a sight line that proves it is printed, after it was checked once more  (fails)
  malformed_output  what came back is no answer: not JSON, wrong sequence number, two replies, ids out of range...       (fails)
  crash             the program ended, or was killed by a signal, instead of answering                                     (fails)
  timeout           no answer in time; the program was killed, with its process group                                     (fails)
  errored           the program says that it failed, or the result file is not there                                  (exit code 3)
  resource          it ran out of memory                                                                              (exit code 3)
  unsupported       not put: the mode is not among its capabilities
  skipped           not put: the coordinates are not all single-precision numbers, and it reads these; or it declined
  rejected_input    the program calls the input bad

  Table: Qo is the overestimate (triangles listed without being visible / visible triangles), Qu the underestimate (visible triangles
  missing / visible triangles), over all answers of the topic. `looser` counts answers with a triangle that is not even
  first-order visible. The output is the same for any --jobs. Where --json prints on standard output, the table goes to standard error.

THREE WAYS IN
  --impl CMD        A program that speaks JSON lines on its standard input and output (docs/protocol.md). CMD is split into words as
                    by a shell, but runs without one. Write one in an afternoon: docs/adding-an-implementation.md
  --impl LIB.so     A shared library with the C function of clues_iut.h. It runs in a process of its own.
  --results DIR     Files: DIR/ID.clues.json, DIR/ID.pvs or DIR/ID.txt (one triangle id a line) for every case. --export DIR writes
                    the scenes and cells of the cases as OFF files, and cases.json, which lists them.

EXPECTED FAILURES
  --expect-failures FILE: {"format": "clues-expected-failures/1", "cases": [{"case": ID, "issue": URL, "date": "2026-11-21"}]}
  A listed case that fails does not count. One that does not fail any more is an error, and so is an id that the suite does not have.

STREAMS
  --stream-server CMD  A program that answers requests with messages, in lines or packets; it is asked along a route, then to go on
                    after each message, and started anew and asked to go on after the first, the middle and the last one.
  --stream FILE     Messages that a server sent to a client while a viewer went from cell to cell (docs/delta.md). At every step, what
                    the client holds has to have all that is visible from where the viewer is; a sight line proves what has not.

EXAMPLES
  clues conform --impl 'python3 my_adapter.py' --jobs 4
  clues conform --impl ./libmine.so --topic grazing --junit conform.xml
  clues conform --impl 'clues iut --kernel exact' --case '*-one-ulp-*' -v
  clues conform --export cases && ./my_tool cases && clues conform --results cases
  mpirun -n 2 clues conform --impl 'clues iut --kernel exact' --jobs 1     # docs/clusters.md

EXIT CODES
  0  no failure, or expected ones only
  1  a case failed, or one that was expected to fail did not
  2  bad usage or input; the implementation cannot be started; nothing was run
  3  nothing was executed (empty selection, everything skipped), or a case was left without an answer
  4  a proof of the suite itself does not hold: please report it)";

}  // namespace

void add_conform_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("conform", "Run the conformance suite against an implementation");
  auto request = std::make_shared<ConformRequest>();
  command->add_option("--impl", request->implementation, "What is tested: a command, or a shared library (*.so)")
      ->type_name("CMD|LIB.so");
  command->add_option("--results", request->results, "What is tested: answers in files")->type_name("DIR");
  command->add_option("--export", request->export_to, "Tests nothing: writes the selected cases as files")
      ->type_name("DIR");
  command->add_option("--suite", request->suite, "The suite; default: the installed one, or ./vectors")
      ->type_name("DIR");
  command
      ->add_option("--case", request->globs,
                   "Only cases whose id fits; * and ? are wild. May be given again, as the next two")
      ->type_name("GLOB");
  command->add_option("--flag", request->flags, "Only cases with this flag")->type_name("F");
  command->add_option("--topic", request->topics, "Only cases of this topic")->type_name("T");
  command->add_option("--level", request->level, "core: what every implementation should run; full: all (default)")
      ->type_name("core|full");
  command->add_option("--shard", request->shard, "Every N-th of the selected cases, beginning with the I-th")
      ->type_name("I/N");
  command->add_option("--jobs", request->jobs, "How many processes at a time; 0: one per core (default)")
      ->type_name("N");
  command->add_option("--time-limit", request->time_limit, "For one case: 90 or 90s, 10m, 2h (default 10)")
      ->type_name("T");
  command
      ->add_option("--memory-limit", request->memory_limit,
                   "Address space of the implementation; 0: no limit (default)")
      ->type_name("MB");
  command->add_option("--errors", request->errors, "Stop after so many problems; 0: never (default)")->type_name("N");
  command->add_option("--expect-failures", request->expect_failures, "Cases that are known to fail")->type_name("FILE");
  request->json.add_to(*command, "The whole report");
  command->add_option("--junit", request->junit, "Write JUnit XML")->type_name("FILE");
  command->add_flag("-v,--verbose", request->every_case, "A line for every case");
  for (const char* name : {"--case", "--flag", "--topic"}) command->get_option(name)->allow_extra_args(false);
  command->footer(footer);
  auto stream = std::make_shared<ConformStreamRequest>();
  auto* file = command->add_option("--stream", stream->stream, "Judge the messages of a server and its client instead")
                   ->type_name("FILE");
  command
      ->add_option("--stream-server", stream->server,
                   "Judge a server of streams: put a route to it, and have it go on after every message")
      ->type_name("CMD")
      ->excludes(file);
  command->add_option("--scene", stream->choice.scene, "With a stream: the scene")->type_name("SCENE");
  auto* cells = command->add_option("--cells", stream->choice.cells, "With a stream: the cells")->type_name("SPEC");
  auto* bake =
      command->add_option("--bake", stream->choice.bake, "With a stream: the cells, and what is hidden, of this bake")
          ->type_name("FILE")
          ->excludes(cells);
  command->add_option("--lists", stream->choice.lists, "With a stream: the same, of this file of lists")
      ->type_name("FILE")
      ->excludes(cells)
      ->excludes(bake);
  stream->route.steps = 40;
  stream->route.add_to(*command, "Of --stream-server: so many steps at random (default: 40)");
  command->callback(
      [request, stream, &status] { status = stream->asked() ? run_conform_stream(*stream) : run_conform(*request); });
}

}  // namespace clues::app
