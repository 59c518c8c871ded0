// `clues lint` of vectors/motion: every expectation is proved anew. Violations by the reference and by the judge's own loop; `exact` by
// comparison; `sound` must be proved by the judge of bounds, or be what the reference proves while the judge cannot tell; `unsound` must be refuted; the
// reference must not claim more than `sound`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validate/motion/motion_suite.h"
#include "validate/vectors/side_lint.h"

namespace clues::validate {

SideLintReport lint_motion_suite(const std::filesystem::path& folder, const SideLintOptions& options);
// What one case gets wrong; nothing when it is proved.
std::vector<std::string> flaws_of(const MotionVector& test);
// The expectation, computed; `exact` stays.
void fill_in(MotionVector& test);

}  // namespace clues::validate
