// On a terminal one line, rewritten in place when the text changes; elsewhere a line a minute, so that who reads the log of a long run knows how far it is.
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

namespace clues::app {

ProgressBar::ProgressBar(std::string title) : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
  if (!last_.empty()) std::fputs("\r\033[K", stderr);
  last_.clear();
}

void ProgressBar::show(const std::string& stage, std::uint64_t done, std::uint64_t total) {
  using Clock = std::chrono::steady_clock;
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    began_ = now;
    done_before_ = done;
  }
  std::string so_far = total > 0 ? fmt::format("{} {}/{}", stage, done, total) : fmt::format("{} {}", stage, done);
  const double spent = std::chrono::duration<double>(now - began_).count();
  if (done > done_before_ && done < total && spent > 2) {
    const auto left = static_cast<std::uint64_t>(spent * static_cast<double>(total - done) /
                                                 static_cast<double>(done - done_before_));
    so_far += fmt::format(", about {}:{:02} left", left / 60, left % 60);
  }
  if (!terminal_) {
    if (now - said_ < std::chrono::minutes(1)) return;
    said_ = now;
    std::fprintf(stderr, "%s: %s\n", title_.c_str(), so_far.c_str());
    return;
  }
  constexpr std::uint64_t width = 24;
  const std::uint64_t filled = total == 0 ? 0 : std::min(width, width * done / total);
  std::string line =
      fmt::format("{} [{}{}] {}", title_, std::string(filled, '#'), std::string(width - filled, '.'), so_far);
  if (line == last_) return;
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
  last_ = std::move(line);
}

}  // namespace clues::app
