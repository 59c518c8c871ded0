// A subreaper: the kernel hands it every descendant that loses its parent. So to kill its children until none is left kills them all.
#include "validate/processes/keeper.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>

#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"

namespace clues::validate {
namespace {

[[noreturn]] void become(char* const* words, const Wiring& wiring, std::uint64_t memory_bytes, pid_t keeper) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != keeper) _exit(127);
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &usual, nullptr);
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

void close_from_to(unsigned first, unsigned last) {
  if (first > last || syscall(SYS_close_range, first, last, 0) == 0) return;
  constexpr unsigned most = 65536;  // a kernel before 5.9
  for (unsigned descriptor = first; descriptor <= std::min(last, most); ++descriptor)
    close(static_cast<int>(descriptor));
}

// The ends of other programs' pipes that the caller has open, among others.
void close_all_but(std::array<int, 6> kept) {
  std::sort(kept.begin(), kept.end());
  unsigned next = 0;
  for (const int descriptor : kept) {
    const auto d = static_cast<unsigned>(descriptor);
    if (d > next) close_from_to(next, d - 1);
    next = d + 1;
  }
  close_from_to(next, ~0U);
}

// With all of its process group where that is of a session of its own: a chain of processes that fork and exit is killed
// at once, and nobody joins a group of another session.
void kill_with_group(pid_t pid) {
  const pid_t group = getpgid(pid), session = getsid(pid);
  if (group > 0 && session > 0 && session != getsid(0)) kill(-group, SIGKILL);
  kill(pid, SIGKILL);
}

// SIGKILL to every child of this process, which has one thread. False: the kernel does not say who they are.
bool kill_children() {
  const int list = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  if (list < 0) return errno != ENOENT;
  std::array<char, 4096> text;
  pid_t pid = 0;
  for (ssize_t got = 0; (got = read(list, text.data(), text.size())) > 0;) {
    for (ssize_t i = 0; i < got; ++i) {
      const char c = text[static_cast<std::size_t>(i)];
      if (c >= '0' && c <= '9') {
        pid = pid * 10 + (c - '0');
      } else if (pid > 0) {
        kill_with_group(pid);
        pid = 0;
      }
    }
  }
  if (pid > 0) kill_with_group(pid);
  close(list);
  return true;
}

// Until none is left: a child that dies hands its own children over. One that forks faster than it can be killed wins in the end.
void kill_descendants() {
  constexpr std::time_t most_seconds = 5;
  timespec begin{}, now{};
  clock_gettime(CLOCK_MONOTONIC, &begin);
  for (now = begin; now.tv_sec - begin.tv_sec < most_seconds; clock_gettime(CLOCK_MONOTONIC, &now)) {
    const bool known = kill_children();
    pid_t ended = 0;
    do ended = waitpid(-1, nullptr, known ? 0 : WNOHANG);
    while (ended < 0 && errno == EINTR);
    if (ended < 0 || (!known && ended == 0)) return;
  }
}

std::mutex& known_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::set<pid_t>& known_children() {
  static std::set<pid_t> known;
  return known;
}

}  // namespace

void keep(char* const* words, const Wiring& wiring, std::uint64_t memory_bytes) {
  setpgid(0, 0);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_DUMPABLE, 0);  // so that the program cannot open the keeper's pipes in /proc
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_SETMASK, &all, nullptr);  // what it starts may signal it
  close_all_but({wiring.in, wiring.out, wiring.err, wiring.failure, wiring.leash, wiring.report});
  const pid_t self = getpid(), program = _Fork();
  if (program == 0) become(words, wiring, memory_bytes, self);
  if (program < 0) {
    const int error = errno;
    if (write(wiring.failure, &error, sizeof error) < 0) _exit(126);
    _exit(127);
  }
  for (const int descriptor : {wiring.in, wiring.out, wiring.err, wiring.failure}) close(descriptor);
  const int program_fd = static_cast<int>(syscall(SYS_pidfd_open, program, 0));
  std::array<pollfd, 2> polled{{{program_fd, POLLIN, 0}, {wiring.leash, POLLIN, 0}}};
  while (poll(polled.data(), polled.size(), -1) < 0 && errno == EINTR) continue;
  if (polled[0].revents == 0) kill(program, SIGKILL);
  KeeperReport report;
  while (wait4(program, &report.status, 0, &report.usage) < 0 && errno == EINTR) continue;
  kill(-program, SIGKILL);
  kill_descendants();
  if (write(wiring.report, &report, sizeof report) < 0) _exit(1);
  _exit(0);
}

void adopt_orphans() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

pid_t fork_known() {
  const std::lock_guard lock(known_mutex());
  const pid_t pid = fork();
  if (pid > 0) known_children().insert(pid);
  return pid;
}

void forget_known(pid_t pid) {
  const std::lock_guard lock(known_mutex());
  known_children().erase(pid);
}

void kill_orphans() {
  const std::lock_guard lock(known_mutex());
  constexpr int most_rounds = 1000, empty_rounds = 20;
  // A child of an orphan that ends is between two parents for a moment, and seen in the next round.
  for (int round = 0, empty = 0; empty < empty_rounds && round < most_rounds; ++round) {
    bool any = false;
    std::error_code ignored;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", ignored)) {
      std::string text;
      try {
        text = scene::read_file_bytes(thread.path() / "children");
      } catch (const scene::Error&) {
        continue;  // it ended
      }
      for (const char *at = text.data(), *const end = at + text.size(); at != end;) {
        pid_t pid = 0;
        const auto number = std::from_chars(at, end, pid);
        at = number.ptr == at ? at + 1 : number.ptr;
        if (pid <= 0 || known_children().contains(pid)) continue;
        kill_with_group(pid);
        any = waitpid(pid, nullptr, 0) == pid || any;
      }
    }
    if (any) {
      empty = 0;
    } else {
      ++empty;
      usleep(1000);
    }
  }
}

}  // namespace clues::validate
