// The first-order visibility map (D9-D17a) of a small scene, typically 20 to 3000 triangles: the engine of the fast path. Predicates are
// evaluated in intervals of doubles and, where these cannot decide, in rationals; constructed points keep their construction and are
// never rounded. What is left undecided (a generation limit, a walk that does not end) counts as visible and is counted.
//
// An implementation of its own: nothing is shared with reference/.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "fastpath/predicates/filter.h"
#include "fastpath/visibility/labels/set_label.h"
#include "fastpath/visibility/points/box.h"
#include "fastpath/visibility/points/points.h"
#include "fastpath/visibility/search/options.h"
#include "fastpath/visibility/wedges/piece_kind.h"
#include "scene/mesh/mesh.h"

namespace clues::fastpath {

// A valid wedge piece (D13) in doubles. Estimates, but for `box`, which contains the part of the piece inside the bounds of scene and cell.
struct WedgePiece {
  PieceKind kind = PieceKind::sv_me;
  int generation = 0;
  Point normal_estimate{};  // towards H-, the side that is seen; V is on the other
  Point center_estimate{};  // the cell vertex or the contour vertex from which it is radial
  std::vector<Point>
      outline_estimate{};  // near end 0, near end 1 (SE-MV: once), far end 1, far end 0; far ends clipped to the bounds
  bool unbounded = false;  // nothing ends it within the scene
  Box box;
};

// A region of one label on one side of a triangle (D15).
struct LocalRegion {
  std::uint32_t triangle = 0;
  bool front = true, visible = false;
  std::vector<Point> outline_estimate;
  double area_estimate = 0;
};

class LocalMap {
 public:
  using Label = SetLabel;

  // Triangles with a point in Omega or in V (D3, D15): ids of the mesh given, ascending.
  const std::vector<std::uint32_t>& visible() const;
  // Those that light meets on either side: in solid mode they may be more.
  const std::vector<std::uint32_t>& lit() const;
  // The valid pieces in order of their making, which is the same in every run; made anew at each call.
  std::vector<WedgePiece> pieces() const;
  // The regions of all sides that count, made anew at each call. O(k^2) labels for k pieces that cross a triangle.
  std::vector<LocalRegion> regions() const;

  // Of a point in free space, not on a surface; of a closed box; of the inside of a convex polygon, or what is right beside that of a triangle, asked at the middle of a box about one of its points. No surface that light meets may touch the
  // boxes or meet the inside (one_label.h). `hidden` is a proof; a case that stays undecided is called visible and counted in conservative_labels(). Any number of threads may
  // ask.
  Label label(const Point& p) const;
  Label label(const Box& box) const;
  Label label_of_inside(std::span<const ExactPoint> polygon, const Box& about) const;
  Label label_beside(const Corners& triangle, const Box& about) const;
  std::uint64_t conservative_labels() const;

  // False only if no valid piece meets the closed box (the closed triangle).
  bool piece_may_touch(const Box& box) const;
  bool piece_may_touch(const Corners& triangle) const;

  const LocalMapCounts& counts() const;

  // D17b: those of the visible ones of which no point is known to be in Omega or in V; none without a fallback. The last question to a map and its copies, as it
  // leaves only the pieces that are known, and counts in counts(); ask it once, and nothing else at the same time.
  std::vector<std::uint32_t> find_in_doubt();

  class Parts;  // local_map.cpp
  explicit LocalMap(std::shared_ptr<Parts> parts) : parts_(std::move(parts)) {}

 private:
  std::shared_ptr<Parts> parts_;
};

// Keeps no reference to its arguments. Throws scene::Error for coordinates that are not finite.
// `outside` widens the bounds to which unbounded pieces are clipped in boxes; questions about boxes, triangles and points must stay within
// the hull of mesh, cell and `outside`.
LocalMap make_local_map(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const LocalMapOptions& options,
                        const Box* outside = nullptr);

// The same of a part of a scene, one of several that are mapped one after the other: `ids` are its triangles' ids in the scene, ascending,
// and `memory` keeps what is found out about how they meet. Those that are `dark` stop no light and are not listed: all that they do is to divide what is around vertices (LocalPiece::dark).
struct PartOfScene {
  const scene::TriangleMesh& mesh;
  std::span<const std::uint32_t> ids;
  std::span<const std::uint8_t> dark;  // by triangle
  exact::CutMemory& memory;
};
LocalMap make_local_map(const PartOfScene& part, const exact::ConvexCell& cell, const LocalMapOptions& options,
                        const Box* outside);

// The map of a part of a cell, or of all of it, in a complex that was cut for the whole: what lies in the whole cell does not occlude, also where it is
// outside the part (D3, D21). Lists, and has regions of, the wanted triangles only (one for each triangle of the input).
LocalMap make_local_map_in(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& part,
                           const LocalMapOptions& options, const std::vector<bool>& wanted);

}  // namespace clues::fastpath
