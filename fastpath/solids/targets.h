// The triangles that are asked about, in a tree of boxes: what is proved of a box holds of all that is in it.
//
// Most triangles of a level are drawn on solids, and nobody sees them from behind: whoever is behind looks through the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/solids/solids.h"
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

  // Of the triangles that count. Keeps a reference: the scene must outlive it. O(n log n), and a search for the solids that each lies on.
  Targets(const scene::FlaggedMesh& scene, const Solids& solids);
  Targets(scene::FlaggedMesh&&, const Solids&) = delete;

  const std::vector<Node>& nodes() const { return nodes_; }  // node 0 is the root; none without triangles
  // Of a triangle, or of a box.
  std::vector<scene::Point> corners_of(const Node& node) const;

  // Planes of a triangle inside of which solids lie on nearly all of it. No line that begins on the inside, in the plane or not, and in none of these solids gets to
  // the triangle: just before its end it would be in one.
  const std::vector<Side>& backs_of(std::uint32_t triangle) const { return backs_[triangle]; }

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  scene::Bounds bounds_of(std::uint32_t triangle) const;
  void find_backs(std::uint32_t triangle, const Solids& solids);

  const scene::FlaggedMesh& scene_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Side>> backs_;  // per triangle of the scene
};

}  // namespace clues::fastpath::solids
