#include "judges.h"

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "fuzz/generators/random.h"
#include "validate/certificates/region_points.h"

namespace clues::test {

using exact::Point3;

Contradictions contradictions(const reference::VisibilityMap& map, std::size_t points_per_region, std::uint64_t seed) {
  Contradictions found;
  const exact::SceneQuery query(map.complex, map.cell);
  std::vector<exact::TriangleCorners> corners;
  for (const exact::Piece& p : map.complex.pieces) {
    corners.push_back(
        {map.complex.points[p.corners[0]], map.complex.points[p.corners[1]], map.complex.points[p.corners[2]]});
  }
  fuzz::Random random(seed);
  for (const reference::Region& r : map.regions) {
    if (r.visible) continue;
    exact::Plane3 side = map.complex.planes[r.piece];
    if (!r.front) side = side.opposite();
    bool faces = false;
    for (const Point3& s : map.cell.vertices()) faces |= side.oriented_side(s) == CGAL::ON_POSITIVE_SIDE;
    if (!faces) continue;  // no point of the cell is on this side: nothing to ask
    for (const Point3& p : validate::interior_points(r.rings, points_per_region)) {
      ++found.points;
      const exact::OcclusionAnswer answer = exact::point_occlusion(p, side, map.cell, corners);
      found.seen_by_oracle += !answer.occluded;
      if (answer.witness) found.invalid_witnesses += !query.is_free(*answer.witness, p);
      std::vector<int> weights;
      for (std::size_t i = 0; i < map.cell.vertices().size(); ++i) weights.push_back(random.between(1, 40));
      const Point3 v = map.cell.interior_point(weights);
      if (side.oriented_side(v) != CGAL::ON_POSITIVE_SIDE) continue;
      ++found.sight_lines;
      found.seen_by_sight_lines += query.is_free(v, p);
    }
  }
  return found;
}

}  // namespace clues::test
