// T15: which triangles solids hide from a cell.
//
// A sight line that leaves the cell through a facet and ends on a triangle is in the shaft between them. Where a plane cuts the shaft, and the solids that the plane cuts cover all of that, no line in it is
// free. Where no such plane is found the shaft is cut in two, at the facet or at the triangle, until it is, or too often.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/solids/solids.h"
#include "fastpath/solids/targets.h"

namespace clues::fastpath::solids {

// Ids of targets that are not proved to be hidden, ascending: whatever is visible from the cell is among them. By one thread; several may ask at once. The same whatever was asked before.
std::vector<std::uint32_t> not_hidden(const Solids& solids, const Targets& targets, const std::vector<Point>& cell);

}  // namespace clues::fastpath::solids
