// What a sewn mesh promises, looked at by comparing exact points.
#pragma once

#include <cstdint>
#include <string>

#include "reference/delta/sewn_mesh.h"

namespace clues::test {

struct SewnFlaws {
  std::uint64_t points_in_sides = 0;     // corners that lie inside of an edge
  std::uint64_t unmatched_edges = 0;     // walked twice the same way within one region, or more than twice
  std::uint64_t reversed_triangles = 0;  // that do not turn as their region does
  std::string text() const;
};

// Corners inside of edges are asked for at the borders of regions only: within a region, the other side of its surface
// may have some. O(n^2).
SewnFlaws flaws_of(const reference::SewnMesh& mesh);

// V - E + F of the triangles of one region.
int euler_characteristic(const reference::SewnMesh& mesh, std::uint64_t region);

}  // namespace clues::test
