// Who works on what: the decisions of the process that hands out work, without a clock or a message, so that they can be tested, and driven by recorded times
// (bench/cluster.cpp). A task goes to whoever has most places free, the lowest number among equals: O(log n) of n workers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace clues::validate {

class Dispatcher {
 public:
  void join(std::size_t worker, int places);  // once: from now on it takes so many tasks at once
  bool idle() const { return !free_.empty(); }
  bool empty() const { return given_ == 0; }
  std::size_t give();             // which worker gets the next task; one must be idle
  void done(std::size_t worker);  // with one of its tasks

 private:
  std::vector<int> places_;                     // free ones
  std::set<std::pair<int, std::size_t>> free_;  // (-places, worker), of workers that have any
  std::size_t given_ = 0;
};

// The numbers of the tasks, those that are expected to take longest first: what is left for the end is short. Equal ones in their order.
std::vector<std::uint64_t> longest_first(const std::vector<double>& expected);

}  // namespace clues::validate
