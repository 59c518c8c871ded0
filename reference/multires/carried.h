// Texture coordinates and colours of the input on a remesh: at each corner of a remesh triangle, those of the point of the input that the map gives
// it, which is linear there; seen from the piece at that corner, so that at a seam each side has its own.
#pragma once

#include "reference/multires/remesh.h"
#include "scene/multires/attributes.h"

namespace clues::reference {

// For the vertices and triangles of the remesh, in the form of the input's. A triangle has texture coordinates where a piece at each of its corners has.
struct CarriedAttributes {
  scene::MeshAttributes attributes;
  std::uint64_t across_seams =
      0;  // triangles in which texture coordinates jump: those of its corners do not go together
};

// O(pieces * log).
CarriedAttributes carried(const Remesh& remesh, const scene::TriangleMesh& input,
                          const scene::MeshAttributes& attributes);

}  // namespace clues::reference
