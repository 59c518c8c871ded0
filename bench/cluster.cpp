// A cluster that is not there: the dispatcher of rank 0 (validate/processes/dispatcher.h), driven by recorded times instead of by ranks.
// Usage: clues_bench_cluster FILE MICROSECONDS [COPIES]: a line of FILE is what a task was expected to take and what it took, in seconds of processor time, in the order of the tasks;
// MICROSECONDS is what rank 0 needs for one task, handing out and taking back; COPIES makes a longer run of the same times.
//
// Model: a rank that has done a task says so; rank 0 takes what is said one after the other, in the order of arrival, and answers each with the next task. Messages
// take 2 microseconds. Rank 0 works on nothing else.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <queue>
#include <utility>
#include <vector>

#include "validate/processes/dispatcher.h"

namespace {

struct Tasks {
  std::vector<double> expected, seconds;
};

Tasks read(const char* file, int copies) {
  Tasks once, all;
  std::ifstream in(file);
  for (double expected = 0, seconds = 0; in >> expected >> seconds;) {
    once.expected.push_back(expected);
    once.seconds.push_back(seconds);
  }
  for (int i = 0; i < copies; ++i) {
    all.expected.insert(all.expected.end(), once.expected.begin(), once.expected.end());
    all.seconds.insert(all.seconds.end(), once.seconds.begin(), once.seconds.end());
  }
  return all;
}

struct Run {
  double end = 0;   // the last task is taken back
  double tail = 0;  // since the last was handed out
  double busy = 0;  // rank 0
};

Run simulate(const std::vector<std::uint64_t>& order, const std::vector<double>& seconds, std::size_t ranks,
             double service) {
  constexpr double message = 2e-6;
  clues::validate::Dispatcher dispatcher;
  for (std::size_t r = 1; r <= ranks; ++r) dispatcher.join(r, 1);
  using Done = std::pair<double, std::size_t>;  // when rank 0 hears of it, from whom
  std::priority_queue<Done, std::vector<Done>, std::greater<>> running;
  Run run;
  double now = 0, last_given = 0;  // of rank 0
  for (std::size_t next = 0; next < order.size() || !running.empty();) {
    while (dispatcher.idle() && next < order.size()) {
      now += service / 2;
      run.busy += service / 2;
      running.emplace(now + 2 * message + seconds[order[next++]], dispatcher.give());
      last_given = now;
    }
    const auto [when, rank] = running.top();
    running.pop();
    dispatcher.done(rank);
    now = std::max(now, when) + service / 2;
    run.busy += service / 2;
  }
  run.end = now;
  run.tail = now - last_given;
  return run;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) {
    fmt::print("usage: clues_bench_cluster FILE MICROSECONDS [COPIES]; without a file there is nothing to simulate\n");
    return 0;
  }
  if (argc < 3 || argc > 4) {
    fmt::print(stderr, "usage: clues_bench_cluster FILE MICROSECONDS [COPIES]\n");
    return 2;
  }
  const Tasks tasks = read(argv[1], argc > 3 ? std::atoi(argv[3]) : 1);
  if (tasks.seconds.empty()) {
    fmt::print(stderr, "clues_bench_cluster: {}: no times in it\n", argv[1]);
    return 2;
  }
  const double service = 1e-6 * std::atof(argv[2]);
  double sum = 0, longest = 0;
  for (const double s : tasks.seconds) {
    sum += s;
    longest = std::max(longest, s);
  }
  fmt::print("{} tasks, {:.0f} s in all, the longest {:.2f} s\n", tasks.seconds.size(), sum, longest);
  fmt::print("{:>6}  {:>22}  {:>10}  {:>10}  {:>10}  {:>8}\n", "ranks", "order", "seconds", "efficiency", "tail s",
             "rank 0");
  std::vector<double> in_order(tasks.seconds.size());
  for (const std::size_t ranks : {1, 2, 8, 64, 512, 4096}) {
    for (const auto& [name, by] : {std::pair<const char*, const std::vector<double>*>{"as they come", &in_order},
                                   {"expected longest first", &tasks.expected},
                                   {"known longest first", &tasks.seconds}}) {
      const Run run = simulate(clues::validate::longest_first(*by), tasks.seconds, ranks, service);
      fmt::print("{:>6}  {:>22}  {:>10.2f}  {:>9.1f}%  {:>10.2f}  {:>7.1f}%\n", ranks, name, run.end,
                 100 * sum / (static_cast<double>(ranks) * run.end), run.tail, 100 * run.busy / run.end);
    }
  }
}
