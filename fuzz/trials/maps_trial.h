// The subject "maps": hierarchies and remeshes of surfaces (D31-D34), judged by E1 to E7 and by each other.
#pragma once

#include <functional>
#include <memory>

#include "fuzz/trials/trial.h"
#include "scene/multires/hierarchy.h"

namespace clues::fuzz {

// What makes hierarchies: of a mesh, with features, down to so many triangles.
using HierarchyMaker = std::function<scene::Hierarchy(const scene::TriangleMesh& mesh,
                                                      const std::vector<scene::Edge>& features, std::uint64_t base)>;

// Of the reference, and of the fast path.
std::unique_ptr<Trial> make_maps_trial();
// Of a fast path that is not ours: tests plant mistakes so.
std::unique_ptr<Trial> make_maps_trial(HierarchyMaker fast);

}  // namespace clues::fuzz
