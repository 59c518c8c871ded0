#include "tests/delta/halves.h"

#include "exact/cell/cell_plane.h"
#include "exact/cell/direction_cone.h"
#include "tests/reference/support.h"

namespace clues::test {

std::vector<exact::ConvexCell> halves_of(const exact::ConvexCell& cell) {
  if (cell.dimension() != 3) return {};
  const exact::Plane3 cut(cell.center(), exact::Vector3(1, 0, 0));
  std::vector<exact::ConvexCell> out;
  for (const exact::Plane3& side : {cut, cut.opposite()}) {
    std::vector<exact::Point3> points;
    for (const auto& facet : cell.facets()) {
      for (const auto& p : exact::clipped(exact::corners_of(cell, facet), side)) points.push_back(exact::collapsed(p));
    }
    out.emplace_back(points);
  }
  return out;
}

scene::TriangleMesh plates_and_a_box() {
  SceneBuilder scene;
  scene.plate(-1, -1, 1, 1, 4);
  scene.plate(-20, -20, 20, 20, 8);
  scene.box({5, -1, 1}, {7, 1, 3});
  return scene.mesh();
}

}  // namespace clues::test
