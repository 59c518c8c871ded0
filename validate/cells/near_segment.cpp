#include "validate/cells/near_segment.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <utility>

namespace clues::validate {
namespace {

using Interval = CGAL::Interval_nt<false>;  // while the rounding mode is CGAL_FE_UPWARD

// The line through two points as it looks along each axis.
class Shadows {
 public:
  Shadows(const exact::Point3& v, const exact::Point3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const Interval to = CGAL::to_interval(p[axis]);
      from_[k] = CGAL::to_interval(v[axis]);
      along_[k] = to - from_[k];
    }
  }

  // Whether all of the triangle is surely strictly on one side of it as seen along an axis.
  bool miss(const scene::TriangleMesh& mesh, const scene::Triangle& t) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
      bool left = true, right = true;
      for (const std::uint32_t corner : t) {
        const scene::Point& q = mesh.points[corner];
        const Interval side = along_[i] * (Interval(q[j]) - from_[j]) - along_[j] * (Interval(q[i]) - from_[i]);
        left = left && side.inf() > 0;
        right = right && side.sup() < 0;
      }
      if (left || right) return true;
    }
    return false;
  }

 private:
  std::array<Interval, 3> from_, along_;
};

}  // namespace

NearSegment near_segment(scene::TriangleMesh mesh, std::uint32_t kept, const exact::Point3& v, const exact::Point3& p) {
  const CGAL::Bbox_3 box = v.bbox() + p.bbox();  // rounded outward
  const auto in_box = [&](const scene::Triangle& t) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const auto [low, high] = std::minmax({mesh.points[t[0]][k], mesh.points[t[1]][k], mesh.points[t[2]][k]});
      if (high < box.min(axis) || low > box.max(axis)) return false;
    }
    return true;
  };
  const CGAL::Protect_FPU_rounding<true> upward;
  const Shadows line(v, p);
  std::uint32_t left = 0, place = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i != kept && (!in_box(mesh.triangles[i]) || line.miss(mesh, mesh.triangles[i]))) continue;
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
