// First-order CLUES (D8-D17a): from a scene and a convex view cell to the exact visibility map. This is the door. The
// chapters behind it are folders, in this order: planar/, wedges/ (D10-D13), labels/ (D14), search/ (D17, D17a), map/ (D15),
// traversal/, hidden/ (what is not seen, as a solid, simplified, or for a renderer); refinement/ (D20, D21) goes on from here.
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/search/options.h"
#include "scene/cell_spec.h"
#include "scene/mesh/mesh.h"
#include "scene/result.h"

namespace clues::reference {

// Throws scene::Error not_solid when mode is solid and the mesh is not closed and consistently oriented;
// unsupported as StandardRange does.
VisibilityMap first_order_visibility(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                     const Options& options);

// The same map in the coordinates of the scene, exactly.
VisibilityMap moved_back(VisibilityMap map);

// The map of a cell, or of a part of it, in a complex that was cut for the whole cell: what lies in the whole cell does not occlude,
// also where it is outside the part (D21). Regions only of the sides wanted (per side_index; empty: all); the mode is not checked against the mesh.
VisibilityMap first_order_visibility_in(const exact::Complex& complex, const exact::ConvexCell& cell,
                                        const Options& options, const std::vector<bool>& wanted = {});

// The result file's contents, in the coordinates of the scene; scene_file and scene_sha256 are left to the
// caller. with_map adds regions, segments and wedges.
// With render_states its regions carry those too (render_states.h).
scene::Result to_result(const VisibilityMap& map, const scene::CellSpec& cell, bool with_map,
                        bool with_render_states = false);

}  // namespace clues::reference
