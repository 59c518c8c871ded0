// A program that is not trusted, at the other end of three pipes: it may crash, hang, flood its outputs or eat memory, and none of
// that reaches the caller. It runs in a process group of its own, which is killed as a whole; it dies with the caller.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace clues::validate {

class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Io { ok, closed, late, too_long };

  // How it ended. All zero while it runs.
  struct End {
    bool killed_here = false;  // it still ran at the deadline
    int exit_code = -1;        // or -1: by a signal
    int signal = 0;
    std::uint64_t peak_memory_bytes = 0;  // resident
  };

  // Runs words[0], looked up in PATH. memory_bytes: most address space for it, 0: no limit. Throws scene::Error bad_argument when it cannot
  // be executed.
  ChildProcess(const std::vector<std::string>& words, std::uint64_t memory_bytes);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // `closed`: it reads no more.
  Io write_line(std::string_view line, Clock::time_point deadline);

  // The next line of its standard output, without the end of the line. `closed`: there is no further one; `line` is what came after the last
  // end of a line. `too_long`: more than `most_bytes`.
  Io read_line(std::string& line, Clock::time_point deadline, std::size_t most_bytes);

  // Closes its input, waits for its end, and kills it (and its group, in any case) at the deadline.
  End finish(Clock::time_point deadline);

  // Whether it wrote something that no read_line has taken.
  bool has_unread_output() const { return !read_.empty(); }

  // The last few lines of its standard error, printable.
  std::string stderr_tail() const;

 private:
  bool pump(Clock::time_point deadline, std::size_t most_bytes);
  void reap(bool killed_here);
  void close_all();

  pid_t pid_ = -1;
  int pid_fd_ = -1, in_ = -1, out_ = -1, err_ = -1;  // `in_` is the child's input
  std::string to_write_, read_, errors_;
  End end_;
};

// One line for a person: "was killed by signal 11 (Segmentation fault)".
std::string describe(const ChildProcess::End& end);

}  // namespace clues::validate
