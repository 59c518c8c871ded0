// Boxes to cut from: the leaves of the tree and the brushes are intersections of half spaces, and some of them have no end.
#pragma once

#include "scene/levels/bsp_file.h"
#include "scene/levels/polytope.h"

namespace clues::scene {

// The world's bounds: of its model and of everything drawn in it.
Polytope bounds_of_level(const BspFile& level);

// The same, and far around it: brushes behind what is drawn may lie outside of the model's bounds.
Polytope bounds_of_brushes(const BspFile& level);

}  // namespace clues::scene
