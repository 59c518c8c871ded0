// The hierarchy of a surface down to so many triangles, as tests of maps want it.
#pragma once

#include "reference/multires/hierarchy.h"

namespace clues::test {

inline scene::Hierarchy hierarchy_over(const scene::TriangleMesh& mesh, std::uint64_t base,
                                       reference::HierarchyOptions options = {}) {
  options.base_triangles = base;
  return reference::build_hierarchy(mesh, options);
}

}  // namespace clues::test
