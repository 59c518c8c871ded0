// D18, the certificate of *first-order visible*: a finite chain of points, each on a free continuation (D8) of a sight line through the
// one before. It proves that a triangle is in Omega (D9) and, for a PVS, that the first-order method is right to list it. The checker uses plain
// rationals (exact/sight/plain_sight.h) and nothing of the reference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh/mesh.h"

namespace clues::validate {

// (v, x) with v in int V. The first link is a free sight line from v to x; for each other link x lies on the ray from v through the
// x of the link before, beyond that, and the way between them is free.
struct ChainLink {
  exact::Point3 v, x;
};

struct Chain {
  std::uint32_t triangle = 0;
  bool front = true;  // the last x is on this side of the triangle
  std::vector<ChainLink> links;
};

struct ChainVerdict {
  bool valid = false;
  std::string reason;  // when not valid: which link, and what is wrong with it
};

// Every x but the last must be in free space outside V; the last must be in the relative interior of the triangle, reached on the given side, where no triangle
// of another plane touches. Touching blocks (D5). The v of the first link is one that a witness may have
// (exact/sight/witness.h): only so is the first x in E (D6). On a flat cell or a segment the other v may lie on
// triangles; what is between v and the x before does not matter to a continuation. O(links x triangles).
ChainVerdict check_chain(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Chain& chain);

}  // namespace clues::validate
