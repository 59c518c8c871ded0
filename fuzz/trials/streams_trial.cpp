// A case is a small scene; its cells lie about the cell, by name: a grid, a grid and the box around it, or boxes that touch, as in a bake. The exact kernel says what is
// visible from each; lists are those of one of the kernels, grown where poor packets are dropped. Some streams have nodes above the cells, and some contours.
#include "fuzz/trials/streams_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "exact/cell/touching.h"
#include "exact/threads.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/findings/case_random.h"
#include "fuzz/generators/parts.h"
#include "fuzz/generators/random_scenes.h"
#include "fuzz/trials/cell_space.h"
#include "reference/streams/stream_session.h"
#include "reference/streams/worth.h"
#include "scene/cell_spec.h"
#include "scene/mesh/bounds.h"
#include "scene/messages/error.h"
#include "scene/stream/caller.h"
#include "scene/stream/route.h"
#include "validate/stream/judge_stream.h"
#include "validate/verdicts/judge.h"

namespace clues::fuzz {
namespace {

using scene::Point;
using scene::StreamMessage;
using Lists = std::vector<std::vector<std::uint32_t>>;

constexpr const char* stream_judged = "stream-judged";
constexpr const char* mirrors_equal = "mirrors-equal";
constexpr const char* resumed_equal = "resumed-equal";
constexpr const char* connection_cut = "connection-cut";
constexpr std::uint64_t most_steps = 12;

// Where a viewer can be, and go.
struct Places {
  std::vector<scene::CellSpec> cells;
  Lists neighbours;
};

scene::Bounds thick_box(const Case& scene, Random& random) {
  auto box = space_for_cells(scene, random);
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.low[i] == box.high[i]) box.high[i] += 0.25;
  }
  return box;
}

std::string grid_in(const scene::Bounds& b, const std::array<int, 3>& n) {
  return fmt::format("grid:{}x{}x{}:box:{},{},{},{},{},{}", n[0], n[1], n[2], b.low[0], b.low[1], b.low[2], b.high[0],
                     b.high[1], b.high[2]);
}

// From one to the next they have a sixteenth of the box in common, or a face.
std::vector<scene::CellSpec> chain_in(const scene::Bounds& box, Random& random) {
  std::vector<scene::CellSpec> cells;
  int from = 0;
  for (int n = 0; n < 4 && from < 16; ++n) {
    const int to = n == 3 ? 16 : std::min(16, from + random.between(1, 6));
    scene::Bounds b = box;
    const auto cut = [&](std::size_t axis, int a, int z) {
      const double size = box.high[axis] - box.low[axis];
      b.high[axis] = z == 16 ? box.high[axis] : box.low[axis] + size * z / 16;
      b.low[axis] = box.low[axis] + size * a / 16;
    };
    cut(0, from, to);
    const int low = random.between(0, 7);
    cut(1, low, random.between(9, 16));
    cells.push_back({fmt::format("{}", n), box_of(b.low, b.high)});
    from = random.one_in(2) ? to : to - 1;
  }
  return cells;
}

Places places_of(const Case& scene, Random& random) {
  const auto box = thick_box(scene, random);
  Places out;
  if (random.one_in(4)) {
    out.cells = chain_in(box, random);
    std::vector<exact::ConvexCell> hulls;
    for (const auto& cell : out.cells) hulls.push_back(exact::ConvexCell::from_doubles(cell.points));
    out.neighbours = exact::touching_cells(hulls);
    return out;
  }
  constexpr std::array<std::array<int, 3>, 4> grids{{{2, 1, 1}, {3, 1, 1}, {2, 2, 1}, {1, 2, 2}}};
  out.cells = scene::parse_cells(grid_in(box, any(grids, random)));
  if (random.one_in(4)) out.cells.push_back({"around", box_of(box.low, box.high)});
  out.neighbours = scene::neighbours_of(out.cells);
  return out;
}

std::string all_lines(const std::vector<StreamMessage>& messages) {
  std::string text;
  for (const auto& message : messages) text += scene::to_line(message);
  return text;
}

SaidInSteps walked(const reference::StreamStore& store, const std::vector<std::uint32_t>& route) {
  reference::StreamServer server(store);
  SaidInSteps said;
  for (const auto cell : route) {
    said.messages.push_back(server.enter(cell));
    said.mirrors.push_back(server.mirror().bytes());
  }
  return said;
}

std::string answered(const reference::StreamStore& store, const scene::StreamHeader& header, const std::string& asked) {
  reference::StreamSession session(store, header);
  std::string said = session.greeting();
  session.feed(asked);
  for (std::string answer = session.answer_next(); !answer.empty(); answer = session.answer_next()) said += answer;
  return said;
}

class StreamsTrial : public Trial {
 public:
  explicit StreamsTrial(StreamMakers makers) : makers_(std::move(makers)) {
    for (const Kind kind : all_kinds) {
      const std::string name = name_of(kind);
      generators_.push_back({name, "as for clues fuzz; the cells lie about the cell",
                             [name, kind](std::uint64_t seed, std::uint64_t index) {
                               GeneratedScene made = generate(kind, seed, index);
                               return Case{name, seed, index, std::move(made.mesh), std::move(made.cell), made.solid};
                             }});
    }
  }

  const char* what() const override { return "streams of clues walk and clues serve on random routes (D25)"; }
  std::vector<NamedGenerator> generators(const GivenScenes&) const override { return generators_; }
  const std::vector<Check>& checks() const override {
    static const std::vector<Check> all{
        {stream_judged,
         "at each step the client holds what is visible from the cell, and each message is right",
         {"steps judged", "triangles sent", "triangles taken away", "streams with a horizon",
          "streams with a hierarchy", "contours judged", "packets dropped"}},
        {mirrors_equal, "after each step the client's slots are those of the server's mirror", {"mirrors compared"}},
        {resumed_equal, "a server that begins anew says the rest of the messages, byte for byte", {"streams resumed"}},
        {connection_cut,
         "packets over a connection that is lost at some byte bring the same messages",
         {"connections cut"}}};
    return all;
  }
  bool is_a_mesh(const Case&) const override { return true; }

  void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const override {
    Random random = random_for(scene, "streams");
    const Places places = places_of(scene, random);
    const bool fast = random.one_in(2);
    const int horizon = random.between(0, 2);
    const auto drop = static_cast<std::size_t>(random.one_in(2) ? random.between(1, 3) : 0);
    const auto steps = static_cast<std::uint64_t>(random.between(2, most_steps));
    const auto first = static_cast<std::uint32_t>(random.next() % places.cells.size());
    const auto route = scene::random_route(places.neighbours, steps, random.next(), first);
    const auto levels = static_cast<std::size_t>(random.between(0, 2));
    const bool contours = random.one_in(2);
    std::vector<validate::Judgement> truth;
    Lists lists = lists_for(scene, places, fast, is_asked(asked, stream_judged) ? &truth : nullptr);
    if (drop > 0) {
      auto grown = reference::without_poor_packets(std::move(lists), places.neighbours,
                                                   [drop](const auto& plus) { return plus.size() <= drop; });
      outcome.counters["packets dropped"] += grown.packets_before - grown.packets_after;
      outcome.counters["triangles held for dropped packets"] += grown.given_up;
      lists = std::move(grown.lists);
    }
    reference::StreamStore store(scene.mesh, lists, places.neighbours, horizon,
                                 reference::cell_tree(places.cells, levels));
    if (contours) store.add_contours();
    const auto said = makers_.walk(store, route);
    std::vector<StreamMessage> all;
    for (const auto& step : said.messages) all.insert(all.end(), step.begin(), step.end());
    outcome.counters["streams with a horizon"] += horizon > 0 ? 1U : 0U;
    outcome.counters["streams with a hierarchy"] += levels > 0 ? 1U : 0U;
    if (is_asked(asked, stream_judged)) judge_messages(scene, places, all, truth, outcome);
    if (is_asked(asked, mirrors_equal)) compare_mirrors(scene, said, outcome);
    if (is_asked(asked, resumed_equal)) compare_rest(scene, store, route, said, random, outcome);
    if (is_asked(asked, connection_cut)) compare_packets(scene, places, store, route, all, random, outcome);
  }

 private:
  // The exact kernel's maps where they are its lists, or where the truth is asked for.
  static Lists lists_for(const Case& scene, const Places& places, bool fast, std::vector<validate::Judgement>* truth) {
    const fastpath::Bvh bvh(scene.mesh);
    Lists lists;
    for (const auto& cell : places.cells) {
      if (fast) {
        fastpath::LocalMapOptions options;
        if (scene.solid) options.mode = fastpath::SideMode::solid;
        lists.push_back(
            exact::by_threads(1, [&] { return fastpath::first_order_visibility(bvh, cell.points, options).visible; }));
      }
      if (fast && !truth) continue;
      reference::Options options;
      options.threads = 1;
      if (scene.solid) options.mode = reference::Mode::solid;
      const auto map =
          reference::first_order_visibility(scene.mesh, exact::ConvexCell::from_doubles(cell.points), options);
      if (!fast) lists.push_back(map.visible);
      validate::JudgeOptions judging;
      judging.cross_check = false;
      if (truth) truth->push_back(validate::judge_pvs(scene.mesh, map, {}, judging));
    }
    return lists;
  }

  static void judge_messages(const Case& scene, const Places& places, const std::vector<StreamMessage>& all,
                             const std::vector<validate::Judgement>& truth, Outcome& outcome) {
    const auto verdict = validate::judge_stream(
        scene.mesh, places.neighbours, all,
        [&](std::uint32_t cell) -> const validate::Judgement& { return truth[cell]; }, 1);
    outcome.counters["steps judged"] += verdict.cells_entered;
    outcome.counters["triangles sent"] += verdict.sent;
    outcome.counters["triangles taken away"] += verdict.taken;
    outcome.counters["triangles missing and undecided"] += verdict.undecided.size();
    outcome.counters["contours judged"] += verdict.contours;
    if (verdict.findings.empty()) return;
    const auto& found = verdict.findings.front();
    file(scene, stream_judged, fmt::format("message {}: {}", found.message, found.what), outcome);
  }

  static void compare_mirrors(const Case& scene, const SaidInSteps& said, Outcome& outcome) {
    validate::StreamClient client(scene.mesh);
    for (std::size_t step = 0; step < said.messages.size(); ++step) {
      for (const auto& message : said.messages[step]) client.apply(message);
      ++outcome.counters["mirrors compared"];
      if (client.bytes() == said.mirrors[step]) continue;
      return file(scene, mirrors_equal,
                  fmt::format("after step {} of {} the mirrors differ", step, said.messages.size()), outcome);
    }
  }

  void compare_rest(const Case& scene, const reference::StreamStore& store, const std::vector<std::uint32_t>& route,
                    const SaidInSteps& said, Random& random, Outcome& outcome) const {
    // The client had asked for so many cells, and so many messages had come; of the last answer perhaps a part.
    const auto steps = static_cast<std::size_t>(random.between(1, static_cast<int>(route.size())));
    std::vector<StreamMessage> due;
    for (std::size_t step = 0; step < steps; ++step)
      due.insert(due.end(), said.messages[step].begin(), said.messages[step].end());
    const auto have = static_cast<std::size_t>(random.between(0, static_cast<int>(due.size())));
    const auto rest = makers_.resume(store, {route.begin(), route.begin() + static_cast<std::ptrdiff_t>(steps)}, have);
    ++outcome.counters["streams resumed"];
    due.erase(due.begin(), due.begin() + static_cast<std::ptrdiff_t>(have));
    if (all_lines(rest) != all_lines(due))
      file(scene, resumed_equal,
           fmt::format("of {} cells the client has {} messages, and the rest is not the other {}", steps, have,
                       due.size()),
           outcome);
  }

  void compare_packets(const Case& scene, const Places& places, const reference::StreamStore& store,
                       const std::vector<std::uint32_t>& route, const std::vector<StreamMessage>& all, Random& random,
                       Outcome& outcome) const {
    scene::StreamHeader header;
    header.scene_sha256 = std::string(64, '0');
    header.cells = "those of the case";
    header.scene_triangles = scene.mesh.triangles.size();
    header.cell_count = places.cells.size();
    header.lists_sha256 = store.digest();
    const auto cut = static_cast<std::size_t>(random.between(0, static_cast<int>(route.size()) - 1));
    const std::uint64_t at = random.next();
    ++outcome.counters["connections cut"];
    scene::StreamCaller caller;
    std::string asked, wrong;
    std::size_t heard = 0;
    try {
      for (std::size_t step = 0; step < route.size() && wrong.empty(); ++step) {
        asked += caller.enter(route[step]);
        std::string said = makers_.answer(store, header, asked);
        std::string fresh = said.substr(std::min(heard, said.size()));
        if (step == cut) {
          caller.receive(std::string_view(fresh).substr(0, at % (fresh.size() + 1)));
          asked = caller.connect();
          fresh = said = makers_.answer(store, header, asked);
        }
        caller.receive(fresh);
        heard = said.size();
        if (caller.waits()) wrong = fmt::format("the answer to step {} has no end", step);
      }
    } catch (const scene::Error& error) {
      wrong = error.what();
    }
    if (wrong.empty() && all_lines(caller.messages()) != all_lines(all))
      wrong = "other messages came over the connection";
    if (!wrong.empty()) wrong = fmt::format("cut in the answer to step {} of {}: {}", cut, route.size(), wrong);
    file(scene, connection_cut, wrong, outcome);
  }

  StreamMakers makers_;
  std::vector<NamedGenerator> generators_;
};

}  // namespace

StreamMakers our_stream_makers() {
  return {walked,
          [](const reference::StreamStore& store, const std::vector<std::uint32_t>& route, std::uint64_t have) {
            return reference::StreamServer(store).resume(route, have);
          },
          answered};
}

std::unique_ptr<Trial> make_streams_trial(StreamMakers makers) {
  return std::make_unique<StreamsTrial>(std::move(makers));
}
std::unique_ptr<Trial> make_streams_trial() { return make_streams_trial(our_stream_makers()); }

}  // namespace clues::fuzz
