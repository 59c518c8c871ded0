// Maps that are given up (closure.h, PartStage): the closure over the exact reference, whose maps a test gives up as it likes, and over the engine, which does so when its effort is spent.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/closure/closure.h"
#include "fastpath/visibility/see_through.h"
#include "fuzz/generators/city.h"
#include "reference/visibility/first_order.h"
#include "tests/differential/reference_part.h"

namespace clues::tests {
namespace {

// A small city whose maps a test may give up.
struct SmallCity {
  scene::TriangleMesh mesh = fuzz::make_city(100, 1);
  std::vector<scene::Point> cell = fuzz::street_cell(100, 1);
  exact::ConvexCell exact_cell = exact::ConvexCell::from_doubles(cell);
  std::vector<std::uint32_t> whole = reference::first_order_visibility(mesh, exact_cell, {}).visible;
  fastpath::PartialMapMaker make_map = reference_parts(exact_cell, PartBug::none);
  fastpath::Bvh bvh{mesh};
};

std::vector<std::uint32_t> mapped(const fastpath::ScenePart& part) { return fastpath::mapped_of(part.ids, part.dark); }

// Whichever map is given up: what is visible is listed, as light meets it in the map before or as there is no proof. And what is listed without need is no more than what lacks a proof.
TEST(Closure, ListsWhatIsVisibleWhereAMapIsGivenUp) {
  const SmallCity city;
  std::size_t listed_before = city.mesh.triangles.size() + 1, given_up = 0;
  for (std::uint64_t most = 0;; ++most) {
    SCOPED_TRACE(most);
    std::uint64_t made = 0;
    const auto some = [&](const fastpath::ScenePart& part, fastpath::PartStage stage) {
      return made++ < most ? city.make_map(part, stage) : nullptr;
    };
    const auto closure = fastpath::close_over_visible(city.bvh, fastpath::Cell(city.cell), some, 0, kSeveralMaps);
    std::vector<std::uint32_t> listed;
    std::set_union(closure.visible.begin(), closure.visible.end(), closure.unproved.begin(), closure.unproved.end(),
                   std::back_inserter(listed));
    EXPECT_TRUE(std::includes(listed.begin(), listed.end(), city.whole.begin(), city.whole.end()));
    EXPECT_EQ(closure.visible.size() + closure.unproved.size(), listed.size());
    if (most == 0) {
      EXPECT_FALSE(closure.map);
      EXPECT_EQ(listed.size(), city.mesh.triangles.size());
    }
    if (made <= most) {
      EXPECT_TRUE(closure.unproved.empty());
      EXPECT_EQ(listed, city.whole);
      break;
    }
    ++given_up;
    EXPECT_LE(listed.size(), listed_before);
    listed_before = listed.size();
  }
  EXPECT_LT(listed_before, city.mesh.triangles.size());
  EXPECT_GT(given_up, 2);
}

// After a map is given up the part is all that counts, with what did not count in the map before. After a second one it goes back to that of the map before, or to what counts of the first, and grows again
// without any more of what does not count. Whichever maps are given up, one, two or three: what counts and is visible is listed, and little else.
TEST(Closure, GoesOnWithWhatCountsWhereAMapIsGivenUp) {
  const SmallCity city;
  std::vector<std::uint8_t> counting(city.mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < counting.size(); t += 2) counting[t] = 1;
  const auto counted = [&](const std::vector<std::uint32_t>& ids) {
    return std::count_if(ids.begin(), ids.end(), [&](std::uint32_t t) { return counting[t] != 0; });
  };
  bool ended = false;
  std::size_t came_to_an_end = 0;
  for (std::uint64_t first = 0; !ended; ++first) {
    constexpr std::uint64_t kNever = 1000;
    using Two = std::pair<std::uint64_t, std::uint64_t>;
    for (const auto& [second, third] :
         {Two(kNever, kNever), Two(first + 1, kNever), Two(first + 1, first + 2), Two(first + 1, first + 3)}) {
      SCOPED_TRACE(testing::Message() << first << ' ' << second << ' ' << third);
      std::uint64_t made = 0;
      std::vector<std::uint32_t> second_part;
      std::vector<fastpath::PartStage> stages;
      std::vector<std::vector<std::uint32_t>> hulls;  // of all maps asked for, what does not count
      const auto some = [&](const fastpath::ScenePart& part, fastpath::PartStage stage) {
        const std::vector<std::uint32_t> ids = mapped(part);
        std::copy_if(ids.begin(), ids.end(), std::back_inserter(hulls.emplace_back()),
                     [&](std::uint32_t t) { return counting[t] == 0; });
        const std::uint64_t number = made++;
        if (number == first + 1) second_part = ids;
        stages.push_back(stage);
        return number == first || number == second || number == third ? nullptr : city.make_map(part, stage);
      };
      const auto closure =
          fastpath::close_over_visible(city.bvh, fastpath::Cell(city.cell), some, 0, kSeveralMaps, {}, counting);
      std::vector<std::uint32_t> listed;
      std::set_union(closure.visible.begin(), closure.visible.end(), closure.unproved.begin(), closure.unproved.end(),
                     std::back_inserter(listed));
      for (const std::uint32_t t : city.whole)
        EXPECT_TRUE(counting[t] == 0 || std::binary_search(listed.begin(), listed.end(), t)) << t;
      ended = made <= first;
      if (ended) break;
      ASSERT_GT(hulls.size(), first + 1);
      // All that counts but what is known to be dark by the maps before.
      std::size_t left_out = 0;
      for (std::uint32_t t = 0; t < counting.size(); ++t) {
        if (counting[t] == 0 || std::binary_search(second_part.begin(), second_part.end(), t)) continue;
        EXPECT_FALSE(std::binary_search(city.whole.begin(), city.whole.end(), t)) << t;
        ++left_out;
      }
      if (first == 0) {
        EXPECT_EQ(left_out, 0U);
      }
      EXPECT_EQ(hulls[first + 1], hulls[first == 0 ? 0 : first - 1]);
      for (std::size_t i = 0; i < stages.size(); ++i) {
        using enum fastpath::PartStage;
        const bool went_on = second == first + 1 && i > second;
        EXPECT_EQ(stages[i], i <= first ? grown : !went_on ? all : first > 0 ? rest : least) << i;
        if (!went_on) continue;
        const auto& before = first == 0 ? std::vector<std::uint32_t>{} : hulls[first - 1];
        EXPECT_TRUE(std::includes(before.begin(), before.end(), hulls[i].begin(), hulls[i].end())) << i;
      }
      if (made > third) continue;
      ++came_to_an_end;
      EXPECT_TRUE(closure.unproved.empty());
      EXPECT_LT(counted(listed), counted(city.whole) + counted(city.whole) / 4 + 8);
    }
  }
  EXPECT_GT(came_to_an_end, 2U);
}

// Where all count there is nothing to leave out: after a map is given up, and then that of all, the first part that was is mapped again, as first tries get little effort (engine_part.cpp).
TEST(Closure, MapsThePartAgainWhereAllCount) {
  const SmallCity city;
  for (std::size_t first = 0; first < 3; ++first) {
    SCOPED_TRACE(first);
    std::vector<fastpath::PartStage> stages;
    std::vector<std::vector<std::uint32_t>> parts;
    const auto some = [&](const fastpath::ScenePart& part, fastpath::PartStage stage) {
      const std::size_t number = parts.size();
      parts.push_back(mapped(part));
      stages.push_back(stage);
      return number == first || number == first + 1 ? nullptr : city.make_map(part, stage);
    };
    const auto closure = fastpath::close_over_visible(city.bvh, fastpath::Cell(city.cell), some, 0, kSeveralMaps);
    ASSERT_GT(parts.size(), first + 2);
    EXPECT_GT(parts[first + 1].size(), parts[first].size());
    EXPECT_EQ(parts[first + 2], parts[first]);
    for (std::size_t i = 0; i < stages.size(); ++i) {
      using enum fastpath::PartStage;
      EXPECT_EQ(stages[i], i <= first ? grown : i == first + 1 ? all : first > 0 ? rest : least) << i;
    }
    EXPECT_TRUE(closure.unproved.empty());
    EXPECT_EQ(closure.visible, city.whole);
  }
}

// A part that has grown to much more than the first one gets no more effort for it.
TEST(Closure, APartThatHasGrownGetsNoMoreEffort) {
  using fastpath::effort_of_part;
  EXPECT_EQ(effort_of_part(1000, 700, 700), 1000U);
  EXPECT_EQ(effort_of_part(1000, 2100, 700), 1000U);
  EXPECT_EQ(effort_of_part(1000, 4200, 700), 500U);
  EXPECT_EQ(effort_of_part(1000, 1536, 3), 1000U) << "as if the first had 512";
  EXPECT_EQ(effort_of_part(1000, 1U << 30U, 3), 1U) << "not 0, which is without end";
  EXPECT_EQ(effort_of_part(0, 1U << 30U, 3), 0U);
}

// Nothing is missing: the same part is mapped again, with what that stage is allowed; and after that, where there is no map, with D17's limit.
TEST(Closure, MapsTheSamePartAgainWhereNothingIsMissing) {
  const SmallCity city;
  using enum fastpath::PartStage;
  for (std::size_t given_up = 0; given_up < 4; ++given_up) {
    SCOPED_TRACE(given_up);
    std::vector<fastpath::PartStage> stages;
    const auto some = [&](const fastpath::ScenePart& part, fastpath::PartStage stage) {
      EXPECT_EQ(mapped(part).size(), city.mesh.triangles.size());
      stages.push_back(stage);
      return stages.size() <= given_up ? nullptr : city.make_map(part, stage);
    };
    exact::Dials dials;
    dials.first_guess = exact::Dials::FirstGuess::everything;
    const auto closure = fastpath::close_over_visible(city.bvh, fastpath::Cell(city.cell), some, 0, dials);
    const std::vector<fastpath::PartStage> all{grown, again, least};
    EXPECT_EQ(stages,
              std::vector<fastpath::PartStage>(
                  all.begin(), all.begin() + std::min<std::ptrdiff_t>(3, static_cast<std::ptrdiff_t>(given_up) + 1)));
    EXPECT_EQ(closure.unproved.size(), given_up < 3 ? 0 : city.mesh.triangles.size());
  }
}

// Where rays see half of what counts there is hardly anything to be found out about the rest: all of it is mapped at once, with the effort that is for that; and where this is given up what they saw.
TEST(Closure, BeginsWithAllThatCountsWhereRaysSeeHalf) {
  const SmallCity city;
  std::vector<std::uint8_t> counting(city.mesh.triangles.size(), 0);
  for (const std::uint32_t t : city.whole) counting[t] = 1;
  counting[0] = 1;
  for (const std::size_t given_up : {0, 1}) {
    SCOPED_TRACE(given_up);
    using enum fastpath::PartStage;
    std::vector<fastpath::PartStage> stages;
    std::vector<std::uint32_t> first;
    const auto some = [&](const fastpath::ScenePart& part, fastpath::PartStage stage) {
      const std::vector<std::uint32_t> ids = mapped(part);
      stages.push_back(stage);
      if (stages.size() == 1) first = ids;
      if (stages.size() == 2) {
        EXPECT_LT(ids.size(), first.size());
        EXPECT_TRUE(std::includes(first.begin(), first.end(), ids.begin(), ids.end()));
      }
      return stages.size() <= given_up ? nullptr : city.make_map(part, stage);
    };
    const auto closure = fastpath::close_over_visible(city.bvh, fastpath::Cell(city.cell), some, 1, {}, {}, counting);
    EXPECT_EQ(stages.front(), all);
    for (std::uint32_t t = 0; t < counting.size(); ++t)
      EXPECT_TRUE(counting[t] == 0 || std::binary_search(first.begin(), first.end(), t)) << t;
    EXPECT_EQ(stages.back(), given_up == 0 ? all : least);
    EXPECT_TRUE(closure.unproved.empty());
    EXPECT_TRUE(std::includes(closure.visible.begin(), closure.visible.end(), city.whole.begin(), city.whole.end()));
  }
}

TEST(Closure, TheFirstTriesGetLittleEffort) {
  EXPECT_EQ(fastpath::effort_of_first_try(500), 31U);
  EXPECT_EQ(fastpath::effort_of_first_try(15), 1U) << "not 0, which is without end";
  EXPECT_EQ(fastpath::effort_of_first_try(0), 0U);
  EXPECT_EQ(fastpath::effort_of_next_try(500), 200U);
  EXPECT_EQ(fastpath::effort_of_next_try(2), 1U) << "not 0, which is without end";
  EXPECT_EQ(fastpath::effort_of_next_try(0), 0U);
}

// By the engine itself, which gives up when its effort is spent.
TEST(Closure, AnEffortThatIsSpentListsMoreAndNothingLess) {
  scene::FlaggedMesh scene;
  scene.mesh = fuzz::make_city(1000, 1);
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    scene.blocks.push_back(t % 7 == 0 ? 0 : 1);
    scene.counts.push_back(t % 7 == 1 ? 0 : 1);
  }
  const auto cell = fuzz::street_cell(1000, 1);
  const fastpath::SeeThroughScene through(scene);
  const auto listed_with = [&](std::uint64_t effort) {
    fastpath::LocalMapOptions options;
    options.effort = effort;
    options.dials.sight_rays = 0;  // so that there are several maps
    options.dials.batch = 30;
    return fastpath::visible_through(through, cell, options);
  };
  const auto whole = listed_with(0);
  EXPECT_EQ(whole.conservative_fallbacks, 0U);
  const auto whole_list = whole.counting(scene);
  std::size_t spent = 0, after_a_map = 0;
  for (const std::uint64_t effort : {1, 5, 10, 1000}) {
    SCOPED_TRACE(effort);
    const auto some = listed_with(effort);
    const auto list = some.counting(scene);
    EXPECT_TRUE(std::includes(list.begin(), list.end(), whole_list.begin(), whole_list.end()));
    if (some.conservative_fallbacks == 0) {
      EXPECT_EQ(some.all(), whole.all());
      continue;
    }
    ++spent;
    EXPECT_GT(list.size(), whole_list.size());
    if (some.mapped == 0) {
      EXPECT_EQ(some.all().size(), scene.mesh.triangles.size());
    } else {
      ++after_a_map;
      EXPECT_LT(list.size(), scene.mesh.triangles.size());
    }
  }
  EXPECT_EQ(spent, 3U);
  EXPECT_EQ(after_a_map, 2U);
}

}  // namespace
}  // namespace clues::tests
