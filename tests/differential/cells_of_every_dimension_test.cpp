// D3, D6, D10, D12, D17 with view cells of every dimension, in small scenes whose geometry meets the cell: what both kernels call hidden is seen from nowhere.
// As many scenes as one has time for:
//   CLUES_LONG=1 CLUES_SCENES=50000 CLUES_FROM=0 clues_differential_tests --gtest_filter='CellsOfEveryDimensionLong.NothingHiddenIsSeen'
// CLUES_SEED, CLUES_THREADS, CLUES_SHRUNK (how many of a kind are made smaller); CLUES_FINDINGS=FILE takes the findings, shrunk. Scene n is the same in every run; two processes may take halves.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <thread>

#include "exact/convex_cell.h"
#include "fuzz/generators/touching_scenes.h"
#include "tests/differential/scene_judge.h"
#include "validate/workers.h"

namespace clues::tests {
namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// Scene n: the generators by turns.
fuzz::Case scene_number(std::uint64_t seed, std::uint64_t n) {
  const auto& generators = fuzz::touching_generators();
  const fuzz::DegenerateGenerator& g = generators[n % generators.size()];
  const std::uint64_t index = n / generators.size();
  fuzz::GeneratedScene scene = g.make(seed, index);
  return {g.name, seed, index, std::move(scene.mesh), std::move(scene.cell), false};
}

using SettingsOf = std::function<JudgeSettings(std::uint64_t n)>;

struct Slow {
  double seconds = 0;
  std::uint64_t n = 0;
  bool operator<(const Slow& other) const { return seconds > other.seconds; }
};

// Scenes are judged and shrunk in processes of their own: a crash, or a scene without end, is a flaw like any other.
class Campaign {
 public:
  Campaign(std::uint64_t seed, SettingsOf settings) : seed_(seed), settings_(std::move(settings)) {
    if (const char* path = std::getenv("CLUES_FINDINGS")) findings_.open(path);
  }

  void run(std::uint64_t from, std::uint64_t count) {
    begin_ = Clock::now();
    const auto width =
        static_cast<int>(number_from("CLUES_THREADS", std::max(1U, std::thread::hardware_concurrency())));
    validate::Workers workers(
        width, [this](std::uint64_t task) { return worked(task); }, kTimeForOne);
    for (std::uint64_t next = from; next < from + count || !to_shrink_.empty() || !workers.empty();) {
      while (workers.idle() && (next < from + count || !to_shrink_.empty())) {
        if (to_shrink_.empty()) {
          workers.start(next++ * kTasks);
        } else {
          workers.start(to_shrink_.begin()->first);
          shrinking_.insert(to_shrink_.extract(to_shrink_.begin()));
        }
      }
      if (const auto reply = workers.wait(std::chrono::seconds(1))) take(*reply);
    }
    print(from, count);
  }

  // Scenes by category of their flaws.
  const std::map<std::string, std::uint64_t>& flaws() const { return flaws_; }
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

 private:
  static constexpr std::uint64_t kTasks = 64;  // of each scene: 0 judges it, i + 1 shrinks its flaw i
  static constexpr std::chrono::seconds kTimeForOne{60};
  const std::uint64_t shrunk_of_each_ = number_from("CLUES_SHRUNK", 12);  // of each category and dimension

  static int dimension_of(const fuzz::Case& scene) { return exact::ConvexCell::from_doubles(scene.cell).dimension(); }

  // In a child: lines of kind, name and value; or the shrunk scene.
  std::string worked(std::uint64_t task) const {
    const fuzz::Case scene = scene_number(seed_, task / kTasks);
    const JudgeSettings settings = settings_(task / kTasks);
    std::ostringstream text;
    tbb::task_arena alone(1);  // the fast path's tasks too
    alone.execute([&] {
      const Judgement j = judge_scene(scene, settings);
      if (task % kTasks > 0) {
        const std::string category = j.flaws.at(task % kTasks - 1).category;
        const fuzz::Case small = shrunk(scene, settings, category);
        for (const Flaw& f : judge_scene(small, settings).flaws)
          text << "  " << f.category << (f.detail.empty() ? "" : ": ") << f.detail << '\n';
        text << to_obj_text(small);
        return;
      }
      text << "seconds\t-\t" << j.seconds << '\n';
      for (const auto& [what, times] : j.counts) text << "count\t" << what << '\t' << times << '\n';
      for (const Flaw& f : j.flaws) text << "flaw\t" << f.category << '\t' << f.detail << '\n';
    });
    return text.str();
  }

  void take(const validate::WorkerReply& reply) {
    const std::uint64_t n = reply.task / kTasks;
    if (const auto shrinking = shrinking_.extract(reply.task)) {
      return tell(
          n, shrinking.mapped(),
          reply.finished ? reply.text : "  not shrunk: " + reply.text + '\n' + to_obj_text(scene_number(seed_, n)));
    }
    const fuzz::Case scene = scene_number(seed_, n);
    ++counts_["scenes"];
    ++counts_["scenes of cells of dimension " + std::to_string(dimension_of(scene))];
    ++counts_["scenes of " + scene.generator];
    if (!reply.finished) note(n, scene, "the process of a scene: " + reply.text, std::nullopt);
    std::uint64_t flaw = 0;
    std::istringstream lines(reply.finished ? reply.text : "");
    for (std::string kind, name, value; std::getline(lines, kind, '\t');) {
      std::getline(lines, name, '\t');
      std::getline(lines, value);
      if (kind == "count") counts_[name] += std::strtoull(value.c_str(), nullptr, 10);
      if (kind == "flaw") note(n, scene, name, n * kTasks + ++flaw);
      if (kind != "seconds") continue;
      const Slow slow{std::strtod(value.c_str(), nullptr), n};
      slowest_.insert(std::upper_bound(slowest_.begin(), slowest_.end(), slow), slow);
      if (slowest_.size() > 10) slowest_.pop_back();
    }
    if (++done_ % 1000 == 0) {
      std::cerr << done_ << " scenes, " << std::fixed << std::setprecision(0) << seconds_since(begin_) << " s, "
                << total(flaws_) << " flaws\n";
    }
  }

  void note(std::uint64_t n, const fuzz::Case& scene, const std::string& category,
            std::optional<std::uint64_t> shrink) {
    ++flaws_[category];
    const std::uint64_t same = ++flaws_by_dimension_[category + ", dimension " + std::to_string(dimension_of(scene))];
    if (same > shrunk_of_each_) return tell(n, category, "");
    if (!shrink) return tell(n, category, to_obj_text(scene));
    to_shrink_[*shrink] = category;
  }

  void tell(std::uint64_t n, const std::string& category, const std::string& rest) {
    const fuzz::Case scene = scene_number(seed_, n);
    const JudgeSettings settings = settings_(n);
    std::ostringstream text;
    text << "FLAW " << category << "\n  scene " << n << " of seed " << seed_ << " (" << scene.generator << ' '
         << scene.index << "), cell of dimension " << dimension_of(scene) << '\n';
    if (settings.generation_limit) text << "  generation_limit " << *settings.generation_limit << '\n';
    if (settings.csv_limit) text << "  csv_limit " << *settings.csv_limit << '\n';
    text << rest << '\n';
    (findings_.is_open() ? static_cast<std::ostream&>(findings_) : std::cout) << text.str() << std::flush;
  }

  static std::uint64_t total(const std::map<std::string, std::uint64_t>& of) {
    std::uint64_t sum = 0;
    for (const auto& [what, times] : of) sum += times;
    return sum;
  }

  void print(std::uint64_t from, std::uint64_t count) const {
    std::ostringstream text;
    text << "seed " << seed_ << ", scenes " << from << " to " << from + count - 1 << ", " << std::fixed
         << std::setprecision(1) << seconds_since(begin_) << " s\n";
    for (const auto& [what, times] : counts_) text << std::setw(12) << times << "  " << what << '\n';
    text << "slowest, in s of processor time:";
    for (const Slow& s : slowest_) text << ' ' << s.n << " (" << std::setprecision(2) << s.seconds << ")";
    text << '\n' << total(flaws_) << " flaws\n";
    for (const auto& [what, times] : flaws_by_dimension_) text << std::setw(12) << times << "  FLAW " << what << '\n';
    std::cout << text.str();
  }

  std::uint64_t seed_;
  SettingsOf settings_;
  Clock::time_point begin_;
  std::ofstream findings_;
  std::uint64_t done_ = 0;
  std::map<std::string, std::uint64_t> counts_, flaws_, flaws_by_dimension_;
  std::map<std::uint64_t, std::string> to_shrink_, shrinking_;  // tasks and the categories they are about
  std::vector<Slow> slowest_;
};

constexpr std::uint64_t kSeed = 20261122;

std::map<std::string, std::uint64_t> judge_usual(std::uint64_t from, std::uint64_t scenes) {
  Campaign campaign(number_from("CLUES_SEED", kSeed), [](std::uint64_t n) {
    JudgeSettings settings;
    settings.visible_set = n % 10 == 0;
    return settings;
  });
  campaign.run(from, scenes);
  for (const char* what : {"hidden points put to the oracle", "sight lines to triangles that are not listed",
                           "scenes whose areas were compared"})
    EXPECT_GT(campaign.counts().count(what), 0U) << what;
  return campaign.flaws();
}

// D17: whatever the limits are, nothing that is seen gets lost, in no kernel, map or refinement.
std::map<std::string, std::uint64_t> judge_limited(std::uint64_t from, std::uint64_t scenes) {
  Campaign campaign(number_from("CLUES_SEED", kSeed + 1), [](std::uint64_t n) {
    constexpr std::array<std::size_t, 5> csv_limits{0, 1, 2, 5, 20};
    JudgeSettings settings;
    // Numbers that the round of generators and of cells (7 x 8) does not divide.
    const std::uint64_t turn = n / 56 + n;
    if (turn % 3 != 0) settings.generation_limit = static_cast<int>(turn / 3 % 3);
    if (turn % 3 != 1) settings.csv_limit = csv_limits[turn / 9 % csv_limits.size()];
    settings.refined = turn % 4 == 0;
    settings.points_per_region = 2;
    return settings;
  });
  campaign.run(from, scenes);
  return campaign.flaws();
}

const std::map<std::string, std::uint64_t> none;

TEST(CellsOfEveryDimension, NothingHiddenIsSeen) { EXPECT_EQ(judge_usual(0, 112), none); }

TEST(CellsOfEveryDimensionLong, NothingHiddenIsSeen) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  EXPECT_EQ(judge_usual(number_from("CLUES_FROM", 0), number_from("CLUES_SCENES", 5000)), none);
}

TEST(CellsOfEveryDimension, LimitsHideNothing) { EXPECT_EQ(judge_limited(0, 56), none); }

TEST(CellsOfEveryDimensionLong, LimitsHideNothing) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  EXPECT_EQ(judge_limited(number_from("CLUES_FROM", 0), number_from("CLUES_SCENES", 2000)), none);
}

}  // namespace
}  // namespace clues::tests
