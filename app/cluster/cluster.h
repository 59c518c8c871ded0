// A run of many ranks (ranks.h). Rank 0 reads the command, keeps the store, and hands out tasks, to itself too; the others wait for its word, so that what
// is wrong with a command is said once, and then work on what they are given. Nothing depends on who did what. A task is a number, and what rank 0 knows about it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/cluster/ranks.h"
#include "validate/processes/work_pool.h"

namespace clues::app {

class Cluster {
 public:
  Cluster();   // throws what joined_ranks() throws
  ~Cluster();  // of rank 0: all may leave. One that fails just ends, and mpirun ends the others
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  bool alone() const { return !ranks_ || ranks_->size() == 1; }
  bool leads() const { return !ranks_ || ranks_->rank() == 0; }
  int size() const { return ranks_ ? ranks_->size() : 1; }
  // Of the threads that were asked for, or of all that there are for 0, those of this rank.
  int threads(int asked) const;

  using Known = std::function<std::string(std::uint64_t task)>;
  using Learn = std::function<void(std::uint64_t task, const std::string& known)>;

  // Rank 0: a pool of all ranks, which are told `question`. `own` works here, on `places` tasks at once. Whoever gets a task is told what is `known` about it
  // by `learn`, before it is begun; none: there is nothing to know.
  std::unique_ptr<validate::WorkPool> pool(const std::string& question, std::unique_ptr<validate::WorkPool> own,
                                           int places, Known known, Learn learn);

  // What makes the pool of a rank's own for some work.
  using OwnPool = std::function<std::unique_ptr<validate::WorkPool>(const validate::Work& work)>;
  // Rank 0, for tasks about which there is nothing to know: makes pools of all ranks; none where it is alone.
  validate::PoolMaker pools(OwnPool own, int places);

  // The others: what rank 0 asks; none: there is nothing to do.
  std::optional<std::string> question();
  // ... and its tasks, until there are no more.
  void serve(validate::WorkPool& own, int places, const Learn& learn);
  // ... and all of this for work whose plan is the question. Throws scene::Error bad_argument, `otherwise`, where it is not.
  validate::Serve serves(const std::string& question, OwnPool own, int places, const std::string& otherwise);

 private:
  std::unique_ptr<Ranks> ranks_;
};

}  // namespace clues::app
