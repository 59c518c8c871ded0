// Linked with a simplification that takes a step on the wrong side of a border (plant.py): caught where nothing was arranged for it.
#include "wrong_step.h"

#include <gtest/gtest.h>

#include <iostream>

#include "../reference/shadow_scenes.h"
#include "fuzz/generators/random_scenes.h"

namespace clues::test {

void expect_hides_what_is_seen(const reference::VisibilityMap& map) {
  const auto literal = reference::with_simpler_occlusion(map, controls(0, 0.5));
  EXPECT_FALSE(reference::hides_no_more(map, literal.map));
  EXPECT_GT(seen_of_newly_hidden(map, literal.map), 0U) << "what is visible is called hidden";
}

namespace {

TEST(WrongStep, IsCaughtInRandomScenes) {
  constexpr std::uint64_t kSeed = 20261121;
  std::uint64_t maps = 0, by_inclusion = 0, by_judges = 0;
  for (std::uint64_t i = 0; i < 6 && by_judges == 0; ++i) {
    for (const fuzz::Kind kind : fuzz::all_kinds) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      const auto map = map_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell));
      const auto literal = reference::with_simpler_occlusion(map, controls(0, 0.5));
      ++maps;
      by_inclusion += !reference::hides_no_more(map, literal.map);
      by_judges += seen_of_newly_hidden(map, literal.map);
    }
  }
  EXPECT_GT(by_inclusion, 0U);
  EXPECT_GT(by_judges, 0U);
  std::cout << by_inclusion << " of " << maps << " maps hide more than before, " << by_judges
            << " points that they hide are seen\n";
}

}  // namespace
}  // namespace clues::test
