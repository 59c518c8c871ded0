// The subject "motion": motion bounds (D29) and walks (D30), judged by exact predicates.
#pragma once

#include <functional>
#include <memory>

#include "fuzz/motion/motion_cases.h"
#include "fuzz/trials/trial.h"

namespace clues::fuzz {

// One bound for each triangle of a case.
using BoundsMaker = std::function<std::vector<double>(const MotionCase& test)>;

// Of the reference's bounds and the fast path's, and of the fast path's walks.
std::unique_ptr<Trial> make_motion_trial();
// Of bounds that are not ours, in place of the fast path's: tests plant mistakes so.
std::unique_ptr<Trial> make_motion_trial(BoundsMaker fast);

}  // namespace clues::fuzz
