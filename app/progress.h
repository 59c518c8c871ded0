// How far a long run is, and the time that is left, on standard error: a bar when that is a terminal; a plain line a minute when it is a pipe or a log.
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
  std::chrono::steady_clock::time_point said_ = std::chrono::steady_clock::now();  // elsewhere than on a terminal
  bool terminal_;
};

}  // namespace clues::app
