// D31 to D33: from a surface to a base domain by removing independent vertices level by level, with the map Pi between them and the overlay
// that proves it.
#pragma once

#include <functional>

#include "reference/multires/stars/surface.h"
#include "scene/multires/hierarchy.h"

namespace clues::reference {

struct HierarchyOptions {
  std::uint64_t base_triangles = 200;  // ends with the first level that has no more
  std::vector<scene::Edge> features;   // edges of the surface that stay edge paths; those of its boundary do anyway
  std::vector<std::uint32_t> fixed;    // vertices that stay
  std::function<void(std::uint64_t triangles_left)> progress;
};

// Ends early where no vertex can be removed. Vertices of 12 or more neighbours stay for the level, those at the end or the crossing of
// features for ever. Throws Error unsupported as checked_surface (`name` begins messages), bad_argument for a feature that is no edge and a
// vertex that does not exist. The same input gives the same hierarchy, as far as the library's sines and powers do.
scene::Hierarchy build_hierarchy(const scene::TriangleMesh& mesh, const HierarchyOptions& options,
                                 const std::string& name = "mesh");

}  // namespace clues::reference
