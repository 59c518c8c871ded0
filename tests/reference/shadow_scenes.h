// Scenes with a shadow whose border can be simpler, and what becomes of the map.
#pragma once

#include "reference/visibility/hidden/effective_occlusion.h"
#include "support.h"

namespace clues::test {

reference::OcclusionControls controls(double min_occlusion, double max_loss);

// FIG. 30D, E: a box, and a shadow with seven corners inside one triangle of the face towards the cell.
struct Fig30 {
  SceneBuilder s;
  std::uint32_t box = 0;
  exact::ConvexCell cell = box_cell(-0.25, -0.25, -1, 0.25, 0.25, 0);
  Fig30();
};

// a wall with a window. Each corner of the window is an outside corner of the (inner) contour; the chord between its neighbours, taken as the published text
// has it, makes a corner of what is seen through the window hidden.
struct Window {
  SceneBuilder s;
  exact::ConvexCell cell = box_cell(-0.25, -0.25, -1, 0.25, 0.25, 0);
  Window() {
    s.plate(-40, -40, 40, -1, 4);
    s.plate(-40, 1, 40, 40, 4);
    s.plate(-40, -1, -1, 1, 4);
    s.plate(1, -1, 40, 1, 4);
    s.triangle({-30, -20, 8}, {30, -20, 8}, {0, 40, 8});
  }
};

// What one map hides and the other does not, asked point by point: how many of a point inside each part are seen, by a sight line that the oracle found and a plain
// segment test confirms.
std::uint64_t seen_of_newly_hidden(const reference::VisibilityMap& before, const reference::VisibilityMap& after);

}  // namespace clues::test
