// What several threads mark, each in flags of its own.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace clues::fastpath {

// Of `all` flags those that mark(i, flags) sets for any i below `count`. The same for any number of threads.
template <class Mark>
std::vector<std::uint8_t> marks(std::size_t all, std::size_t count, const Mark& mark) {
  tbb::enumerable_thread_specific<std::vector<std::uint8_t>> of_threads(all, std::uint8_t{0});
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { mark(i, of_threads.local()); });
  std::vector<std::uint8_t> by_any(all, 0);
  for (const std::vector<std::uint8_t>& mine : of_threads)
    std::transform(by_any.begin(), by_any.end(), mine.begin(), by_any.begin(), std::bit_or<>());
  return by_any;
}

}  // namespace clues::fastpath
