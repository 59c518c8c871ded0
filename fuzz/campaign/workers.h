// Processes that work on cases: a crash or a case without end is theirs and not the campaign's, and lazy exact numbers are never shared between threads.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace clues::fuzz {

// What came back for one job.
struct WorkerReply {
  std::uint64_t job = 0;
  std::optional<std::string> text;  // none: the process died or was too late
  std::string failure;              // then: how, in words
};

class Workers {
 public:
  // Ignores SIGPIPE from here on. `work` runs in a child process; what it returns is sent back. It must not throw: then the process is as dead as by a crash.
  Workers(int count, std::function<std::string(std::uint64_t job)> work, std::chrono::seconds time_for_one);
  ~Workers();  // ends them
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  bool idle() const;   // some worker has no job
  bool empty() const;  // none has one
  void start(std::uint64_t job);
  // Waits at most this long for a reply; none when none came or a signal arrived.
  std::optional<WorkerReply> wait(std::chrono::milliseconds most);

 private:
  struct Worker;
  void launch(Worker& worker);
  WorkerReply lost(Worker& worker, bool late);

  std::function<std::string(std::uint64_t)> work_;
  std::chrono::seconds time_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace clues::fuzz
