// Where numbered tasks are worked on: processes of this machine (workers.h), or ranks on many.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace clues::validate {

// What came back for one task.
struct WorkerReply {
  std::uint64_t task = 0;
  bool finished = false;
  std::string text;  // what the task returned; when not finished: what it threw, or how its process ended
  int signal = 0;    // that ended its process
};

class WorkPool {
 public:
  WorkPool() = default;
  WorkPool(const WorkPool&) = delete;
  WorkPool& operator=(const WorkPool&) = delete;
  virtual ~WorkPool() = default;
  virtual bool idle() const = 0;   // it takes another task
  virtual bool empty() const = 0;  // it has none
  virtual void start(std::uint64_t task) = 0;
  // Waits at most this long for a reply; none when none came or a signal arrived.
  virtual std::optional<WorkerReply> wait(std::chrono::milliseconds most) = 0;
};

using Work = std::function<std::string(std::uint64_t task)>;
// Where the tasks of a run are done; `plan` is a text that says which they are: other machines compare it with what theirs would be.
using PoolMaker = std::function<std::unique_ptr<WorkPool>(const std::string& plan, const Work& work)>;
// Of another machine: does `work` for the one that leads until that has no more.
using Serve = std::function<void(const std::string& plan, const Work& work)>;

// Does tasks 0 to count - 1, and returns the replies in this order. `progress`, if there is one, is called here, after each reply.
std::vector<WorkerReply> replies_of(WorkPool& pool, std::size_t count,
                                    const std::function<void(std::size_t done)>& progress);

}  // namespace clues::validate
