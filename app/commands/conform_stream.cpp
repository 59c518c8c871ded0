#include "app/commands/conform_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "app/whole_level.h"
#include "reference/visibility/first_order.h"
#include "scene/messages/error.h"
#include "scene/messages/shell_word.h"
#include "scene/scenes/scene_io.h"
#include "validate/cells/judge_cell.h"
#include "validate/conform/program_subject.h"
#include "validate/stream/conform_server.h"
#include "validate/stream/judge_stream.h"
#include "validate/verdicts/judge_report.h"
#include "validate/visible_set/settle.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

std::string name_of(const ConformStreamRequest& request) { return request.stream.empty() ? "message" : request.stream; }

std::string again(const ConformStreamRequest& request) {
  std::string text = request.stream.empty() ? "clues conform --stream-server " + scene::shell_word(request.server)
                                            : "clues conform --stream " + scene::shell_word(request.stream);
  const CellsChoice& choice = request.choice;
  text += " --scene " + scene::shell_word(choice.scene);
  for (const auto& [option, value] :
       {std::pair(" --cells ", choice.cells), {" --bake ", choice.bake}, {" --lists ", choice.lists}}) {
    if (!value.empty()) text += option + scene::shell_word(value);
  }
  return request.stream.empty() ? text + " " + request.route.as_options() : text;
}

validate::ServerRun run_of(const ConformStreamRequest& request, const ServedCells& served) {
  validate::ServerRun run;
  if (!request.stream.empty()) {
    run.stream = scene::read_stream(request.stream);
    return run;
  }
  constexpr std::chrono::minutes to_begin{10}, to_answer{1};
  return validate::run_stream_server(validate::split_command(request.server), served.header, request.route.take(served),
                                     to_begin, to_answer);
}

// What is visible from the cells of a grid: their maps, and sight lines.
class MappedTruth {
 public:
  MappedTruth(const ServedCells& served, reference::Mode mode) : served_(served) { options_.mode = mode; }

  const validate::Judgement& operator()(std::uint32_t c) {
    if (const auto at = known_.find(c); at != known_.end()) return at->second;
    bar_.show("cells", known_.size(), served_.cells.size());
    const auto& mesh = served_.scene.mesh;
    const auto cell = exact::ConvexCell::from_doubles(served_.cells[c].points);
    const auto map = reference::first_order_visibility(mesh, cell, options_);
    auto judgement = validate::judge_pvs(mesh, map, {});
    if (mesh.triangles.size() <= validate::kSettleTriangles) validate::settle(judgement, mesh, cell, options_.mode);
    if (!judgement.contradictions.empty())
      throw Error(ErrorCode::internal, fmt::format("the map of cell {} hides what a sight line reaches", c));
    return known_.emplace(c, std::move(judgement)).first->second;
  }

 private:
  const ServedCells& served_;
  reference::Options options_;
  ProgressBar bar_{"clues conform"};
  std::map<std::uint32_t, validate::Judgement> known_;
};

// Of a bake: what its lists leave out is hidden, which `clues check --all-cells --bake` looks into; the rest is in
// question where it is missing, and then sight lines from the inner cell are looked for.
class BakedTruth {
 public:
  BakedTruth(const ServedCells& served, std::string scene) : served_(served), scene_(std::move(scene)) {}

  const validate::Judgement& operator()(std::uint32_t c) {
    auto [at, is_new] = known_.try_emplace(c);
    if (is_new) {
      at->second.triangles.assign(served_.scene.mesh.triangles.size(), validate::TriangleVerdict::hidden);
      for (const std::uint32_t t : served_.lists[c])
        at->second.triangles[t] = validate::TriangleVerdict::missing_undecided;
    }
    return at->second;
  }

  // Doubts that a sight line settles become findings.
  void settle(validate::StreamVerdict& verdict) const {
    if (verdict.undecided.empty()) return;
    std::map<std::uint32_t, std::set<std::uint32_t>> missing;
    for (const auto& doubt : verdict.undecided) missing[doubt.cell].insert(doubt.triangle);
    const fastpath::SeeThroughScene scene(served_.scene);
    std::optional<WholeLevel> level;
    if (const auto file = scene::read_level(scene_)) level.emplace(*file);
    std::map<std::pair<std::uint32_t, std::uint32_t>, validate::Witness> proofs;
    ProgressBar bar("clues conform");
    std::uint64_t done = 0;
    for (const auto& [c, triangles] : missing) {
      bar.show("cells", done++, missing.size());
      std::vector<std::uint32_t> held;
      for (std::uint32_t t = 0; t < served_.scene.mesh.triangles.size(); ++t) {
        if (!triangles.contains(t)) held.push_back(t);
      }
      const auto cell = exact::ConvexCell::from_doubles(served_.inner[c]);
      for (const auto& w : validate::judge_cell(scene, served_.inner[c], held).holes) {
        if (!level || level->confirms(cell, w)) proofs[{c, w.triangle}] = w;
      }
    }
    std::vector<validate::StreamDoubt> left;
    for (const auto& doubt : verdict.undecided) {
      const auto proof = proofs.find({doubt.cell, doubt.triangle});
      if (proof == proofs.end()) {
        left.push_back(doubt);
      } else {
        verdict.findings.push_back(
            {doubt.message,
             fmt::format("triangle {} is visible from cell {} and is not there", doubt.triangle, doubt.cell),
             proof->second});
      }
    }
    verdict.undecided = std::move(left);
    std::stable_sort(verdict.findings.begin(), verdict.findings.end(),
                     [](const auto& a, const auto& b) { return a.message < b.message; });
    if (verdict.findings.size() > most_findings) verdict.findings.resize(most_findings);
  }

 private:
  static constexpr std::size_t most_findings = 20;

  const ServedCells& served_;
  std::string scene_;  // its file
  std::map<std::uint32_t, validate::Judgement> known_;
};

std::string text_of(const validate::StreamFinding& f, const ConformStreamRequest& request) {
  std::string text =
      fmt::format("UNSOUND {}:{}: {}\n", name_of(request), f.message + (request.stream.empty() ? 0 : 1), f.what);
  if (f.witness) {
    text += fmt::format("  sight line from {} to {}, {}\n", validate::to_string_exact(f.witness->v),
                        validate::to_string_exact(f.witness->p), f.witness->front ? "front" : "back");
  }
  return text;
}

}  // namespace

int run_conform_stream(const ConformStreamRequest& request) {
  if (request.choice.scene.empty())
    throw Error(ErrorCode::bad_argument,
                "--stream and --stream-server need --scene, and --cells, --bake or --lists, too");
  const ServedCells served = served_cells(request.choice);
  const auto& mesh = served.scene.mesh;
  const auto run = run_of(request, served);
  const auto& stream = run.stream;
  if (!run.failed.empty()) print("FAILED " + run.failed + "\n");
  if (!run.failed.empty() && stream.messages.empty()) return findings;
  if (const auto other = difference(served.header, stream.header); !other.empty()) {
    throw Error(ErrorCode::bad_argument,
                fmt::format("{}: is of {}: {} triangles, {} cells \"{}\"", name_of(request), other,
                            stream.header.scene_triangles, stream.header.cell_count, stream.header.cells));
  }
  validate::StreamVerdict verdict;
  const bool solid = !request.choice.has_lists() && stream.header.mode == "solid";
  if (!request.choice.has_lists()) {
    MappedTruth truth(served, solid ? reference::Mode::solid : reference::Mode::sheet);
    verdict = validate::judge_stream(mesh, served.neighbours, stream.messages,
                                     [&](std::uint32_t c) -> const validate::Judgement& { return truth(c); });
  } else {
    BakedTruth truth(served, request.choice.scene);
    verdict = validate::judge_stream(mesh, served.neighbours, stream.messages,
                                     [&](std::uint32_t c) -> const validate::Judgement& { return truth(c); });
    truth.settle(verdict);
  }
  std::string text;
  for (const auto& f : verdict.findings) text += text_of(f, request);
  if (!verdict.findings.empty()) {
    text += "again: " + again(request) + "\n";
  }
  text +=
      fmt::format("{}: {} cells entered, {} triangles sent, {} taken away, {} held at most, {}{} undecided\n",
                  !verdict.findings.empty()    ? "unsound"
                  : !verdict.undecided.empty() ? "undecided"
                  : verdict.cells_entered > 0  ? "sound"
                                               : "nothing to judge",
                  verdict.cells_entered, verdict.sent, verdict.taken, verdict.most_held,
                  verdict.contours > 0 ? fmt::format("{} contours, ", verdict.contours) : "", verdict.undecided.size());
  if (solid) text += "judged in mode solid, as the header says\n";
  if (run.resumed > 0) text += fmt::format("asked to go on {} times, it sent the rest each time\n", run.resumed);
  if (!run.anew.empty())
    text += fmt::format("started anew after message {}, it went on there\n", fmt::join(run.anew, ", after message "));
  print(text);
  if (!verdict.findings.empty() || !run.failed.empty()) return findings;
  return !verdict.undecided.empty() || verdict.cells_entered == 0 ? not_everything_ran : fine;
}

}  // namespace clues::app
