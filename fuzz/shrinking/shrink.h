// Makes a finding small: fewer triangles (delta debugging), fewer points of the cell, shorter coordinates. The signature stays the same, the witness is
// derived again at every step. Deterministic, unless the time limit ends it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "fuzz/findings/finding.h"
#include "fuzz/subjects/subject.h"

namespace clues::fuzz {

struct ShrinkLimits {
  std::uint64_t steps = 600;  // scenes put to the subject
  std::chrono::milliseconds time{60000};
};

struct Shrunk {
  Finding finding;
  std::uint64_t steps = 0;
};

Shrunk shrink(const Finding& finding, const Subject& subject, const ShrinkLimits& limits = {});

// Whether the finding shows itself again in another scene `candidate`, and how. Its witness is tried first (with the same position on its
// triangle); where that does not do, its oracle is asked again.
std::optional<Finding> found_again(const Finding& finding, const Case& candidate, const Subject& subject);

// Verifies a finding as it stands: the witness is confirmed by exact/sight/witness.h and the subject denies what it proves; without a witness, its oracle
// finds the same again. An empty text, or what is wrong. Throws NoAnswer.
std::string flaw_of(const Finding& finding, const Subject& subject);

}  // namespace clues::fuzz
