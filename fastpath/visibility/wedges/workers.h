// The work of one map, shared out among threads. Each item has a result of its own, and what is made for it does not depend on who makes it.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <functional>

#include "fastpath/visibility/wedges/on_wedge.h"

namespace clues::fastpath {

class Workers {
 public:
  // So few items are done before another thread has taken up one.
  static constexpr std::size_t kAlone = 2;

  // What a thread has for itself: a pool for the points that it makes, which live as long as the Workers, and a maker of envelopes.
  struct Worker {
    explicit Worker(const LocalScene& scene) : maker(scene, pool) {}
    Pool pool;
    OnWedgeMaker maker;
  };

  explicit Workers(const LocalScene& scene) : workers_(std::cref(scene)) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  // What the threads have made is given back by as many.
  ~Workers() {
    tbb::this_task_arena::isolate([this] {
      tbb::parallel_for(workers_.range(1), [](const auto& range) {
        for (Worker& worker : range) worker.pool = {};
      });
    });
  }

  // work(i, worker) for every i < count. Intervals are rounded in every thread; exact decisions are counted as the caller's.
  template <class Work>
  void for_each(std::size_t count, const Work& work) {
    if (count <= kAlone) {
      const RoundedUp rounded_up;
      for (std::size_t i = 0; i < count; ++i) work(i, workers_.local());
      return;
    }
    std::atomic<std::uint64_t> decisions{0};
    const RoundedUp as_usual(
        CGAL_FE_TONEAREST);  // TBB gives its threads the rounding of whoever calls it first, for good
    // Isolated: a thread that waits here takes up nothing else, which would be counted here, too.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const tbb::blocked_range<std::size_t>& range) {
        const RoundedUp rounded_up;
        const std::uint64_t before = exact_decisions();
        Worker& mine = workers_.local();
        for (std::size_t i = range.begin(); i < range.end(); ++i) work(i, mine);
        decisions += exact_decisions() - before;
        exact_decisions() = before;
      });
    });
    exact_decisions() += decisions;
  }

 private:
  tbb::enumerable_thread_specific<Worker> workers_;
};

}  // namespace clues::fastpath
