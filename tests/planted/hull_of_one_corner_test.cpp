// Linked with a fast path that maps too little of what is on the way to what is open (plant.py): nothing stops the light that comes from the rest of the cell, and lists become longer.
#include <gtest/gtest.h>

#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/random_scenes.h"

namespace clues::tests {
namespace {

TEST(HullOfOneCorner, ListsTooMuch) {
  std::size_t longer = 0;
  for (std::uint64_t index = 0; index < 12 && longer == 0; ++index) {
    for (const auto kind : fuzz::all_kinds) {
      const auto scene = fuzz::generate(kind, 20261130, index);
      const fastpath::Bvh bvh(scene.mesh);
      fastpath::LocalMapOptions options;
      options.dials.first_guess = exact::Dials::FirstGuess::nothing;
      options.dials.sight_rays = 100;
      options.dials.open_percent = 0;
      const auto all = fastpath::first_order_visibility(bvh, scene.cell, options).visible;
      options.dials.open_percent = 100;
      if (fastpath::first_order_visibility(bvh, scene.cell, options).visible.size() > all.size()) ++longer;
    }
  }
  EXPECT_GT(longer, 0U);
}

}  // namespace
}  // namespace clues::tests
