// Our own bounding volume hierarchy over the triangles of a mesh (D1): eight boxes a node, four triangles a leaf, both in floats of a local
// frame and rounded outward or with derived bounds; exact coordinates stay in the mesh. Built by binned surface-area heuristic, in
// parallel; the same tree for any number of threads. Triangles without area are left out: they are no surface.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/queries/box_lanes.h"
#include "fastpath/queries/local_frame.h"
#include "fastpath/queries/triangle_block.h"
#include "scene/mesh/bounds.h"
#include "scene/mesh/mesh.h"

namespace clues::fastpath {

class Bvh {
 public:
  // Keeps a reference: the mesh must outlive it. Throws scene::Error for coordinates that are not finite and indices out of range.
  // O(n log n); about 65 bytes a triangle.
  explicit Bvh(const scene::TriangleMesh& mesh);
  explicit Bvh(scene::TriangleMesh&&) = delete;

  const scene::TriangleMesh& mesh() const { return *mesh_; }
  Corners corners(std::uint32_t triangle) const {
    const scene::Triangle& t = mesh_->triangles[triangle];
    return {mesh_->points[t[0]], mesh_->points[t[1]], mesh_->points[t[2]]};
  }
  const std::vector<std::uint32_t>& degenerate() const { return degenerate_; }  // triangles without area, ascending

  const LocalFrame& frame() const { return frame_; }
  const std::vector<BoxLanes>& nodes() const { return nodes_; }  // node 0 is the root; none for an empty scene
  const std::vector<TriangleBlock>& blocks() const { return blocks_; }
  // Child `lane` of a node in the coordinates of the scene, rounded outward.
  scene::Bounds child_bounds(const BoxLanes& node, std::size_t lane) const;
  static constexpr int kDeepest = 96;  // no path from the root has more nodes

 private:
  friend class BvhTamperer;  // tests plant bugs with it

  const scene::TriangleMesh* mesh_;
  LocalFrame frame_;
  std::vector<BoxLanes> nodes_;
  std::vector<TriangleBlock> blocks_;
  std::vector<std::uint32_t> degenerate_;
};

}  // namespace clues::fastpath
