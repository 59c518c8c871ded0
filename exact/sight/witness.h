// The witness checker: is (v,p) a free sight line (D5) that proves triangle t visible (D6)? Plain rationals (mpq), side
// products of Pluecker coordinates, one pass over all triangles: no tree, no filter, nothing shared with the algorithms
// whose answers it checks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh/mesh.h"

namespace clues::exact {

struct WitnessVerdict {
  bool valid = false;
  std::string reason;  // when not valid: which condition fails, and the triangle that blocks
  bool special =
      false;  // not valid, but free (D5): v or p is touched by a triangle, and proves nothing of what is beside it
};

// p must lie in the relative interior of triangle t of the mesh, v in int V, and the open segment (v,p) must
// miss S (D3, D5: touching blocks): every triangle with area, without what lies inside a solid cell. `front`:
// p is asked for on the front side (right-hand rule), else on the back; v must lie strictly on that side. A
// triangle that meets V needs no witness (D3). O(n).
//
// One free segment proves D6, which asks for an open part of int V and for an area of t, by two more
// conditions:
//   - no triangle of another plane touches t at p. Then all points of t around p are seen from v, not a line
//     or point between others that stand on t;
//   - on a flat cell or a segment, no triangle holds v, but as plain_sight.h allows. Then all of int V near v
//     sees p as v does, not a line or point of V between others that stand on it. In a solid cell v has int V
//     on all sides, and what is in there blocks nothing; a point is all of its V.
// Together: (v',p') is free for all v' of int V near v and all p' of t near p. For S is closed in every
// dimension. A solid cell: S is the triangles without the open set int V, and (v,p) leaves int V at one
// point; (v',p') leaves it near there. Other cells: S is the triangles, and (v,p) is free from v on.
WitnessVerdict check_witness(const scene::TriangleMesh& mesh, const ConvexCell& cell, std::uint32_t triangle,
                             bool front, const Point3& v, const Point3& p);

struct SightLine {
  bool valid = false;  // v in int V, p != v
  std::vector<std::uint32_t>
      blockers;  // the triangles that meet the open segment (v,p) in S, ascending; free (D5): none
  std::optional<std::uint32_t> spoiler;  // it holds v, so that points of int V near v need not see p (plain_sight.h)
};

// D5 for any point p, on surfaces or not, by the same means. O(n).
SightLine check_sight_line(const scene::TriangleMesh& mesh, const ConvexCell& cell, const Point3& v, const Point3& p);

}  // namespace clues::exact
