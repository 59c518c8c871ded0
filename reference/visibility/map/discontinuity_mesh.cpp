#include "reference/visibility/map/discontinuity_mesh.h"

#include <map>
#include <tuple>

namespace clues::reference {

using exact::Point3;

DiscontinuityMesh discontinuity_mesh(const VisibilityMap& map) {
  DiscontinuityMesh mesh;
  std::map<Point3, std::uint64_t> number;
  for (const Region& r : map.regions) {
    for (const auto& ring : r.rings) {
      for (const Point3& p : ring) number.emplace(p, 0);
    }
  }
  for (auto& [p, i] : number) {
    i = mesh.vertices.size();
    mesh.vertices.push_back(p);
  }
  using Directed = std::tuple<std::uint32_t, bool, std::uint64_t, std::uint64_t>;  // piece, side, from, to
  std::map<Directed, std::uint64_t> left_of;
  for (const Region& r : map.regions) {
    const std::uint64_t face = mesh.faces.size();
    mesh.faces.emplace_back();
    for (const auto& ring : r.rings) {
      std::vector<std::uint64_t> numbers;
      for (const Point3& p : ring) numbers.push_back(number.at(p));
      for (std::size_t i = 0; i < numbers.size(); ++i)
        left_of.emplace(Directed{r.piece, r.front, numbers[i], numbers[(i + 1) % numbers.size()]}, face);
      mesh.faces.back().push_back(std::move(numbers));
    }
  }
  for (std::uint64_t face = 0; face < mesh.faces.size(); ++face) {
    const Region& r = map.regions[face];
    for (const auto& ring : mesh.faces[face]) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint64_t a = ring[i], b = ring[(i + 1) % ring.size()];
        const auto other = left_of.find(Directed{r.piece, r.front, b, a});
        if (other == left_of.end()) {
          mesh.edges.push_back({a, b, face, std::nullopt, false});
        } else if (a < b) {
          const bool boundary = map.regions[other->second].visible != r.visible;
          mesh.edges.push_back({a, b, face, other->second, boundary});
        }
      }
    }
  }
  return mesh;
}

}  // namespace clues::reference
