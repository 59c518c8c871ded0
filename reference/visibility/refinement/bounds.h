// Bounds of the exact visible set E on every side of a scene: a lower one, of what single points of the cell see, and an upper one, that starts as the first-order
// map and shrinks (D20, D21). Both are exact planar sets; lower is in E but for lines between what two viewpoints see, and E is in upper, at any time.
//
// Lower: a point v of V that no occluder touches sees what its own map shows: for a cell that is one point the continuations (D8) run along sight lines, so
// Omega({v}) is what v sees. With v on the border of V, a free sight line stays free when v is moved a little into int V.
// Upper: E(V) is in Omega(V), and for V = V1 u ... u Vk in the union of the Omega(Vi) (D21); so in every intersection of such sets.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/cell_cut.h"
#include "exact/complex/complex.h"
#include "reference/visibility/first_order.h"
#include "reference/visibility/planar/flat_set.h"

namespace clues::reference {

// By side_index. Sides that were not wanted, or do not count in the mode, are empty.
using SideSets = std::vector<FlatSet>;

// Estimates, for reports and for deciding when to stop; never for a label. In units of the standard range,
// squared.
struct AreaEstimate {
  double facing = 0;  // all sides that some point of the cell faces
  double lower = 0, first_order = 0, upper = 0;
  double excess() const { return upper - lower; }
};

// One side of an input triangle: fractions of its area, exactly.
struct TriangleBounds {
  std::uint32_t triangle = 0;
  bool front = true;
  exact::FT lower, upper, first_order;
};

class Bounds {
 public:
  // upper: the first-order map; lower: nothing yet. Throws as first_order_visibility does. All is in the
  // standard range of the scene.
  Bounds(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options);

  const VisibilityMap& first_order() const { return map_; }
  const exact::StandardRange& range() const { return map_.range; }
  const Options& options() const { return options_; }
  const SideSets& lower() const { return lower_; }
  const SideSets& upper() const { return upper_; }

  // The sides on which upper is more than lower.
  std::vector<bool> open_sides() const { return {open_.begin(), open_.end()}; }
  bool closed() const;

  // The first-order map of a part of the cell on the wanted sides, and its visible regions. Counted in maps() and fallbacks().
  VisibilityMap map_of(const exact::ConvexCell& part, const std::vector<bool>& wanted);
  SideSets sets_of(const VisibilityMap& map) const;

  // Adds to lower what the viewpoints for this depth (exact::Viewpoints) see.
  void look_around(int depth);

  // Side by side.
  SideSets united(const SideSets& a, const SideSets& b) const;

  // upper becomes what it has in common with `seen` on the wanted sides. Whether it lost anything.
  bool restrict_to(const SideSets& seen, const std::vector<bool>& wanted);

  AreaEstimate area() const;
  double area_estimate(const SideSets& sets) const;

  // All sides of input triangles that count in the mode and of which something is visible to first order; by triangle, front first.
  std::vector<TriangleBounds> by_triangle() const;

  std::uint64_t maps() const { return maps_; }              // computed, other than the first and those of single points
  std::uint64_t viewpoints() const { return viewpoints_; }  // that added to lower
  std::uint64_t fallbacks() const { return fallbacks_; }

  // In the standard range, as all that Bounds holds; moved_back() leads out. The map with `upper` as its visible regions: without wedges, and with the borders between visible and hidden as its segments.
  VisibilityMap refined_map(const std::string& method) const;

 private:
  SideSets nothing() const;
  // Adds to lower what v sees on the open sides. Nothing if there are none, v is touched by an occluder, or its map has a fallback.
  void add_viewpoint(const exact::Point3& v);
  void find_open();  // of the sides that were open so far
  template <class Work>
  void for_each_side(const Work& work) const;  // in parallel, on the threads of the options

  VisibilityMap map_;
  Options options_;  // without progress
  SideSets lower_, upper_;
  std::vector<char> open_;          // by side
  std::vector<double> piece_area_;  // estimates
  double facing_ = 0, first_order_area_ = 0;
  exact::Viewpoints viewpoints_to_ask_;
  std::uint64_t maps_ = 0, viewpoints_ = 0, fallbacks_ = 0;
};

}  // namespace clues::reference
