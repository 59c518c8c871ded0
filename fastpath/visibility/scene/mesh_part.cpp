#include "fastpath/visibility/scene/mesh_part.h"

#include <algorithm>
#include <vector>

namespace clues::fastpath {

scene::TriangleMesh mesh_of(const scene::TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  scene::TriangleMesh part;
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : triangles) used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t p : used) part.points.push_back(mesh.points[p]);
  for (const std::uint32_t t : triangles) {
    scene::Triangle corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = std::lower_bound(used.begin(), used.end(), mesh.triangles[t][i]);
      corners[i] = static_cast<std::uint32_t>(at - used.begin());
    }
    part.triangles.push_back(corners);
    part.face_of.push_back(static_cast<std::uint32_t>(part.face_of.size()));
  }
  return part;
}

}  // namespace clues::fastpath
