#include "validate/processes/dispatcher.h"

#include <algorithm>
#include <numeric>

namespace clues::validate {

void Dispatcher::join(std::size_t worker, int places) {
  if (worker >= places_.size()) places_.resize(worker + 1);
  if (places <= 0) return;
  places_[worker] += places;
  free_.emplace(-places_[worker], worker);
}

std::size_t Dispatcher::give() {
  const auto node = free_.extract(free_.begin());
  const std::size_t worker = node.value().second;
  if (--places_[worker] > 0) free_.emplace(-places_[worker], worker);
  ++given_;
  return worker;
}

void Dispatcher::done(std::size_t worker) {
  free_.erase({-places_[worker], worker});
  free_.emplace(-++places_[worker], worker);
  --given_;
}

std::vector<std::uint64_t> longest_first(const std::vector<double>& expected) {
  std::vector<std::uint64_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint64_t a, std::uint64_t b) { return expected[a] > expected[b]; });
  return order;
}

}  // namespace clues::validate
