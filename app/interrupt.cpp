#include "app/interrupt.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>

namespace clues::app {
namespace {

// The only way a signal handler has to tell.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// What is begun may take minutes: without a word the program seems to hang. write() is one of the few calls that a handler may make.
constexpr std::string_view word =
    "\nclues: interrupted: finishing what is begun; once more, and that is lost, and the program ends at once\n";

void on_interrupt(int) {
  const int before = errno;
  interrupted.store(true);
  [[maybe_unused]] const auto written = write(STDERR_FILENO, word.data(), word.size());
  errno = before;
}

}  // namespace

const std::atomic<bool>& catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return interrupted;
}

}  // namespace clues::app
