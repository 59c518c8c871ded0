// The triangles that are asked about, in a tree of boxes: what is proved of a box holds of all that is in it.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/mesh/bounds.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fastpath::solids {

class Targets {
 public:
  struct Node {
    scene::Bounds bounds;
    std::uint32_t left = 0, right = 0;  // nodes; 0: it is one triangle
    std::uint32_t triangle = 0;
    bool is_triangle() const { return left == 0; }
  };

  // Of the triangles that count. O(n log n).
  explicit Targets(scene::FlaggedMesh scene);

  const std::vector<Node>& nodes() const { return nodes_; }  // node 0 is the root; none without triangles
  // Of a triangle, or of a box.
  std::vector<scene::Point> corners_of(const Node& node) const;

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  scene::Bounds bounds_of(std::uint32_t triangle) const;

  scene::FlaggedMesh scene_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace clues::fastpath::solids
