// D19: looks for light on a triangle that a map calls hidden, without wedges. From a viewpoint the shadow of one blocker after the other is taken away from the triangle, each
// time that of what stops a sight line to the middle of what is left; so a window between a few blockers is found however small it is (down to 2^-44 of the triangle). All of this
// is done in doubles, and only says where to look: a sight line counts when exact/sight/witness.h confirms it. Shadows are those of whole blockers, also where these are in the cell and block
// nothing: light is missed then.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/predicates/cell.h"
#include "fastpath/queries/bvh.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

class LightSearch {
 public:
  // Keeps references to mesh and cell. `backs`: back sides of triangles count (sheet mode). Throws scene::Error.
  LightSearch(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, bool backs);

  // A confirmed witness for the triangle; none says little. A function of scene, cell and triangle alone. At most 32 sight lines from each of at most
  // 16 viewpoints: the cell's centre, places near its corners, and, as far as they go, others between the two.
  std::optional<Witness> find(std::uint32_t triangle) const;

 private:
  struct Viewpoint {
    exact::Point3 v;
    scene::Point estimate;
  };
  std::optional<Witness> find_from(const Viewpoint& from, std::uint32_t triangle, int& trials) const;

  const scene::TriangleMesh& mesh_;
  const exact::ConvexCell& cell_;
  bool backs_;
  double scale_ = 1;  // of coordinates, so that none is above 1
  fastpath::Bvh bvh_;
  fastpath::Cell inside_;  // whatever is in there blocks nothing (D3)
  std::vector<Viewpoint> viewpoints_;
};

}  // namespace clues::validate
