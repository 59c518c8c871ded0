// D7 under the limits of D17: whatever is left out, nothing visible is missing, no hidden region is seen, and what is listed without a doubt (D17b) is in Omega. Both kernels, lists and regions, first order and refined; against the exact visible
// set, point occlusion and sight lines. The decision by a single sample, which the fast path had, is planted in tests/planted/one_sample_of_a_side_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/map/local_map.h"
#include "fuzz/campaign/generators.h"
#include "scene/cell_spec.h"
#include "scene/mesh_io.h"
#include "tests/differential/answers.h"
#include "tests/differential/touching_series.h"
#include "tests/reference/judges.h"

namespace clues::tests {
namespace {

using Ids = std::vector<std::uint32_t>;

// As they bite in small scenes: without a CSV for each edge.
std::vector<Setting> limits() {
  std::vector<Setting> settings;
  for (const std::size_t csvs : {0U, 1U, 2U, 5U, 20U}) {
    settings.push_back({std::to_string(csvs) + " CSVs", {}});
    settings.back().dials.csv_limit = csvs;
    settings.back().dials.csv_limit_per_edge = 0;
  }
  for (const int generations : {0, 1, 2}) {
    settings.push_back({std::to_string(generations) + " generations", {}});
    settings.back().dials.generation_limit = generations;
  }
  // Walks that do not end make sources visible in doubt, which make wedges.
  for (const int legs : {2, 3}) {
    settings.push_back({"walks of " + std::to_string(legs) + " legs", {}});
    settings.back().dials.longest_walk = legs;
  }
  return settings;
}

fastpath::LocalMap fast_map(const fuzz::Case& scene, const exact::Dials& dials) {
  fastpath::LocalMapOptions options;
  options.dials = dials;
  return fastpath::make_local_map(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
}

std::string name_of(const fuzz::Case& scene) {
  return scene.generator + "-" + std::to_string(scene.seed) + "-" + std::to_string(scene.index);
}

fuzz::Case tip() {
  return {"limit-hides-a-tip", 0, 0, scene::read_mesh(CLUES_TEST_DATA "/limit-hides-a-tip.obj"),
          scene::parse_cell("box:-1,-1,-1,1,1,0").points};
}

// More CSVs than the limit. The middle of triangle 2 is outside all anti-cones of what was left out, its tip is in one, and is seen; the fast path called all of it hidden.
TEST(LimitsSoundness, ATipThatOnlyWedgesLeftOutShowIsListed) {
  const fuzz::Case scene = tip();
  const PointJudge judge(scene);
  const auto map = fast_map(scene, {});
  EXPECT_GT(map.counts().conservative_fallbacks, 0U);
  EXPECT_TRUE(std::binary_search(map.visible().begin(), map.visible().end(), 2U));
  const Answer closed = fast_answer(scene, {});
  EXPECT_TRUE(std::binary_search(closed.visible.begin(), closed.visible.end(), 2U));
  EXPECT_FALSE(closed.in_doubt.empty());
  const Judged regions = judge_regions(judge, map.regions());
  EXPECT_EQ(regions.seen, 0U);
  exact::Dials from_nothing;
  from_nothing.first_guess = exact::Dials::FirstGuess::nothing;
  const Answer grown = fast_answer(scene, from_nothing);
  EXPECT_TRUE(std::binary_search(grown.visible.begin(), grown.visible.end(), 2U));
  for (const bool backprojection : {false, true}) {
    const Answer refined = refined_fast_answer(scene, {}, backprojection, 1);
    EXPECT_TRUE(std::binary_search(refined.visible.begin(), refined.visible.end(), 2U)) << refined.by;
  }
}

struct Tally {
  std::uint64_t scenes = 0, answers = 0, limited = 0, points = 0;
  std::map<std::string, std::uint64_t> known, in_doubt;  // listed triangles of limited answers, by whose they are
};

void judge_first_order(const fuzz::Case& scene, const Setting& setting, const Ids& visible, const Ids& omega,
                       const PointJudge& judge, Tally& tally) {
  const auto expect_sound = [&](const Answer& answer) {
    EXPECT_EQ(missing_from(visible, answer.visible), Ids{}) << answer.by;
    EXPECT_EQ(missing_from(omega, answer.visible), Ids{}) << answer.by;  // nor anything that is visible to first order
    const Ids known = missing_from(answer.visible, answer.in_doubt);
    EXPECT_EQ(missing_from(known, omega), Ids{}) << answer.by;
    ++tally.answers;
    if (answer.fallbacks == 0) {
      EXPECT_EQ(answer.in_doubt, Ids{}) << answer.by;
      return;
    }
    ++tally.limited;
    tally.known[answer.by] += known.size();
    tally.in_doubt[answer.by] += answer.in_doubt.size();
  };
  expect_sound(reference_answer(scene, setting.dials));
  expect_sound(reference_answer(scene, setting.dials, reference::Formulation::traversal));
  expect_sound(fast_answer(scene, setting.dials));
  Setting grown = setting;
  grown.dials.first_guess = exact::Dials::FirstGuess::nothing;
  expect_sound(fast_answer(scene, grown.dials));

  reference::Options options;
  options.threads = 1;
  options.dials = setting.dials;
  const auto contradictions =
      test::contradictions(reference::first_order_visibility(scene.mesh, judge.cell(), options), 3, scene.index);
  EXPECT_EQ(contradictions.total(), 0U);
  const auto map = fast_map(scene, setting.dials);
  const Judged regions = judge_regions(judge, map.regions());
  EXPECT_EQ(regions.seen, 0U);
  tally.points += contradictions.points + regions.points;
}

TEST(LimitsSoundness, NothingVisibleIsMissingWhateverIsLeftOut) {
  Tally tally;
  for (const fuzz::Case& scene : small_scenes(1, 30)) {
    SCOPED_TRACE(name_of(scene));
    const Ids visible = truly_visible(scene), omega = reference_answer(scene, {}).visible;
    const PointJudge judge(scene);
    ++tally.scenes;
    for (const Setting& setting : limits()) {
      SCOPED_TRACE(setting.name);
      judge_first_order(scene, setting, visible, omega, judge, tally);
    }
  }
  // The fast path passes over what was left out elsewhere, and so knows of all that the others list.
  const Answer of_tip = fast_answer(tip(), {});
  tally.in_doubt[of_tip.by] += of_tip.in_doubt.size();
  std::cout << tally.scenes << " scenes, " << tally.answers << " lists, " << tally.limited
            << " of them with fallbacks, " << tally.points << " points of hidden regions\n";
  for (const auto& [by, known] : tally.known) {
    std::cout << by << ": " << known << " triangles known, " << tally.in_doubt[by] << " in doubt\n";
    EXPECT_GT(known, 0U) << by;
    EXPECT_GT(tally.in_doubt[by], 0U) << by;
  }
  EXPECT_GT(tally.limited, 0U);
  EXPECT_GT(tally.points, 0U);
}

// In solid mode only fronts count (D4): light on the back of a triangle, or on a side that faces away, does not make it known.
TEST(LimitsSoundness, InSolidModeNothingIsMissingAndWhatIsKnownIsInOmega) {
  std::uint64_t lists = 0, known_of_limited = 0;
  for (const auto& generator : fuzz::generators_named({"solids", "polytopes"}, fuzz::GivenScenes{})) {
    for (std::uint64_t i = 0, found = 0; found < 3 && i < 200; ++i) {
      const fuzz::Case scene = generator.make(11, i);
      if (!scene.solid || scene.mesh.triangles.size() > 40) continue;
      ++found;
      SCOPED_TRACE(name_of(scene));
      const Answer omega = reference_answer(scene, {});
      ASSERT_EQ(omega.in_doubt, Ids{});
      for (const Setting& setting : limits()) {
        SCOPED_TRACE(setting.name);
        for (const Answer& answer : {reference_answer(scene, setting.dials), fast_answer(scene, setting.dials)}) {
          const Ids known = missing_from(answer.visible, answer.in_doubt);
          EXPECT_EQ(missing_from(omega.visible, answer.visible), Ids{}) << answer.by;
          EXPECT_EQ(missing_from(known, omega.visible), Ids{}) << answer.by;
          ++lists;
          if (answer.fallbacks > 0) known_of_limited += known.size();
        }
      }
    }
  }
  std::cout << lists << " lists; " << known_of_limited << " triangles are known in those with fallbacks\n";
  EXPECT_GT(known_of_limited, 0U);
}

TEST(LimitsSoundness, NothingVisibleIsMissingFromRefinedLists) {
  Tally tally;
  for (const fuzz::Case& scene : small_scenes(1, 12)) {
    SCOPED_TRACE(name_of(scene));
    const Ids visible = truly_visible(scene);
    ++tally.scenes;
    for (const Setting& setting : limits()) {
      SCOPED_TRACE(setting.name);
      for (const bool backprojection : {false, true}) {
        for (const Answer& answer : {refined_fast_answer(scene, setting.dials, backprojection, 2),
                                     refined_reference_answer(scene, setting.dials, backprojection, 1)}) {
          EXPECT_EQ(missing_from(visible, answer.visible), Ids{}) << answer.by;
          ++tally.answers;
          tally.limited += answer.fallbacks > 0;
        }
      }
    }
  }
  std::cout << tally.scenes << " scenes, " << tally.answers << " lists, " << tally.limited
            << " of them with fallbacks\n";
  EXPECT_GT(tally.limited, 0U);
}

// How much less is seen in `limited` than in `all`, as a part of it: at most a rounding of the sums.
double lost_area(const Answer& all, const Answer& limited) {
  double lost = 0;
  for (const auto& [side, area] : all.areas) {
    const auto seen = limited.areas.find(side);
    lost = std::max(lost, 1 - (seen == limited.areas.end() ? 0 : seen->second) / area);
  }
  return lost;
}

// A limit makes labels visible and never hidden. That holds of each point of a triangle, so of the area that is seen of each side, and it is no matter of sight lines: what the
// method hides in error it mostly hides where nothing is seen.
TEST(LimitsSoundness, LimitsOnlyAddToWhatIsSeen) {
  std::vector<fuzz::Case> scenes = small_scenes(1, 30);
  const std::uint64_t from = number_from("CLUES_FROM", 0), count = number_from("CLUES_SCENES", 8);
  for (std::uint64_t n = from; n < from + count; ++n) scenes.push_back(touching_scene(kTouchingSeed, n));
  std::uint64_t limited = 0;
  for (const fuzz::Case& scene : scenes) {
    SCOPED_TRACE(name_of(scene));
    const Answer all = reference_answer(scene, {}), fast = fast_answer(scene, {});
    for (const Setting& setting : limits()) {
      SCOPED_TRACE(setting.name);
      if (all.fallbacks == 0) {
        const Answer some = reference_answer(scene, setting.dials);
        EXPECT_LT(lost_area(all, some), 1e-9) << some.fallbacks << " fallbacks";
        limited += some.fallbacks > 0;
      }
      if (fast.fallbacks == 0) {
        const Answer some = fast_answer(scene, setting.dials);
        EXPECT_LT(lost_area(fast, some), 1e-9) << some.fallbacks << " fallbacks of the fast path";
        limited += some.fallbacks > 0;
      }
    }
  }
  EXPECT_GT(limited, 0U);
}

}  // namespace
}  // namespace clues::tests
