// Processes that work on numbered tasks. A crash or a task without end is theirs and not the caller's, and lazy exact numbers are never shared
// between threads. For programs that are not ours see validate/processes/child_process.h.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "validate/processes/work_pool.h"

namespace clues::validate {

class Workers : public WorkPool {
 public:
  // `work` runs in a child process; what it returns is sent back. It may not write to files or to the standard output. Signals for the whole
  // group (Ctrl-C) are left to the caller. A process that is lost is replaced. time_for_one: none, or a task is given up after so much processor time of its
  // process, which does not depend on what else the machine does; or after ten times as much time on the clock, should it wait for something.
  // Throws scene::Error file_unreadable when no process can be made or read.
  Workers(int count, std::function<std::string(std::uint64_t task)> work,
          std::optional<std::chrono::seconds> time_for_one);
  ~Workers() override;  // ends them

  bool idle() const override;   // some worker has no task
  bool empty() const override;  // none has one
  void start(std::uint64_t task) override;
  std::optional<WorkerReply> wait(std::chrono::milliseconds most) override;

 private:
  struct Worker;
  void launch(Worker& worker);
  WorkerReply lost(Worker& worker, bool late);

  std::function<std::string(std::uint64_t)> work_;
  std::optional<std::chrono::seconds> time_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace clues::validate
