// fork, exec, poll. Between fork and exec the child only makes system calls: other threads may have held any lock.
#include "validate/conform/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "scene/error.h"

namespace clues::validate {
namespace {

constexpr std::size_t kept_errors = 4096;
constexpr std::size_t most_unasked = 1 << 20;  // read while it has not even been asked

[[noreturn]] void fail_here(const char* what) {
  throw std::system_error(errno, std::generic_category(), std::string("cannot start a program: ") + what);
}

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail_here("pipe");
    read = ends[0];
    write = ends[1];
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

struct Wiring {
  int in, out, err, failure;
};

[[noreturn]] void become(char* const* words, const Wiring& wiring, std::uint64_t memory_bytes) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  sigaction(SIGPIPE, &usual, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (memory_bytes > 0) {
    const rlimit memory{memory_bytes, memory_bytes};
    setrlimit(RLIMIT_AS, &memory);
  }
  if (dup2(wiring.in, STDIN_FILENO) >= 0 && dup2(wiring.out, STDOUT_FILENO) >= 0 &&
      dup2(wiring.err, STDERR_FILENO) >= 0) {
    execvp(words[0], words);
  }
  const int error = errno;
  if (write(wiring.failure, &error, sizeof error) < 0) _exit(126);
  _exit(127);
}

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
  Pipe in, out, err, failure;
  pid_ = fork();
  if (pid_ < 0) fail_here("fork");
  if (pid_ == 0) become(raw.data(), {in.read, out.write, err.write, failure.write}, memory_bytes);
  setpgid(pid_, pid_);  // whichever of the two comes first
  close_end(failure.write);
  int error = 0;
  ssize_t got = 0;
  do got = read(failure.read, &error, sizeof error);
  while (got < 0 && errno == EINTR);
  if (got == static_cast<ssize_t>(sizeof error)) {
    waitpid(pid_, nullptr, 0);
    throw scene::Error(scene::ErrorCode::bad_argument,
                       words[0] + ": " +
                           (error == ENOENT ? "command not found" : std::generic_category().message(error)) +
                           "; give the path of a program that can be executed");
  }
  pid_fd_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  if (pid_fd_ < 0) {
    const int kept = errno;
    kill(-pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    errno = kept;
    fail_here("pidfd_open (Linux 5.3 or later)");
  }
  in_ = Pipe::take(in.write);
  out_ = Pipe::take(out.read);
  err_ = Pipe::take(err.read);
  for (const int descriptor : {in_, out_, err_}) fcntl(descriptor, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) reap(true);
  close_all();
}

void ChildProcess::close_all() {
  for (int* descriptor : {&in_, &out_, &err_, &pid_fd_}) close_end(*descriptor);
}

// Waits for something to happen on the pipes, and does what can be done. False: the deadline is over.
bool ChildProcess::pump(Clock::time_point deadline, std::size_t most_bytes) {
  std::array<pollfd, 3> polled{{{out_, POLLIN, 0}, {err_, POLLIN, 0}, {in_, POLLOUT, 0}}};
  if (to_write_.empty()) polled[2].fd = -1;
  if (read_.size() > most_bytes) polled[0].fd = -1;  // it floods us; let it wait
  const int ready = poll(polled.data(), polled.size(), milliseconds_until(deadline));
  if (ready < 0) return errno == EINTR;
  if (ready == 0) return Clock::now() < deadline;
  if (polled[1].revents != 0) {
    read_some(err_, errors_);
    if (errors_.size() > 2 * kept_errors) errors_.erase(0, errors_.size() - kept_errors);
  }
  if (polled[2].revents != 0) {
    const NoSigpipe guard;
    const auto written = write(in_, to_write_.data(), to_write_.size());
    if (written > 0) {
      to_write_.erase(0, static_cast<std::size_t>(written));
    } else if (written < 0 && errno != EAGAIN && errno != EINTR) {
      close_end(in_);
    }
  }
  if (polled[0].revents != 0) read_some(out_, read_);
  return true;
}

ChildProcess::Io ChildProcess::write_line(std::string_view line, Clock::time_point deadline) {
  to_write_.append(line).push_back('\n');
  while (!to_write_.empty()) {
    if (in_ < 0) return Io::closed;
    if (!pump(deadline, most_unasked)) return Io::late;
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
    if (!pump(deadline, most_bytes)) return Io::late;
  }
}

ChildProcess::End ChildProcess::finish(Clock::time_point deadline) {
  if (pid_ <= 0) return end_;
  close_end(in_);
  to_write_.clear();
  bool ended = false;
  while (!ended) {
    std::array<pollfd, 3> polled{{{pid_fd_, POLLIN, 0}, {out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    const int ready = poll(polled.data(), polled.size(), milliseconds_until(deadline));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0 && Clock::now() < deadline) continue;
    if (ready <= 0) break;
    std::string ignored;
    if (polled[1].revents != 0) read_some(out_, ignored);
    if (polled[2].revents != 0) read_some(err_, errors_);
    if (errors_.size() > 2 * kept_errors) errors_.erase(0, errors_.size() - kept_errors);
    ended = polled[0].revents != 0;
  }
  reap(!ended);
  // Its last words may still be in the pipe; whoever else holds the other end is dead now.
  for (std::size_t before = errors_.size() + 1; err_ >= 0 && errors_.size() != before;) {
    before = errors_.size();
    read_some(err_, errors_);
  }
  close_all();
  return end_;
}

void ChildProcess::reap(bool killed_here) {
  kill(-pid_, SIGKILL);
  if (killed_here) kill(pid_, SIGKILL);  // it may have left its group
  int status = 0;
  rusage usage{};
  while (wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) continue;
  end_.killed_here = killed_here;
  end_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end_.peak_memory_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  pid_ = -1;
}

std::string ChildProcess::stderr_tail() const {
  constexpr std::size_t shown = 800;
  std::string tail = errors_.size() > shown ? errors_.substr(errors_.size() - shown) : errors_;
  while (!tail.empty() && (tail.back() == '\n' || tail.back() == '\r')) tail.pop_back();
  for (char& c : tail) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\t') || byte >= 0x7f) c = '?';
  }
  return tail;
}

std::string describe(const ChildProcess::End& end) {
  if (end.killed_here) return "did not end in time and was killed";
  if (end.signal == 0) return fmt::format("ended with exit status {}", end.exit_code);
  return fmt::format("was killed by signal {} ({})", end.signal, strsignal(end.signal));
}

}  // namespace clues::validate
