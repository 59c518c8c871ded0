// D27 for renderers and bakers: slices of the umbra as meshes. The exact mesh lies in the closed umbra; so does the one
// with doubles, whose corners are rounded inwards within the plane, which is proved face by face. That is why only planes
// across an axis have one: all their points with doubles for the two other coordinates lie in the plane.
//
// Put into the scene, such a mesh hides nothing that is visible from the cell, and from nowhere else is it meant to be.
#pragma once

#include <cstdint>

#include "reference/delta/sewn_mesh.h"
#include "reference/visibility/hidden/umbra.h"
#include "scene/mesh/mesh.h"

namespace clues::reference {

struct VirtualOccluder {
  int axis = 2;   // the plane is where this coordinate ...
  double at = 0;  // ... is this
  SewnMesh exact;
  exact::FT area{0};  // of the exact mesh
  scene::TriangleMesh rounded;
  exact::FT rounded_area{0};         // at most `area`
  std::uint64_t faces_left_out = 0;  // of the rounded mesh, where no corners with doubles were found
};

// Of the two slices of the plane (umbra_slice.h) the larger one. Axis 0, 1 or 2; umbra in the coordinates of the scene.
VirtualOccluder virtual_occluder(const Umbra& umbra, int axis, double at);

// The scene with the occluders behind it: its own triangles keep their ids.
scene::TriangleMesh with_occluders(const scene::TriangleMesh& mesh, const std::vector<VirtualOccluder>& occluders);

}  // namespace clues::reference
