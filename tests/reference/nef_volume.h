// What CGAL's Nef polyhedra say of umbrae. They know nothing of wedges, and take much memory to compile: so they are alone behind this header.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

namespace clues::test {

using Corner = std::array<mpq_class, 3>;

// The volume of all that any of the convex blockers hides from every vertex of the cell, within |x|, |y| <= 6, -1 <= z <= 6.
mpq_class hidden_volume(const std::vector<std::vector<Corner>>& blockers, const std::vector<Corner>& cell);

}  // namespace clues::test
