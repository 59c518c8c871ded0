#include "app/commands/conform_stream.h"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "reference/visibility/first_order.h"
#include "scene/cell_spec.h"
#include "scene/messages/error.h"
#include "scene/messages/shell_word.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/route.h"
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
  text += fmt::format(" --scene {} --cells {}", scene::shell_word(request.scene), scene::shell_word(request.cells));
  if (!request.stream.empty()) return text;
  return text + (request.route.empty() ? fmt::format(" --steps {} --seed {}", request.steps, request.seed)
                                       : " --route " + scene::shell_word(request.route));
}

validate::ServerRun run_of(const ConformStreamRequest& request, const std::vector<scene::CellSpec>& cells) {
  validate::ServerRun run;
  if (!request.stream.empty()) {
    run.stream = scene::read_stream(request.stream);
    return run;
  }
  const auto route = request.route.empty()
                         ? scene::random_route(scene::neighbours_of(cells), request.steps, request.seed)
                         : scene::read_route(request.route, cells.size());
  constexpr std::chrono::minutes to_begin{10}, to_answer{1};
  return validate::run_stream_server(validate::split_command(request.server), route, true, to_begin, to_answer);
}

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
  if (request.scene.empty() || request.cells.empty())
    throw Error(ErrorCode::bad_argument, "--stream and --stream-server need --scene and --cells, too");
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto cells = scene::parse_cells(request.cells);
  const auto run = run_of(request, cells);
  const auto& stream = run.stream;
  if (!run.failed.empty()) print("FAILED " + run.failed + "\n");
  if (!run.failed.empty() && stream.messages.empty()) return findings;
  if (stream.header.scene_triangles != mesh.triangles.size() ||
      stream.header.scene_sha256 != scene::sha256_of_file(request.scene))
    throw Error(ErrorCode::bad_argument, name_of(request) + ": is of another scene than " + request.scene);
  if (stream.header.cell_count != cells.size()) {
    throw Error(ErrorCode::bad_argument, fmt::format("{}: is of {} cells, but --cells has {}", name_of(request),
                                                     stream.header.cell_count, cells.size()));
  }
  validate::StreamVerdict verdict;
  {
    ProgressBar bar("clues conform");
    std::map<std::uint32_t, validate::Judgement> known;
    const auto truth = [&](std::uint32_t c) -> const validate::Judgement& {
      if (const auto at = known.find(c); at != known.end()) return at->second;
      bar.show("cells", known.size(), cells.size());
      const auto cell = exact::ConvexCell::from_doubles(cells[c].points);
      const auto map = reference::first_order_visibility(mesh, cell, {});
      auto judgement = validate::judge_pvs(mesh, map, {});
      if (mesh.triangles.size() <= validate::kSettleTriangles)
        validate::settle(judgement, mesh, cell, reference::Mode::sheet);
      return known.emplace(c, std::move(judgement)).first->second;
    };
    verdict = validate::judge_stream(mesh, cells, stream.messages, truth);
    for (const auto& [c, judgement] : known) {
      if (!judgement.contradictions.empty())
        throw Error(ErrorCode::internal, fmt::format("the map of cell {} hides what a sight line reaches", c));
    }
  }
  std::string text;
  for (const auto& f : verdict.findings) text += text_of(f, request);
  if (!verdict.findings.empty()) {
    text += "again: " + again(request) + "\n";
  }
  text += fmt::format("{}: {} cells entered, {} triangles sent, {} taken away, {} held at most, {} undecided\n",
                      !verdict.findings.empty()   ? "unsound"
                      : verdict.undecided > 0     ? "undecided"
                      : verdict.cells_entered > 0 ? "sound"
                                                  : "nothing to judge",
                      verdict.cells_entered, verdict.sent, verdict.taken, verdict.most_held, verdict.undecided);
  if (run.resumed > 0) text += fmt::format("the connection was cut {} times; the rest came each time\n", run.resumed);
  print(text);
  if (!verdict.findings.empty() || !run.failed.empty()) return findings;
  return verdict.undecided > 0 || verdict.cells_entered == 0 ? not_everything_ran : fine;
}

}  // namespace clues::app
