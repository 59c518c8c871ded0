// A point that stands for a limit: for the space just off a part of a contour edge (D13a).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fastpath/visibility/wedges/apex.h"
#include "fastpath/visibility/wedges/contour.h"
#include "fastpath/visibility/wedges/piece_set.h"

namespace clues::fastpath {

// A part of a mesh edge between neighbouring cuts, and a point inside it.
struct EdgePart {
  const ExactPoint *lo = nullptr, *hi = nullptr, *y = nullptr;
};

// Whether a plane contains the edge.
inline auto holds_edge(const LocalScene& scene, std::uint32_t edge) {
  return [&scene, edge](const Plane& h) {
    return h.side(scene.points[scene.edges[edge].a]) == 0 && h.side(scene.points[scene.edges[edge].b]) == 0;
  };
}

// A point of free space with the label of the space just off y in H-, next to the polygon between y and the touching vertex: nothing of the
// scene or of `set` lies between. Looks nearer and nearer, from `level` on, and leaves there how near it found one; none when it did not.
std::optional<ExactPoint> beside_edge(const LocalScene& scene, const PieceSet& set, const ContourEdge& c,
                                      const EdgePart& part, int& level);

// Whether the sight line from v to that point comes through the wedge's plane next to y, as one to y itself does: on the side of the touching vertices, with no
// surface between but one that ends at the edge, and in H- with nothing before the point. A line that comes through elsewhere may meet a surface in that plane, or a wedge upon it, that is lit only if this
// edge is; then both would be dark for want of each other (D17a). Not for planes that hold V.
bool comes_next_to_edge(const LocalScene& scene, const ContourEdge& c, const EdgePart& part, const ExactPoint& v,
                        const ExactPoint& beside);

}  // namespace clues::fastpath
