// Pictures of a visibility map, for people: doubles, rounded, good for nothing else.
#pragma once

#include <string>

#include "reference/visibility/first_order.h"

namespace clues::app {

// ASCII PLY with coloured faces. Green: seen from the cell (first-order); dark red: faces the cell and is hidden; grey: faces away.
// The two sides of a triangle are drawn a hair apart.
std::string to_ply_text(const reference::VisibilityMap& map);

// The same colours seen from above (x to the right, y up), the cell in blue; upright faces are strokes.
std::string to_svg_text(const reference::VisibilityMap& map, const std::string& title);

}  // namespace clues::app
