// Witnesses that a person can read. A published witness is checked for ever after, so its numbers should be short.
#pragma once

#include <optional>

#include "exact/cell/convex_cell.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

// Tries a few hundred segments between simple points of cell and triangle; the first that exact/sight/witness.h confirms. O(triangles) for each.
std::optional<Witness> short_witness(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                     std::uint32_t triangle, bool fronts_only);

// The same sight line with its ends moved to shorter numbers nearby, if the result is still confirmed; else as it was.
Witness shortened(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Witness& witness);

}  // namespace clues::validate
