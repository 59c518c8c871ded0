// Where the cells of a trial lie: in the box around the cell of the case, or in one that reaches half or all of the way to the box around the scene, so that cells see different things.
#pragma once

#include "fuzz/findings/finding.h"
#include "fuzz/generators/random.h"
#include "scene/mesh/bounds.h"

namespace clues::fuzz {

inline scene::Bounds space_for_cells(const Case& scene, Random& random) {
  scene::Bounds box = scene::bounds_of(scene.cell);
  const auto all = scene::hull_of(box, scene::bounds_of(scene.mesh.points));
  const double part = random.between(0, 2) / 2.0;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] += part * (all.low[i] - box.low[i]);
    box.high[i] += part * (all.high[i] - box.high[i]);
  }
  return box;
}

}  // namespace clues::fuzz
