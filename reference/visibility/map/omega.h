// Omega (D9) of a scene as something that can be asked: the map, and with it the wedges that label any point
// of space (D14). All of it is in the standard range of the scene: map().range says how to get there and
// back.
#pragma once

#include <memory>

#include "exact/cell/convex_cell.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/labels/walk.h"
#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/search/fixpoint.h"
#include "scene/mesh/mesh.h"

namespace clues::reference {

class Omega {
 public:
  // As first_order_visibility.
  Omega(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options);
  // As first_order_visibility_in.
  Omega(exact::Complex complex, const exact::ConvexCell& cell, const Options& options, const std::vector<bool>& wanted);

  const VisibilityMap& map() const { return *map_; }
  // What wedges and labels refer to: all surfaces, or those that the traversal visited.
  const exact::SceneQuery& scene() const { return *scene_; }
  const Fixpoint& fixpoint() const { return *fixpoint_; }

  VisibilityMap take_map() && { return std::move(*map_); }

 private:
  Omega(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options,
        const exact::StandardRange& range);

  std::unique_ptr<VisibilityMap> map_;
  std::unique_ptr<exact::Complex> part_;  // the traversal's
  std::unique_ptr<exact::SceneQuery> scene_;
  std::unique_ptr<Fixpoint> fixpoint_;
};

// Labels of points of free space within a box (and within that of scene and cell), in the coordinates of
// omega.map(). Keeps a reference.
class SpaceLabels {
 public:
  SpaceLabels(const Omega& omega, const CGAL::Bbox_3& bounds);

  // The point must lie on no occluder. A point on a valid wedge piece has the label of the piece's H- side: visible (D13),
  // unless the piece only separates (T10). A point that is
  // visible only by a limit of D17 is a fallback. Throws Error internal if no walk is in general position.
  Walker::Label operator()(const exact::Point3& p) const;
  // The label at p of the hull of `corners`, of which the caller knows that nothing cuts it.
  Walker::Label operator()(const exact::Point3& p, const std::vector<exact::Point3>& corners) const;

 private:
  const Omega* omega_;
  Walker walker_;
  WedgeSet wedges_;
};

}  // namespace clues::reference
