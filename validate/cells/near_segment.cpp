#include "validate/cells/near_segment.h"

#include <algorithm>
#include <utility>

namespace clues::validate {

NearSegment near_segment(scene::TriangleMesh mesh, std::uint32_t kept, const exact::Point3& v, const exact::Point3& p) {
  const CGAL::Bbox_3 box = v.bbox() + p.bbox();  // rounded outward
  const auto is_near = [&](const scene::Triangle& t) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const auto [low, high] = std::minmax({mesh.points[t[0]][k], mesh.points[t[1]][k], mesh.points[t[2]][k]});
      if (high < box.min(axis) || low > box.max(axis)) return false;
    }
    return true;
  };
  std::uint32_t left = 0, place = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i != kept && !is_near(mesh.triangles[i])) continue;
    if (i == kept) place = left;
    mesh.triangles[left] = mesh.triangles[i];
    mesh.face_of[left] = left;
    ++left;
  }
  mesh.triangles.resize(left);
  mesh.face_of.resize(left);
  return {std::move(mesh), place};
}

}  // namespace clues::validate
