// D25: which cell may come after which on a route.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/cell_spec.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

// Boxes, given by their corners: they touch in a face that is a whole face of both, or one holds the other. Their union
// is convex then, or one of them (hazard A-25: a part of a face is not enough).
bool may_follow(const std::vector<Point>& from, const std::vector<Point>& to);

// For each cell those that may follow, without itself, ascending. Throws Error bad_cell where one is no box. O(n^2).
std::vector<std::vector<std::uint32_t>> neighbours_of(const std::vector<CellSpec>& cells);

// A route of so many steps, to a neighbour at random each time: a pure function of its arguments. It ends early in a
// cell without neighbours.
std::vector<std::uint32_t> random_route(const std::vector<std::vector<std::uint32_t>>& neighbours, std::uint64_t steps,
                                        std::uint64_t seed, std::uint32_t first = 0);

}  // namespace clues::scene
