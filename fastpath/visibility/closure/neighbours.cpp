#include "fastpath/visibility/closure/neighbours.h"

#include <algorithm>
#include <array>

#include "fastpath/predicates/filter.h"

namespace clues::fastpath {
namespace {

// An edge, and on which side of the plane of edge and eye a triangle lies; 0: its third corner may be in it.
struct Side {
  std::array<std::uint32_t, 2> edge{};  // ascending
  int side = 0;
  auto operator<=>(const Side&) const = default;
};

std::array<Side, 3> sides_of(const scene::TriangleMesh& mesh, std::uint32_t triangle, const scene::Point& eye) {
  std::array<Side, 3> sides;
  const scene::Triangle& c = mesh.triangles[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [a, b] = std::minmax(c[i], c[(i + 1) % 3]);
    const FilteredSign side = orient3d_filtered(mesh.points[a], mesh.points[b], eye, mesh.points[c[(i + 2) % 3]]);
    sides[i] = {{a, b}, side.certain ? static_cast<int>(side.sign) : 0};
  }
  return sides;
}

}  // namespace

std::vector<std::uint32_t> neighbours_of(const scene::TriangleMesh& mesh, std::span<const std::uint32_t> part) {
  std::vector<std::uint8_t> is_corner(mesh.points.size(), 0), is_part(mesh.triangles.size(), 0);
  for (const std::uint32_t t : part) {
    is_part[t] = 1;
    for (const std::uint32_t p : mesh.triangles[t]) is_corner[p] = 1;
  }
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const scene::Triangle& c = mesh.triangles[t];
    if (is_part[t] == 0 && is_corner[c[0]] + is_corner[c[1]] + is_corner[c[2]] >= 2) found.push_back(t);
  }
  return found;
}

std::vector<std::uint32_t> neighbours_in_sight(const scene::TriangleMesh& mesh, std::span<const std::uint32_t> part,
                                               const scene::Point& eye) {
  std::vector<Side> of_part;
  for (const std::uint32_t t : part) {
    const std::array<Side, 3> sides = sides_of(mesh, t, eye);
    of_part.insert(of_part.end(), sides.begin(), sides.end());
  }
  std::sort(of_part.begin(), of_part.end());
  std::vector<std::uint32_t> found = neighbours_of(mesh, part);
  std::erase_if(found, [&](std::uint32_t t) {
    const std::array<Side, 3> sides = sides_of(mesh, t, eye);
    return std::none_of(sides.begin(), sides.end(), [&](const Side& s) {
      return std::binary_search(of_part.begin(), of_part.end(), Side{s.edge, -s.side});
    });
  });
  return found;
}

}  // namespace clues::fastpath
