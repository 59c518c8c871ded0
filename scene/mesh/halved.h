// One way to put neighbouring cells together: halves across the longest side of the box around them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh/bounds.h"

namespace clues::scene {

// Around some of the boxes, one or more.
Bounds bounds_around(std::span<const std::uint32_t> some, const std::vector<Bounds>& boxes);

// Puts those whose middles are lower along the longest side of the box around them before the others, and says how many they are: half of them, rounded down. Equal middles stand in the
// order of numbers, so that it is the same in every run. O(n).
std::size_t halve(std::span<std::uint32_t> some, const std::vector<Bounds>& boxes);

}  // namespace clues::scene
