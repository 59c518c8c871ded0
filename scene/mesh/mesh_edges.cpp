#include "scene/mesh/mesh_edges.h"

#include <algorithm>
#include <array>
#include <map>

namespace clues::scene {

std::vector<std::uint32_t> numbers_of_places(const TriangleMesh& mesh) {
  std::map<Point, std::uint32_t> known;
  std::vector<std::uint32_t> numbers;
  for (const Point& p : mesh.points)
    numbers.push_back(known.try_emplace(p, static_cast<std::uint32_t>(known.size())).first->second);
  return numbers;
}

MeshEdges::MeshEdges(const TriangleMesh& mesh) {
  const auto number = numbers_of_places(mesh);
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> known;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = number[t[k]], b = number[t[(k + 1) % 3]];
      const auto at =
          known.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(known.size())).first;
      edges_.push_back(at->second);
      up_.push_back(a < b);
    }
  }
  count_ = known.size();
}

}  // namespace clues::scene
