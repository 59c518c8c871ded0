// Linked with a copy of one source of the fast path that takes for dark what is lit (plant.py): lists made from parts of a scene lack what the engine lists of all of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/parts.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/cell_spec.h"

namespace clues::tests {
namespace {

// One failed proof at a time, and no ray.
bool loses_some(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) {
  const fastpath::Bvh bvh(mesh);
  fastpath::LocalMapOptions options;
  options.dials.first_guess = exact::Dials::FirstGuess::everything;
  const auto whole = fastpath::first_order_visibility(bvh, cell, options);
  if (whole.conservative_fallbacks > 0) return false;
  options.dials.first_guess = exact::Dials::FirstGuess::nothing;
  options.dials.sight_rays = 0;
  options.dials.batch = 1;
  options.dials.open_percent = 100;
  const auto part = fastpath::first_order_visibility(bvh, cell, options);
  return !std::includes(part.visible.begin(), part.visible.end(), whole.visible.begin(), whole.visible.end());
}

std::string scene_that_loses_some() {
  // Two plates in one plane over the cell, one upon the other.
  scene::TriangleMesh plates;
  fuzz::add(plates, {-2, -2, 2}, {2, -2, 2}, {0, 3, 2});
  fuzz::add(plates, {0, 0, 2}, {0.5, 0, 2}, {0.5, 0.5, 2});
  if (loses_some(plates, scene::parse_cell("box:-1,-1,-1,1,1,0").points)) return "plates";
  for (std::uint64_t index = 0; index < 12; ++index) {
    for (const auto kind : fuzz::all_kinds) {
      const auto scene = fuzz::generate(kind, 20261129, index);
      if (loses_some(scene.mesh, scene.cell)) return scene.name;
    }
  }
  return "";
}

TEST(WrongProofs, LoseWhatIsVisible) {
  const std::string scene = scene_that_loses_some();
  EXPECT_NE(scene, "");
  std::cout << scene << "\n";
}

}  // namespace
}  // namespace clues::tests
