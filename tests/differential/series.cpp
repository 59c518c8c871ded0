#include "tests/differential/series.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <thread>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "tests/differential/scene_shrinking.h"
#include "validate/processes/workers.h"

namespace clues::tests {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

struct Slow {
  double seconds = 0;
  std::uint64_t n = 0;
  bool operator<(const Slow& other) const { return seconds > other.seconds; }
};

// Scenes are judged and shrunk in processes of their own: a crash, or a scene without end, is a flaw like any other.
class Campaign {
 public:
  explicit Campaign(Series series) : series_(std::move(series)) {
    if (const char* path = std::getenv("CLUES_FINDINGS")) findings_.open(path);
  }

  Totals run(std::uint64_t from, std::uint64_t count) {
    begin_ = Clock::now();
    const auto width =
        static_cast<int>(number_from("CLUES_THREADS", std::max(1U, std::thread::hardware_concurrency())));
    validate::Workers workers(
        width, [this](std::uint64_t task) { return worked(task); },
        std::chrono::seconds(number_from("CLUES_TIME_FOR_ONE", 60)));
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
    return {flaws_, counts_};
  }

 private:
  static constexpr std::uint64_t kTasks = 64;  // of each scene: 0 judges it, i + 1 shrinks its flaw i
  const std::uint64_t shrunk_of_each_ = number_from("CLUES_SHRUNK", 12);  // of each category and dimension

  fuzz::Case scene(std::uint64_t n) const { return series_.scene(series_.seed, n); }
  static int dimension_of(const fuzz::Case& scene) { return exact::ConvexCell::from_doubles(scene.cell).dimension(); }

  // In a child: lines of kind, name and value; or the shrunk scene.
  std::string worked(std::uint64_t task) const {
    const fuzz::Case judged = scene(task / kTasks);
    const JudgeSettings settings = series_.settings(task / kTasks);
    std::ostringstream text;
    tbb::task_arena alone(1);  // the fast path's tasks too
    alone.execute([&] {
      const Judgement j = judge_scene(judged, settings);
      if (task % kTasks > 0) {
        const std::string category = j.flaws.at(task % kTasks - 1).category;
        const fuzz::Case small = shrunk(judged, settings, category);
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
      return tell(n, shrinking.mapped(),
                  reply.finished ? reply.text : "  not shrunk: " + reply.text + '\n' + to_obj_text(scene(n)));
    }
    const fuzz::Case judged = scene(n);
    ++counts_["scenes"];
    ++counts_["scenes of cells of dimension " + std::to_string(dimension_of(judged))];
    ++counts_["scenes of " + judged.generator];
    if (!reply.finished) note(n, judged, "the process of a scene: " + reply.text, std::nullopt);
    std::uint64_t flaw = 0;
    std::istringstream lines(reply.finished ? reply.text : "");
    for (std::string kind, name, value; std::getline(lines, kind, '\t');) {
      std::getline(lines, name, '\t');
      std::getline(lines, value);
      if (kind == "count") counts_[name] += std::strtoull(value.c_str(), nullptr, 10);
      if (kind == "flaw") note(n, judged, name, n * kTasks + ++flaw);
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

  void note(std::uint64_t n, const fuzz::Case& judged, const std::string& category,
            std::optional<std::uint64_t> shrink) {
    ++flaws_[category];
    const std::uint64_t same = ++flaws_by_dimension_[category + ", dimension " + std::to_string(dimension_of(judged))];
    if (same > shrunk_of_each_) return tell(n, category, "");
    if (!shrink) return tell(n, category, to_obj_text(judged));
    to_shrink_[*shrink] = category;
  }

  void tell(std::uint64_t n, const std::string& category, const std::string& rest) {
    const fuzz::Case judged = scene(n);
    std::ostringstream text;
    text << "FLAW " << category << "\n  scene " << n << " of seed " << series_.seed << " (" << judged.generator << ' '
         << judged.index << "), cell of dimension " << dimension_of(judged) << '\n';
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
    text << "seed " << series_.seed << ", scenes " << from << " to " << from + count - 1 << ", " << std::fixed
         << std::setprecision(1) << seconds_since(begin_) << " s\n";
    for (const auto& [what, times] : counts_) text << std::setw(12) << times << "  " << what << '\n';
    text << "slowest, in s of processor time:";
    for (const Slow& s : slowest_) text << ' ' << s.n << " (" << std::setprecision(2) << s.seconds << ")";
    text << '\n' << total(flaws_) << " flaws\n";
    for (const auto& [what, times] : flaws_by_dimension_) text << std::setw(12) << times << "  FLAW " << what << '\n';
    std::cout << text.str();
  }

  Series series_;
  Clock::time_point begin_;
  std::ofstream findings_;
  std::uint64_t done_ = 0;
  std::map<std::string, std::uint64_t> counts_, flaws_, flaws_by_dimension_;
  std::map<std::uint64_t, std::string> to_shrink_, shrinking_;  // tasks and the categories they are about
  std::vector<Slow> slowest_;
};

}  // namespace

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

Totals judge_series(const Series& series, std::uint64_t from, std::uint64_t count) {
  return Campaign(series).run(from, count);
}

}  // namespace clues::tests
