// Where a node stands: an affine map in doubles.
#pragma once

#include <array>

#include "scene/gltf/gltf_fields.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

struct Transform {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Point operator()(const Point& p) const;
  bool mirrors() const;  // its determinant is below 0
};

// First `inner`, then `outer`.
Transform product(const Transform& outer, const Transform& inner);

// The node's "matrix", or its "translation", "rotation" and "scale". Throws Error malformed: both, a last row that is not 0 0 0 1, no
// unit quaternion.
Transform transform_of(const GltfObject& node);

}  // namespace clues::scene
