// The dials (exact/dials.h): with any setting the answer is sound, and where nothing is limited it is the same as with none, in lists and areas.
#include "exact/dials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/differential/answers.h"

namespace clues::tests {
namespace {

using exact::Dials;
using Ids = std::vector<std::uint32_t>;

struct Dialled : Setting {
  exact::ProcessDials process;
};

std::vector<Dialled> unlimited_settings() {
  std::vector<Dialled> settings;
  const auto add = [&](const char* name) -> Dialled& { return settings.emplace_back(Dialled{{name, {}}, {}}); };
  add("first guess: nothing").dials.first_guess = Dials::FirstGuess::nothing;
  add("first guess: everything").dials.first_guess = Dials::FirstGuess::everything;
  add("no sight rays").dials.sight_rays = 0;
  add("10 sight rays").dials.sight_rays = 10;
  add("batches of one").dials.batch = 1;
  add("batches of two").dials.batch = 2;
  add("one thread").dials.threads = 1;
  add("three threads").dials.threads = 3;
  add("doubles know nothing").process.unsure_doubles = true;
  add("intervals know nothing").process.unsure_intervals = true;
  add("flat trees").process.flat_trees = true;
  Dialled& all = add("all");
  all.dials.first_guess = Dials::FirstGuess::nothing;
  all.dials.sight_rays = 0;
  all.dials.batch = 1;
  all.dials.threads = 2;
  all.process = {true, true, true};
  return settings;
}

void expect_same(const Answer& dialled, const Answer& usual, double extent) {
  EXPECT_EQ(dialled.visible, usual.visible) << dialled.by;
  EXPECT_EQ(dialled.fallbacks, usual.fallbacks) << dialled.by;
  if (dialled.fallbacks + usual.fallbacks > 0)
    return;  // what is not decided is called visible, and may lie in another region
  for (const auto& [from, to] : {std::pair(&dialled, &usual), std::pair(&usual, &dialled)}) {
    for (const auto& [side, area] : from->areas) {
      const auto other = to->areas.find(side);
      EXPECT_NEAR(area, other == to->areas.end() ? 0 : other->second, 1e-9 * extent)
          << dialled.by << " triangle " << side.first << (side.second ? " front" : " back");
    }
  }
}

// An upper bound of all areas.
double area_of(const fuzz::Case& scene) {
  double most = 0;
  for (const scene::Point& p : scene.mesh.points) {
    for (const double x : p) most = std::max(most, std::fabs(x));
  }
  return 16 * most * most;
}

TEST(Dials, WhatLimitsNothingChangesNothing) {
  std::uint64_t scenes = 0;
  for (const fuzz::Case& scene : small_scenes(1, 40)) {
    SCOPED_TRACE(scene.generator + "-" + std::to_string(scene.seed) + "-" + std::to_string(scene.index));
    const Answer reference = reference_answer(scene, {}), fast = fast_answer(scene, {});
    const Answer traversal = reference_answer(scene, {}, reference::Formulation::traversal);
    ++scenes;
    for (const Dialled& setting : unlimited_settings()) {
      SCOPED_TRACE(setting.name);
      const exact::TurnedProcessDials turned(setting.process);
      expect_same(reference_answer(scene, setting.dials), reference, area_of(scene));
      expect_same(reference_answer(scene, setting.dials, reference::Formulation::traversal), traversal, area_of(scene));
      expect_same(fast_answer(scene, setting.dials), fast, area_of(scene));
    }
  }
  std::cout << scenes << " scenes\n";
  EXPECT_GT(scenes, 2U);
}

TEST(Dials, ShortWalksMakeMoreVisibleNeverLess) {
  std::uint64_t fallbacks[2] = {0, 0}, more = 0;
  for (const fuzz::Case& scene : small_scenes(1, 40)) {
    SCOPED_TRACE(scene.generator + "-" + std::to_string(scene.seed) + "-" + std::to_string(scene.index));
    const Ids omega = reference_answer(scene, {}).visible;
    for (const int legs : {0, 1, 2, 3}) {
      SCOPED_TRACE(legs);
      Dials dials;
      dials.longest_walk = legs;
      const Answer reference = reference_answer(scene, dials), fast = fast_answer(scene, dials);
      EXPECT_EQ(missing_from(omega, reference.visible), Ids{});
      EXPECT_EQ(missing_from(omega, fast.visible), Ids{});
      fallbacks[0] += reference.fallbacks;
      fallbacks[1] += fast.fallbacks;
      more += missing_from(fast.visible, omega).size();
    }
  }
  EXPECT_GT(fallbacks[0], 0U);
  EXPECT_GT(fallbacks[1], 0U);
  std::cout << fallbacks[0] << " and " << fallbacks[1] << " fallbacks, " << more << " triangles more\n";
}

TEST(Dials, RefinementsAreSoundWithAnySetting) {
  for (const fuzz::Case& scene : small_scenes(1, 20)) {
    SCOPED_TRACE(scene.generator + "-" + std::to_string(scene.seed) + "-" + std::to_string(scene.index));
    const Ids visible = truly_visible(scene);
    const std::vector<Dialled> settings = unlimited_settings();
    for (const std::size_t i : {std::size_t{0}, settings.size() - 1}) {
      const Dialled& setting = settings[i];
      SCOPED_TRACE(setting.name);
      const exact::TurnedProcessDials turned(setting.process);
      for (const bool backprojection : {false, true}) {
        EXPECT_EQ(missing_from(visible, refined_fast_answer(scene, setting.dials, backprojection, 2).visible), Ids{});
        EXPECT_EQ(missing_from(visible, refined_reference_answer(scene, setting.dials, backprojection, 1).visible),
                  Ids{});
      }
    }
  }
}

TEST(Dials, ProcessDialsAreTurnedBack) {
  {
    const exact::TurnedProcessDials outer({true, false, false});
    const exact::TurnedProcessDials inner({false, true, true});
    EXPECT_FALSE(exact::process_dials::unsure_doubles);
    EXPECT_TRUE(exact::process_dials::unsure_intervals);
  }
  EXPECT_FALSE(exact::process_dials::unsure_doubles);
  EXPECT_FALSE(exact::process_dials::unsure_intervals);
  EXPECT_FALSE(exact::process_dials::flat_trees);
}

}  // namespace
}  // namespace clues::tests
