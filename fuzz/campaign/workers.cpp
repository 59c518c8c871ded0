#include "fuzz/campaign/workers.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/error.h"

namespace clues::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const char* what) {
  throw scene::Error(scene::ErrorCode::internal, std::string(what) + ": " + std::strerror(errno));
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

bool write_all(int fd, const void* data, std::size_t size) {
  for (const auto* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t n = write(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

struct Workers::Worker {
  pid_t pid = -1;
  int to = -1, from = -1;
  std::optional<std::uint64_t> job;
  Clock::time_point deadline;
  std::string received;
};

Workers::Workers(int count, std::function<std::string(std::uint64_t)> work, std::chrono::seconds time_for_one)
    : work_(std::move(work)), time_(time_for_one) {
  signal(SIGPIPE, SIG_IGN);  // a worker may die while a job is written to it
  for (int i = 0; i < count; ++i) {
    workers_.push_back(std::make_unique<Worker>());
    launch(*workers_.back());
  }
}

Workers::~Workers() {
  for (const auto& w : workers_) {
    if (w->pid <= 0) continue;
    kill(w->pid, SIGKILL);
    waitpid(w->pid, nullptr, 0);
    close(w->to);
    close(w->from);
  }
}

void Workers::launch(Worker& worker) {
  int down[2], up[2];
  if (pipe2(down, O_CLOEXEC) != 0 || pipe2(up, O_CLOEXEC) != 0) fail("pipe");
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) fail("fork");
  if (pid == 0) {
    // Ctrl-C and `timeout` are for the campaign, which lets us finish.
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    signal(SIGPIPE, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    close(down[1]);
    close(up[0]);
    for (std::uint64_t job = 0; read_all(down[0], &job, sizeof job);) {
      std::string text;
      try {
        text = work_(job);
      } catch (...) {
        abort();
      }
      const std::uint64_t size = text.size();
      if (!write_all(up[1], &size, sizeof size) || !write_all(up[1], text.data(), size)) _exit(1);
    }
    _exit(0);
  }
  close(down[0]);
  close(up[1]);
  worker.pid = pid;
  worker.to = down[1];
  worker.from = up[0];
  worker.received.clear();
  worker.job.reset();
}

bool Workers::idle() const {
  for (const auto& w : workers_) {
    if (!w->job) return true;
  }
  return false;
}

bool Workers::empty() const {
  for (const auto& w : workers_) {
    if (w->job) return false;
  }
  return true;
}

void Workers::start(std::uint64_t job) {
  for (const auto& w : workers_) {
    if (w->job) continue;
    w->job = job;
    w->deadline = Clock::now() + time_;
    write_all(w->to, &job, sizeof job);  // a dead worker is noticed when its reply is read
    return;
  }
}

WorkerReply Workers::lost(Worker& worker, bool late) {
  kill(worker.pid, SIGKILL);
  int status = 0;
  waitpid(worker.pid, &status, 0);
  close(worker.to);
  close(worker.from);
  WorkerReply reply{*worker.job, std::nullopt, {}};
  if (late) {
    reply.failure = "no end within " + std::to_string(time_.count()) + " s";
  } else if (WIFSIGNALED(status)) {
    reply.failure = std::string("killed by signal ") + strsignal(WTERMSIG(status));
  } else {
    reply.failure = "ended with exit code " + std::to_string(WEXITSTATUS(status));
  }
  launch(worker);
  return reply;
}

std::optional<WorkerReply> Workers::wait(std::chrono::milliseconds most) {
  std::vector<pollfd> fds;
  std::vector<Worker*> busy;
  for (const auto& w : workers_) {
    if (!w->job) continue;
    if (Clock::now() >= w->deadline) return lost(*w, true);
    fds.push_back({w->from, POLLIN, 0});
    busy.push_back(w.get());
  }
  if (poll(fds.data(), fds.size(), static_cast<int>(most.count())) <= 0) return std::nullopt;
  for (std::size_t i = 0; i < fds.size(); ++i) {
    if (fds[i].revents == 0) continue;
    Worker& w = *busy[i];
    char buffer[65536];
    const ssize_t n = read(w.from, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return lost(w, false);
    w.received.append(buffer, static_cast<std::size_t>(n));
    std::uint64_t size = 0;
    if (w.received.size() < sizeof size) continue;
    std::memcpy(&size, w.received.data(), sizeof size);
    if (w.received.size() < sizeof size + size) continue;
    WorkerReply reply{*w.job, w.received.substr(sizeof size), {}};
    w.received.clear();
    w.job.reset();
    return reply;
  }
  return std::nullopt;
}

}  // namespace clues::fuzz
