// Where numbered tasks are worked on: processes of this machine (workers.h), or ranks on many.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

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

}  // namespace clues::validate
