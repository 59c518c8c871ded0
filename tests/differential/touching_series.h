// The series of scenes that CellsOfEveryDimension puts to the judge; a planted version has to fail the limited one.
#pragma once

#include <cstdint>

#include "tests/differential/series.h"

namespace clues::tests {

inline constexpr std::uint64_t kTouchingSeed = 20261122;

// Scene n of those whose geometry meets the cell: the generators by turns.
fuzz::Case touching_scene(std::uint64_t seed, std::uint64_t n);

// D17: limits turned down in every scene, so that fallbacks are common; other dials in some. The refinements of both kernels are asked in one scene of
// four. One scene of nine is no touching one, but a triangle of which only a tip is visible, and only by wedges of a CSV, which are
// left out: whoever takes one sample for the label of its side loses it.
Series limited_series();

}  // namespace clues::tests
