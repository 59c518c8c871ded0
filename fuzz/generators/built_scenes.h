// Small scenes that are built like something: interiors, streets, forests, umbrellas, polytopes, closed solids in solid mode (D4), edges parallel to the cell.
#pragma once

#include <vector>

#include "fuzz/generators/degenerate_scenes.h"

namespace clues::fuzz {

// Each a pure function of seed and index: at most 80 triangles, none without area, finite coordinates.
const std::vector<DegenerateGenerator>& built_generators();

}  // namespace clues::fuzz
