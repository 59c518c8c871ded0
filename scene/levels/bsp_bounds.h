// The world's bounds: a box of doubles around its model and everything drawn in it, so that no leaf of the tree is without end.
#pragma once

#include "scene/levels/bsp_file.h"
#include "scene/levels/polytope.h"

namespace clues::scene {

Polytope bounds_of_level(const BspFile& level);

}  // namespace clues::scene
