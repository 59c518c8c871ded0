// Puts the cases of vectors/motion to a program: one line of JSON a question, one line an answer, "clues-motion-question/1" and
// "clues-motion-answer/1" (docs/motion.md). And the other side of it, which answers with the reference.
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "validate/motion/motion_suite.h"

namespace clues::validate {

// sound: no bound is refuted; unsound: one is; undecided; failed: no answer that can be read.
enum class MotionGrade : std::uint8_t { sound, unsound, undecided, failed };

struct MotionResult {
  std::string id;
  MotionGrade grade = MotionGrade::failed;
  std::string what;      // failed, unsound: why
  double tightness = 0;  // mean over the triangles of min(1, bound / what is known to be sound), where that is not 0
  std::uint64_t weighed = 0;  // such triangles
};

struct MotionConformReport {
  std::vector<MotionResult> results;
  std::uint64_t sound = 0, unsound = 0, undecided = 0, failed = 0;
  double tightness = 0;  // over all triangles of sound cases
};

struct MotionConformOptions {
  std::string glob = "*";
  std::chrono::milliseconds time{10'000};  // for one answer
};

// The program is started once and anew after each failure. Throws Error bad_argument when it cannot be started.
MotionConformReport conform_motion(const std::vector<MotionVector>& cases, const std::vector<std::string>& command,
                                   const MotionConformOptions& options);

std::string question_of(const MotionVector& test);  // one line, without its end
// The bounds in an answer to `test`. Throws scene::Error malformed.
std::vector<double> parse_motion_answer(const std::string& line, const MotionVector& test);
MotionResult graded(const MotionVector& test, const std::vector<double>& bounds);

// Answers questions, one a line, until the end of `in`, with the bounds of the reference.
void answer_motion_questions(std::istream& in, std::ostream& out);

std::string to_text(const MotionConformReport& report, bool all);
std::string to_json_text(const MotionConformReport& report);  // "clues-motion-conform/1"

}  // namespace clues::validate
