// Work split among threads. Each piece writes to a place of its own, so that results do not depend on how many threads there are.
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

#include "exact/threads.h"

namespace clues::reference {

// work(i) for every i below count; 0 threads: as many as the machine has.
template <class Work>
void in_parallel(std::size_t count, int threads, const Work& work) {
  exact::by_threads(threads, [&] { tbb::parallel_for(std::size_t{0}, count, work); });
}

}  // namespace clues::reference
