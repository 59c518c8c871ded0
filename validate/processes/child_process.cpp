// Pipes and poll. Deadlines hold whatever the program does: they are asked also while there is always something to read.
#include "validate/processes/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "validate/processes/keeper.h"

namespace clues::validate {
namespace {

constexpr std::size_t kept_errors = 4096;
constexpr std::size_t most_unasked = 1 << 20;  // read while it has not even been asked

[[noreturn]] void fail_here(const char* what) {
  throw std::system_error(errno, std::generic_category(), std::string("cannot start a program: ") + what);
}

// Where the caller has closed a standard stream, a pipe must not take its number.
int beyond_standard(int descriptor) {
  if (descriptor > STDERR_FILENO) return descriptor;
  const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  close(descriptor);
  if (moved < 0) fail_here("pipe");
  return moved;
}

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail_here("pipe");
    read = beyond_standard(ends[0]);
    write = beyond_standard(ends[1]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    if (read >= 0) close(read);
    if (write >= 0) close(write);
  }
  static int take(int& end) {
    const int taken = end;
    end = -1;
    return taken;
  }
};

// A write to a pipe that nobody reads raises SIGPIPE in the writing thread: held back, and taken away again.
class NoSigpipe {
 public:
  NoSigpipe() {
    sigemptyset(&sigpipe_);
    sigaddset(&sigpipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &sigpipe_, &before_);
  }
  NoSigpipe(const NoSigpipe&) = delete;
  NoSigpipe& operator=(const NoSigpipe&) = delete;
  ~NoSigpipe() {
    const timespec now{};
    while (sigtimedwait(&sigpipe_, nullptr, &now) == SIGPIPE) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t sigpipe_{}, before_{};
};

int milliseconds_until(ChildProcess::Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - ChildProcess::Clock::now()).count();
  return static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(left, 0, 3600 * 1000));
}

void close_end(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

// Appends what can be read now; closes the end at the end of the file.
void read_some(int& descriptor, std::string& to) {
  std::array<char, 65536> buffer;
  const auto got = read(descriptor, buffer.data(), buffer.size());
  if (got > 0) {
    to.append(buffer.data(), static_cast<std::size_t>(got));
  } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
    close_end(descriptor);
  }
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, std::uint64_t memory_bytes) {
  std::vector<std::string> copies = words;
  std::vector<char*> raw;
  for (auto& word : copies) raw.push_back(word.data());
  raw.push_back(nullptr);
  Pipe in, out, err, failure, leash, report;
  adopt_orphans();
  keeper_ = fork_known();
  if (keeper_ < 0) fail_here("fork");
  if (keeper_ == 0)
    keep(raw.data(), {in.read, out.write, err.write, failure.write, leash.read, report.write}, memory_bytes);
  for (int* end : {&failure.write, &leash.read, &report.write}) close_end(*end);
  leash_ = Pipe::take(leash.write);
  report_ = Pipe::take(report.read);
  keeper_fd_ = static_cast<int>(syscall(SYS_pidfd_open, keeper_, 0));
  if (keeper_fd_ < 0) {
    const int kept = errno;
    close_end(leash_);
    forget_known(keeper_);
    waitpid(keeper_, nullptr, 0);
    errno = kept;
    fail_here("pidfd_open (Linux 5.3 or later)");
  }
  int error = 0;
  ssize_t got = 0;
  do got = read(failure.read, &error, sizeof error);
  while (got < 0 && errno == EINTR);
  if (got == static_cast<ssize_t>(sizeof error)) {
    reap(true);
    close_all();
    throw scene::Error(scene::ErrorCode::bad_argument,
                       words[0] + ": " +
                           (error == ENOENT ? "command not found" : std::generic_category().message(error)) +
                           "; give the path of a program that can be executed");
  }
  in_ = Pipe::take(in.write);
  out_ = Pipe::take(out.read);
  err_ = Pipe::take(err.read);
  for (const int descriptor : {in_, out_, err_}) fcntl(descriptor, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  if (keeper_ > 0) reap(true);
  close_all();
}

void ChildProcess::close_all() {
  for (int* descriptor : {&in_, &out_, &err_, &keeper_fd_, &leash_, &report_}) close_end(*descriptor);
}

void ChildProcess::read_errors() {
  read_some(err_, errors_);
  if (errors_.size() > 2 * kept_errors) errors_.erase(0, errors_.size() - kept_errors);
}

// That there is something is of interest, not what it is.
void ChildProcess::read_last() {
  std::string last;
  read_some(out_, last);
  if (read_.empty()) read_ = std::move(last);
}

// Waits for something to happen on the pipes, and does what can be done. False: the deadline is over.
bool ChildProcess::pump(Clock::time_point deadline, std::size_t most_bytes) {
  std::array<pollfd, 4> polled{{{out_, POLLIN, 0}, {err_, POLLIN, 0}, {in_, POLLOUT, 0}, {keeper_fd_, POLLIN, 0}}};
  if (to_write_.empty()) polled[2].fd = -1;
  if (read_.size() > most_bytes) polled[0].fd = -1;  // it floods us; let it wait
  const int ready = poll(polled.data(), polled.size(), milliseconds_until(deadline));
  if (ready < 0) return errno == EINTR;
  if (ready == 0) return Clock::now() < deadline;
  if (polled[1].revents != 0) read_errors();
  if (polled[2].revents != 0) {
    const NoSigpipe guard;
    const auto written = write(in_, to_write_.data(), to_write_.size());
    if (written > 0) {
      to_write_.erase(0, static_cast<std::size_t>(written));
    } else if (written < 0 && errno != EAGAIN && errno != EINTR) {
      close_end(in_);
    }
  }
  if (polled[0].revents != 0) {
    read_some(out_, read_);
  } else if (polled[3].revents != 0 && polled[0].fd >= 0) {
    close_end(out_);  // its keeper has ended: this is not the program that was started
  }
  return true;
}

ChildProcess::Io ChildProcess::write_line(std::string_view line, Clock::time_point deadline) {
  return write_bytes(std::string(line) + "\n", deadline);
}

ChildProcess::Io ChildProcess::write_bytes(std::string_view bytes, Clock::time_point deadline) {
  to_write_.append(bytes);
  while (!to_write_.empty()) {
    if (in_ < 0) return Io::closed;
    if (Clock::now() >= deadline || !pump(deadline, most_unasked)) return Io::late;
  }
  return Io::ok;
}

ChildProcess::Io ChildProcess::read_line(std::string& line, Clock::time_point deadline, std::size_t most_bytes) {
  while (true) {
    const auto end = read_.find('\n');
    if (end != std::string::npos ? end > most_bytes : read_.size() > most_bytes) return Io::too_long;
    if (end != std::string::npos) {
      line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return Io::ok;
    }
    if (out_ < 0) {
      line = std::move(read_);
      read_.clear();
      return Io::closed;
    }
    if (Clock::now() >= deadline || !pump(deadline, most_bytes)) return Io::late;
  }
}

ChildProcess::Io ChildProcess::read_bytes(std::string& bytes, Clock::time_point deadline) {
  while (read_.empty()) {
    if (out_ < 0) return Io::closed;
    if (Clock::now() >= deadline || !pump(deadline, most_unasked)) return Io::late;
  }
  bytes = std::move(read_);
  read_.clear();
  return Io::ok;
}

ChildProcess::End ChildProcess::finish(Clock::time_point deadline) {
  if (keeper_ <= 0) return end_;
  close_end(in_);
  to_write_.clear();
  bool ended = false;
  for (bool late = false; !ended && !late;) {
    late = Clock::now() >= deadline;  // one last look, then
    std::array<pollfd, 3> polled{{{keeper_fd_, POLLIN, 0}, {out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    const int ready = poll(polled.data(), polled.size(), late ? 0 : milliseconds_until(deadline));
    if (ready <= 0) continue;
    if (polled[1].revents != 0) read_last();
    if (polled[2].revents != 0) read_errors();
    ended = polled[0].revents != 0;
  }
  reap(!ended);
  // Its last words may still be in the pipes, which hold no more than this.
  constexpr int most_reads = 64;
  for (int i = 0; i < most_reads && out_ >= 0 && read_.empty(); ++i) read_last();
  std::size_t before = errors_.size() + 1;
  for (int i = 0; i < most_reads && err_ >= 0 && errors_.size() != before; ++i) {
    before = errors_.size();
    read_errors();
  }
  close_all();
  return end_;
}

void ChildProcess::reap(bool killed_here) {
  constexpr int patience_ms = 10000;
  close_end(leash_);
  kill(keeper_, SIGCONT);  // the program may have stopped it
  pollfd ended{keeper_fd_, POLLIN, 0};
  if (poll(&ended, 1, patience_ms) == 0) kill(keeper_, SIGKILL);
  KeeperReport report;
  ssize_t got = 0;
  forget_known(keeper_);  // before its number can belong to another
  while (waitpid(keeper_, nullptr, 0) < 0 && errno == EINTR) continue;
  keeper_ = -1;
  fcntl(report_, F_SETFL, O_NONBLOCK);
  do got = read(report_, &report, sizeof report);
  while (got < 0 && errno == EINTR);
  end_.killed_here = killed_here;
  if (got != static_cast<ssize_t>(sizeof report)) {
    end_.killed_keeper = true;
    kill_orphans();
    return;
  }
  const int status = report.status;
  end_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end_.peak_memory_bytes = static_cast<std::uint64_t>(report.usage.ru_maxrss) * 1024;
}

std::string ChildProcess::stderr_tail() const {
  constexpr std::size_t shown = 800;
  std::string tail = errors_.size() > shown ? errors_.substr(errors_.size() - shown) : errors_;
  while (!tail.empty() && (tail.back() == '\n' || tail.back() == '\r')) tail.pop_back();
  return scene::printable_lines(tail);
}

std::string describe(const ChildProcess::End& end) {
  if (end.killed_here) return "did not end in time and was killed";
  if (end.killed_keeper) return "killed the process that watches it";
  if (end.signal == 0) return fmt::format("ended with exit status {}", end.exit_code);
  return fmt::format("was killed by signal {} ({})", end.signal, strsignal(end.signal));
}

}  // namespace clues::validate
