// Flags (D22) for scenes of trials: part of the case, so that shrinking keeps them.
#pragma once

#include "fuzz/findings/finding.h"
#include "fuzz/generators/random.h"

namespace clues::fuzz {

// Of six triangles about one does not count and two do not block; at least one blocks and one counts.
inline void add_random_flags(Case& scene, Random& random) {
  const std::size_t n = scene.mesh.triangles.size();
  scene.blocks.assign(n, 1);
  scene.counts.assign(n, 1);
  for (std::size_t t = 1; t < n; ++t) {
    const int kind = random.between(0, 5);
    if (kind == 0) scene.counts[t] = 0;
    if (kind == 1 || kind == 2) scene.blocks[t] = 0;
  }
}

}  // namespace clues::fuzz
