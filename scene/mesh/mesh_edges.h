// Which points of a mesh are in one place, and which edges its triangles share. A file may give a point again for each triangle that has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

// Of each point a number that it shares with those of the same coordinates; from 0 on, in the order of points. O(n log n).
std::vector<std::uint32_t> numbers_of_places(const TriangleMesh& mesh);

class MeshEdges {
 public:
  explicit MeshEdges(const TriangleMesh& mesh);  // O(n log n)

  // Edge k of a triangle runs from corner k to the next. Edges have numbers from 0 on, in the order of triangles.
  std::uint32_t edge(std::uint32_t triangle, std::size_t k) const { return edges_[3 * triangle + k]; }
  // From the end with the smaller number of a place to the other.
  bool runs_up(std::uint32_t triangle, std::size_t k) const { return up_[3 * triangle + k]; }
  std::size_t count() const { return count_; }
  std::size_t triangle_count() const { return edges_.size() / 3; }

 private:
  std::vector<std::uint32_t> edges_;  // three of each triangle
  std::vector<bool> up_;
  std::size_t count_ = 0;
};

}  // namespace clues::scene
