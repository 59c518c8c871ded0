// `clues lint` of vectors/motion: every expectation is proved anew. Violations by the reference and by the judge's own loop; `exact` by
// comparison; `sound` must be proved by the judge of bounds, or be what the reference proves while the judge cannot tell; `unsound` must be refuted; the
// reference must not claim more than `sound`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "validate/motion/motion_suite.h"

namespace clues::validate {

struct MotionLintOptions {
  std::string glob = "*";
  bool write = false;   // fill in what is missing, and write the canonical text
  bool accept = false;  // with write: replace expectations that proved wrong
};

struct MotionLintReport {
  std::vector<std::string> findings;  // "file: case 'id': what"
  std::vector<std::string> malformed;
  std::vector<std::string> written;
  std::uint64_t cases = 0, selected = 0, proved = 0;
};

MotionLintReport lint_motion_suite(const std::filesystem::path& folder, const MotionLintOptions& options);
// What one case gets wrong; nothing when it is proved.
std::vector<std::string> flaws_of(const MotionVector& test);
// The expectation, computed; `exact` stays.
void fill_in(MotionVector& test);

std::string to_text(const MotionLintReport& report);
std::string to_json_text(const MotionLintReport& report);  // "clues-motion-lint/1"

}  // namespace clues::validate
