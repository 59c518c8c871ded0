// A child takes the next task number from a counter in shared memory, announces it, works, and sends the answer through its own pipe. A
// child that dies in a task leaves that answer open and is replaced.
#include "validate/vectors/children.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>

#include "scene/error.h"

namespace clues::validate {
namespace {

using scene::Error;
using scene::ErrorCode;

// Before every answer; an announcement has no bytes and finished == 2.
struct Frame {
  std::uint64_t task = 0, bytes = 0, kind = 0;
};
enum Kind : std::uint64_t { failed = 0, finished = 1, announced = 2 };

class SharedCounter {
 public:
  SharedCounter() {
    void* const memory =
        mmap(nullptr, sizeof(std::atomic<std::size_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw Error(ErrorCode::internal, "no shared memory for the child processes");
    next_ = new (memory) std::atomic<std::size_t>(0);
  }
  ~SharedCounter() { munmap(next_, sizeof(*next_)); }
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;
  std::size_t take() { return (*next_)++; }
  bool exhausted(std::size_t count) const { return *next_ >= count; }

 private:
  std::atomic<std::size_t>* next_;
};

bool send(int pipe, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const auto written = write(pipe, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

[[noreturn]] void be_child(int pipe, std::size_t count, SharedCounter& counter,
                           const std::function<std::string(std::size_t)>& task) {
  for (std::size_t i = counter.take(); i < count; i = counter.take()) {
    const Frame start{i, 0, announced};
    if (!send(pipe, &start, sizeof start)) break;
    std::string text;
    Frame end{i, 0, finished};
    try {
      text = task(i);
    } catch (const std::exception& e) {
      text = e.what();
      end.kind = failed;
    }
    end.bytes = text.size();
    if (!send(pipe, &end, sizeof end) || !send(pipe, text.data(), text.size())) break;
  }
  _exit(0);
}

struct Child {
  pid_t process = -1;
  int pipe = -1;
  std::string received;
  bool at_work = false;
  std::size_t task = 0;
};

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("the process was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("the process left with exit code {}", WEXITSTATUS(status));
}

class Crew {
 public:
  Crew(std::size_t count, const std::function<std::string(std::size_t)>& task,
       const std::function<void(std::size_t)>& progress)
      : answers_(count), task_(task), progress_(progress) {}

  std::vector<TaskAnswer> run(int jobs) {
    for (int i = 0; i < jobs && static_cast<std::size_t>(i) < answers_.size(); ++i) start();
    while (!children_.empty()) listen();
    return std::move(answers_);
  }

 private:
  void start() {
    int ends[2];
    if (pipe(ends) != 0) throw Error(ErrorCode::internal, "no pipe for a child process");
    const pid_t process = fork();
    if (process < 0) throw Error(ErrorCode::internal, "no child process could be started");
    if (process == 0) {
      close(ends[0]);
      be_child(ends[1], answers_.size(), counter_, task_);
    }
    close(ends[1]);
    children_.push_back({process, ends[0], "", false, 0});
  }

  void listen() {
    std::vector<pollfd> waiting;
    for (const auto& child : children_) waiting.push_back({child.pipe, POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), -1) < 0) return;  // interrupted: ask again
    for (std::size_t i = waiting.size(); i-- > 0;) {
      if (waiting[i].revents != 0) hear(i);
    }
  }

  void hear(std::size_t i) {
    char bytes[65536];
    const auto got = read(children_[i].pipe, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) return;
    if (got <= 0) return bury(i);
    Child& child = children_[i];
    child.received.append(bytes, static_cast<std::size_t>(got));
    Frame frame;
    while (child.received.size() >= sizeof frame) {
      std::memcpy(&frame, child.received.data(), sizeof frame);
      if (child.received.size() < sizeof frame + frame.bytes) return;
      child.task = frame.task;
      child.at_work = frame.kind == announced;
      if (!child.at_work) answer(frame.task, frame.kind == finished, child.received.substr(sizeof frame, frame.bytes));
      child.received.erase(0, sizeof frame + frame.bytes);
    }
  }

  void bury(std::size_t i) {
    const Child child = children_[i];
    children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(i));
    close(child.pipe);
    int status = 0;
    while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
    }
    if (child.at_work) answer(child.task, false, how_it_ended(status));
    if (child.at_work && !counter_.exhausted(answers_.size())) start();
  }

  void answer(std::size_t i, bool done, std::string text) {
    answers_[i] = {done, std::move(text)};
    if (progress_) progress_(++answered_);
  }

  std::vector<TaskAnswer> answers_;
  const std::function<std::string(std::size_t)>& task_;
  const std::function<void(std::size_t)>& progress_;
  SharedCounter counter_;
  std::vector<Child> children_;
  std::size_t answered_ = 0;
};

}  // namespace

std::vector<TaskAnswer> run_in_children(std::size_t count, int jobs,
                                        const std::function<std::string(std::size_t)>& task,
                                        const std::function<void(std::size_t done)>& progress) {
  return Crew(count, task, progress).run(jobs);
}

}  // namespace clues::validate
