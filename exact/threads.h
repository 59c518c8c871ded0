// How many threads a piece of work and all that it splits up may have.
#pragma once

#include <tbb/task_arena.h>

namespace clues::exact {

// What work() answers, done by that many threads; 0: as many as the machine has.
template <class Work>
auto by_threads(int threads, const Work& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  return arena.execute(work);
}

// The same on a dial (dials.h): 0 leaves the work to the threads of the caller.
template <class Work>
auto by_dialed_threads(int threads, const Work& work) {
  return threads > 0 ? by_threads(threads, work) : work();
}

}  // namespace clues::exact
