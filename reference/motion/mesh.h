// A whole mesh at a viewpoint: is it a depth mesh (D28), which constraints (D29) does it violate, and how far may the viewpoint move.
// Plain loops in rationals: meshes of some thousand triangles.
#pragma once

#include <vector>

#include "reference/motion/bounds.h"
#include "scene/motion/constraint.h"

namespace clues::reference {

// Across the edge from corner k to the next: the vertex of the other triangle. None where the mesh ends. Where two triangles run through an edge
// in the same direction, as of more than two some do, nothing says which is across: Error bad_argument.
inline constexpr std::uint32_t no_opposite = 0xffffffff;
std::vector<std::array<std::uint32_t, 3>> opposite_samples(const scene::DepthMesh& mesh);

// T7: a closed oriented mesh whose triangles all face v, and in which one direction is covered once, projects one to one.
struct DepthMeshState {
  std::uint64_t open_edges = 0;  // directed edges that are not met by exactly one other in the opposite direction
  std::uint64_t not_facing = 0;  // triangles with det <= 0
  std::uint64_t degree = 0;      // how many triangles hold the direction to the middle of the first, when all face v
  bool valid() const { return open_edges == 0 && not_facing == 0 && degree == 1; }
};
DepthMeshState depth_mesh_state(const scene::DepthMesh& mesh, const ExactViewpoint& v);

// By triangle, constraint, corner. Delaunay only where thresholds.delaunay asks for it and the edge has two triangles; then throws as opposite_samples.
std::vector<scene::ConstraintPlace> violations(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds,
                                               const ExactViewpoint& v);

// One bound a triangle: the least of its constraints. Throws as violations.
std::vector<double> motion_bounds(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds,
                                  const ExactViewpoint& v);

}  // namespace clues::reference
