// Draws only when the text changes; one line, rewritten in place.
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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
  if (!terminal_) return;
  constexpr std::uint64_t width = 24;
  const std::uint64_t filled = total == 0 ? 0 : std::min(width, width * done / total);
  std::string line = fmt::format("{} [{}{}] {} {}/{}", title_, std::string(filled, '#'),
                                 std::string(width - filled, '.'), stage, done, total);
  if (line == last_) return;
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
  last_ = std::move(line);
}

}  // namespace clues::app
