// A program that is not trusted, at the other end of three pipes: it may crash, hang, flood its outputs or eat memory, and none of
// that reaches the caller. A keeper (keeper.h) stands between: when the program ends, or is killed, or the caller ends, all that it started is killed.
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
    bool killed_here = false;    // it still ran at the deadline
    bool killed_keeper = false;  // and with it all that is known of its end
    int exit_code = -1;          // or -1: by a signal
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
  Io write_bytes(std::string_view bytes, Clock::time_point deadline);
  Io write_line(std::string_view line, Clock::time_point deadline);

  // The next line of its standard output, without the end of the line. `closed`: there is no further one; `line` is what came after the last
  // end of a line. `too_long`: more than `most_bytes`.
  Io read_line(std::string& line, Clock::time_point deadline, std::size_t most_bytes);

  // What it has written, at least a byte. `closed`: there is nothing more.
  Io read_bytes(std::string& bytes, Clock::time_point deadline);

  // Closes its input, waits for its end, and kills it at the deadline; what it started, in any case. What it writes meanwhile counts as unread output.
  End finish(Clock::time_point deadline);

  // Whether it wrote something that no read_line has taken.
  bool has_unread_output() const { return !read_.empty(); }

  // The last few lines of its standard error, printable.
  std::string stderr_tail() const;

 private:
  bool pump(Clock::time_point deadline, std::size_t most_bytes);
  void read_errors();
  void read_last();
  void reap(bool killed_here);
  void close_all();

  pid_t keeper_ = -1;
  int keeper_fd_ = -1, leash_ = -1, report_ = -1;
  int in_ = -1, out_ = -1, err_ = -1;  // of the program; `in_` is its input
  std::string to_write_, read_, errors_;
  End end_;
};

// One line for a person: "was killed by signal 11 (Segmentation fault)".
std::string describe(const ChildProcess::End& end);

}  // namespace clues::validate
