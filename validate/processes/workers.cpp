// fork, and one socket to each child: tasks go down, frames of kind, size and text come up.
#include "validate/processes/workers.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>

#include "scene/messages/error.h"
#include "validate/processes/keeper.h"

namespace clues::validate {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int slack = 10;  // so many times the processor time on the clock

[[noreturn]] void fail(const char* what) {
  throw scene::Error(scene::ErrorCode::file_unreadable, std::string(what) + ": " + std::strerror(errno));
}

bool read_all(int fd, void* data, std::size_t size) {
  for (auto* at = static_cast<char*>(data); size > 0;) {
    const ssize_t n = read(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

// The other end may be dead: then no signal, but false.
bool send_all(int fd, const void* data, std::size_t size) {
  for (const auto* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t n = send(fd, at, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

std::chrono::nanoseconds processor_time(pid_t process) {
  clockid_t clock{};
  timespec now{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &now) != 0) return {};  // it ended
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

struct Frame {
  std::uint64_t finished = 0, bytes = 0;
};

}  // namespace

struct Workers::Worker {
  pid_t pid = -1;
  int socket = -1;
  std::optional<std::uint64_t> task;
  Clock::time_point deadline;
  std::chrono::nanoseconds spent{0};  // processor time when the task began
  std::string received;
};

Workers::Workers(int count, std::function<std::string(std::uint64_t)> work,
                 std::optional<std::chrono::seconds> time_for_one)
    : work_(std::move(work)), time_(time_for_one) {
  for (int i = 0; i < count; ++i) {
    workers_.push_back(std::make_unique<Worker>());
    launch(*workers_.back());
  }
}

Workers::~Workers() {
  for (const auto& w : workers_) {
    if (w->pid <= 0) continue;
    kill(w->pid, SIGKILL);
    forget_known(w->pid);
    waitpid(w->pid, nullptr, 0);
    close(w->socket);
  }
}

void Workers::launch(Worker& worker) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail("a child process: no socket");
  const pid_t parent = getpid();
  const pid_t pid = fork_known();
  if (pid < 0) fail("a child process: cannot be started");
  if (pid == 0) {
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    close(ends[0]);
    for (std::uint64_t task = 0; read_all(ends[1], &task, sizeof task);) {
      std::string text;
      Frame frame{1, 0};
      try {
        text = work_(task);
      } catch (const std::exception& error) {
        text = error.what();
        frame.finished = 0;
      }
      frame.bytes = text.size();
      if (!send_all(ends[1], &frame, sizeof frame) || !send_all(ends[1], text.data(), text.size())) _exit(1);
    }
    _exit(0);
  }
  close(ends[1]);
  worker.pid = pid;
  worker.socket = ends[0];
  worker.received.clear();
  worker.task.reset();
}

bool Workers::idle() const {
  for (const auto& w : workers_) {
    if (!w->task) return true;
  }
  return false;
}

bool Workers::empty() const {
  for (const auto& w : workers_) {
    if (w->task) return false;
  }
  return true;
}

void Workers::start(std::uint64_t task) {
  for (const auto& w : workers_) {
    if (w->task) continue;
    w->task = task;
    w->deadline = time_ ? Clock::now() + slack * *time_ : Clock::time_point::max();
    w->spent = processor_time(w->pid);
    send_all(w->socket, &task, sizeof task);  // a dead worker is noticed when its reply is read
    return;
  }
}

WorkerReply Workers::lost(Worker& worker, bool late) {
  const auto spent = processor_time(worker.pid) - worker.spent;
  kill(worker.pid, SIGKILL);
  int status = 0;
  forget_known(worker.pid);
  waitpid(worker.pid, &status, 0);
  close(worker.socket);
  WorkerReply reply{*worker.task, false, {}, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
  if (late && spent >= *time_) {
    reply.text = "no end within " + std::to_string(time_->count()) + " s of processor time";
  } else if (late) {  // it waits for something, or was stopped
    reply.text = "no end within " + std::to_string((slack * *time_).count()) + " s, and less than " +
                 std::to_string(time_->count()) + " s of processor time";
  } else if (WIFSIGNALED(status)) {
    reply.text = "killed by signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
  } else {
    reply.text = "ended with exit code " + std::to_string(WEXITSTATUS(status));
  }
  launch(worker);
  return reply;
}

std::optional<WorkerReply> Workers::wait(std::chrono::milliseconds most) {
  std::vector<pollfd> fds;
  std::vector<Worker*> busy;
  for (const auto& w : workers_) {
    if (!w->task) continue;
    if (time_ && (Clock::now() >= w->deadline || processor_time(w->pid) - w->spent >= *time_)) return lost(*w, true);
    fds.push_back({w->socket, POLLIN, 0});
    busy.push_back(w.get());
  }
  if (poll(fds.data(), fds.size(), static_cast<int>(most.count())) <= 0) return std::nullopt;
  for (std::size_t i = 0; i < fds.size(); ++i) {
    if (fds[i].revents == 0) continue;
    Worker& w = *busy[i];
    char buffer[65536];
    const ssize_t n = read(w.socket, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno != ECONNRESET) fail("a child process: cannot be read");
    if (n <= 0) return lost(w, false);
    w.received.append(buffer, static_cast<std::size_t>(n));
    Frame frame;
    if (w.received.size() < sizeof frame) continue;
    std::memcpy(&frame, w.received.data(), sizeof frame);
    if (w.received.size() < sizeof frame + frame.bytes) continue;
    WorkerReply reply{*w.task, frame.finished == 1, w.received.substr(sizeof frame), 0};
    w.received.clear();
    w.task.reset();
    return reply;
  }
  return std::nullopt;
}

}  // namespace clues::validate
