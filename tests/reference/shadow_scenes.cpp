#include "shadow_scenes.h"

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/map/flat_sides.h"
#include "reference/visibility/planar/flat_set.h"

namespace clues::test {

using reference::VisibilityMap;

namespace {

// The plate that throws the shadow of FIG. 30E: seven corners.
void heptagon(SceneBuilder& s, double z) {
  const std::vector<std::array<double, 2>> p{{4, 0}, {2.5, 3}, {-1, 4}, {-3.5, 2}, {-3.5, -1.5}, {-1, -4}, {2.5, -3}};
  for (std::size_t i = 2; i < p.size(); ++i)
    s.triangle({p[0][0], p[0][1], z}, {p[i - 1][0], p[i - 1][1], z}, {p[i][0], p[i][1], z});
}

}  // namespace

reference::OcclusionControls controls(double min_occlusion, double max_loss) { return {min_occlusion, max_loss, 1}; }

Fig30::Fig30() {
  box = s.box({-60, -20, 20}, {20, 60, 30});
  heptagon(s, 10);
}

std::uint64_t seen_of_newly_hidden(const VisibilityMap& before, const VisibilityMap& after) {
  const exact::SceneQuery query(before.complex, before.cell);
  std::vector<exact::TriangleCorners> corners;
  for (const exact::Piece& p : before.complex.pieces) {
    corners.push_back({before.complex.points[p.corners[0]], before.complex.points[p.corners[1]],
                       before.complex.points[p.corners[2]]});
  }
  std::uint64_t seen = 0;
  for (std::uint32_t t = 0; t < before.complex.pieces.size(); ++t) {
    const reference::TriangleFrame frame(before.complex, t);
    const exact::FT twice = frame.twice_area();
    for (const bool front : {true, false}) {
      const auto hidden = [&](const VisibilityMap& map) {
        std::vector<reference::Face2> faces;
        for (const reference::Region& r : map.regions) {
          if (r.piece != t || r.front != front || r.visible) continue;
          faces.emplace_back();
          for (const auto& ring : r.rings) {
            faces.back().emplace_back();
            for (const exact::Point3& p : ring) faces.back().back().push_back(frame.frame()(p));
          }
        }
        return reference::FlatSet(twice, faces);
      };
      const exact::Plane3& plane = before.complex.planes[t];
      const exact::Plane3 side = front ? plane : plane.opposite();
      for (const reference::Face2& face : subtract(hidden(after), hidden(before)).faces()) {
        const exact::Point3 p = frame.lift(reference::inner_point(face, 0));
        const auto answer = exact::point_occlusion(p, side, before.cell, corners);
        seen += answer.witness && query.is_free(*answer.witness, p);
      }
    }
  }
  return seen;
}

}  // namespace clues::test
