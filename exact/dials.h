// Dials that make rare paths of both engines common, for tests and fuzzing; a user never turns one. With any setting the answer is sound (D7); where nothing that
// is limited is reached it is the same as with none: the PVS and the areas, not necessarily how sides are cut into regions. (But where triangles block that do not count, what else the fast kernel
// lists hangs on what it maps first: closure.h.) Plain data: what a dial does is
// written where it is read.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace clues::exact {

// Of one map.
struct Dials {
  static constexpr std::int64_t kOwn = -1;  // as the engine has it

  // D17. What lies beyond counts as visible, and as a fallback.
  int generation_limit = 8;  // wedges of a later generation are not built
  // Nor are those of more CSVs than csv_limit and so many for each edge of the complex; they are left out by whole waves.
  std::size_t csv_limit = 1000, csv_limit_per_edge = 1;
  std::int64_t longest_walk = kOwn;  // D14: legs after which a walk is given up

  // The part of the scene that is mapped first, by the closure of the fast path and by the traversal of the reference.
  enum class FirstGuess : std::uint8_t { seen, nothing, everything };
  FirstGuess first_guess = FirstGuess::seen;
  // So many in all that look for more of it, and no more than so many for each triangle that may be witnessed; 0: none.
  std::int64_t sight_rays = kOwn;
  int sight_tries(int own) const {
    return sight_rays == kOwn ? own : static_cast<int>(std::min<std::int64_t>(own, sight_rays));
  }

  // So much at once: wedges before the next look at what they light, failed proofs before the next map. 0: as the engine has it.
  std::size_t batch = 0;
  // What is open after a map of the fast path is mapped alone if that takes at most so many hundredths of the part (open_part.h). 0: never.
  std::int64_t open_percent = kOwn;
  int threads = 0;  // 0: as many as the caller has given
};

// Of the whole process: they are read where no options reach, so only a test, or a worker process of the fuzzer, sets them. Each is one flag; it is read without
// synchronisation, one load and a branch that is never taken, so set them while nothing else runs. Threads that start later see them.
struct ProcessDials {
  bool unsure_doubles = false;  // the double filter of segment queries never knows
  bool unsure_intervals =
      false;  // nor do intervals: signs go to exact numbers, boxes are never excluded (CGAL's own filters have no switch)
  bool flat_trees = false;  // box trees made from now on are one leaf each, or, where leaves are small, cull nothing
};

namespace process_dials {
inline constinit std::atomic<bool> unsure_doubles{false}, unsure_intervals{false}, flat_trees{false};
inline bool is_on(const std::atomic<bool>& dial) { return dial.load(std::memory_order_relaxed); }
}  // namespace process_dials

// Turns them for its lifetime.
class TurnedProcessDials {
 public:
  explicit TurnedProcessDials(const ProcessDials& dials)
      : before_{process_dials::unsure_doubles, process_dials::unsure_intervals, process_dials::flat_trees} {
    set(dials);
  }
  TurnedProcessDials(const TurnedProcessDials&) = delete;
  TurnedProcessDials& operator=(const TurnedProcessDials&) = delete;
  ~TurnedProcessDials() { set(before_); }

 private:
  static void set(const ProcessDials& dials) {
    process_dials::unsure_doubles = dials.unsure_doubles;
    process_dials::unsure_intervals = dials.unsure_intervals;
    process_dials::flat_trees = dials.flat_trees;
  }
  ProcessDials before_;
};

}  // namespace clues::exact
