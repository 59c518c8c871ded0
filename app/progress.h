// A progress bar on standard error, with the time that is left: only when that is a terminal, so that a pipe or a log never sees it.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace clues::app {

class ProgressBar {
 public:
  explicit ProgressBar(std::string title);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void clear();  // wipes the line, before something else is printed
  void show(const std::string& stage, std::uint64_t done, std::uint64_t total);

 private:
  std::string title_;
  std::string last_;  // what stands there now
  std::string
      stage_;  // the running stage, when it was first shown, and how much was done then: for the time that is left
  std::chrono::steady_clock::time_point began_;
  std::uint64_t done_before_ = 0;
  bool terminal_;
};

}  // namespace clues::app
