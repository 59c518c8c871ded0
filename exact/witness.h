// The witness checker: is (v,p) a free sight line (D5) that proves triangle t visible (D6)? Plain rationals (mpq), side
// products of Pluecker coordinates, one pass over all triangles: no tree, no filter, nothing shared with the algorithms
// whose answers it checks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exact/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh.h"

namespace clues::exact {

struct WitnessVerdict {
  bool valid = false;
  std::string reason;  // when not valid: which condition fails, and the triangle that blocks
};

// p must lie in the relative interior of triangle t of the mesh, v in int V, and the open segment (v,p) must miss every
// non-degenerate triangle's points outside int V (D3, D5: touching blocks). No triangle of another plane may touch t at p: then free sight lines
// near (v,p) reach points all around p, and t is visible with an area, not in a line or point between others that stand on it. `front`: p is asked for on the front side (right-hand rule), else
// on the back; v must lie strictly on that side. A triangle that meets V needs no witness (D3). O(n).
WitnessVerdict check_witness(const scene::TriangleMesh& mesh, const ConvexCell& cell, std::uint32_t triangle,
                             bool front, const Point3& v, const Point3& p);

struct SightLine {
  bool valid = false;  // v in int V, p != v
  std::vector<std::uint32_t>
      blockers;  // the triangles that meet the open segment (v,p) outside int V, ascending; free (D5): none
};

// D5 for any point p, on surfaces or not, by the same means. O(n).
SightLine check_sight_line(const scene::TriangleMesh& mesh, const ConvexCell& cell, const Point3& v, const Point3& p);

}  // namespace clues::exact
