// The closure over the exact reference gives the answer of the exact reference alone, from a part of the scene.
#include "fastpath/visibility/closure/closure.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/see_through.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/parts.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/visibility/first_order.h"
#include "scene/cell_spec.h"
#include "tests/differential/reference_part.h"

namespace clues::tests {
namespace {

struct Both {
  std::vector<std::uint32_t> whole;
  fastpath::Closure closure;
};

// No ray is cast, and one triangle of which the proof failed is mapped at a time.
const exact::Dials kByProofsAlone = [] {
  exact::Dials dials;
  dials.first_guess = exact::Dials::FirstGuess::nothing;
  dials.sight_rays = 0;
  dials.batch = 1;
  return dials;
}();

// Without rays, which find nearly all at once, there are several maps.
const exact::Dials kSeveralMaps = [] {
  exact::Dials dials;
  dials.sight_rays = 0;
  dials.batch = 10;
  return dials;
}();

// A small city whose maps a test may give up.
struct SmallCity {
  scene::TriangleMesh mesh = fuzz::make_city(100, 1);
  std::vector<scene::Point> cell = fuzz::street_cell(100, 1);
  exact::ConvexCell exact_cell = exact::ConvexCell::from_doubles(cell);
  std::vector<std::uint32_t> whole = reference::first_order_visibility(mesh, exact_cell, {}).visible;
  fastpath::PartialMapMaker make_map = reference_parts(exact_cell, PartBug::none);
  fastpath::Bvh bvh{mesh};
};

fastpath::Closure close(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell, PartBug bug,
                        const exact::Dials& dials = {}, const std::vector<std::uint32_t>& guess = {},
                        const std::vector<std::uint8_t>& counting = {}) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  const fastpath::Bvh bvh(mesh);
  return fastpath::close_over_visible(bvh, fastpath::Cell(cell), reference_parts(exact_cell, bug), 0, dials, guess,
                                      counting);
}

Both both(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) {
  return {reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell), {}).visible,
          close(mesh, cell, PartBug::none)};
}

TEST(Closure, GivesTheWholeAnswerFromAPartOfACity) {
  for (const std::uint32_t size : {100U, 300U}) {
    SCOPED_TRACE(size);
    const auto [whole, closure] = both(fuzz::make_city(size, 1), fuzz::street_cell(size, 1));
    EXPECT_EQ(closure.visible, whole);
    EXPECT_GT(closure.counts.boxes_dark + closure.counts.triangles_dark, 0);
    EXPECT_LT(closure.part.size(), 3 * whole.size());
  }
}

TEST(Closure, GivesTheWholeAnswerOfRandomScenes) {
  for (const auto kind : fuzz::all_kinds) {
    for (std::uint64_t index = 0; index < 1; ++index) {
      const auto scene = fuzz::generate(kind, 20261121, index);
      SCOPED_TRACE(scene.name);
      const auto [whole, closure] = both(scene.mesh, scene.cell);
      EXPECT_EQ(closure.visible, whole);
    }
  }
}

// A screen with a hole of 2^-10, behind it a small target all in the light, and farther off a large one that light reaches in a small spot away from its
// middle. No sampled ray goes through the hole: it takes the proof of darkness to find them, its question after a point for the one and its question
// after wedges for the other.
TEST(Closure, FindsWhatRaysMissAndIsNoBetterThanItsProofs) {
  scene::TriangleMesh mesh;
  const double a = 0.125, b = 0.125 + 0x1p-10, r = 10;
  const auto quad = [&](double x0, double y0, double x1, double y1) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}) mesh.points.push_back({x, y, 2});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  quad(-r, -r, a, a);
  quad(a, -r, r, a);
  quad(b, a, r, r);
  quad(-r, a, a, b);
  quad(-r, b, b, r);
  const auto triangle = [&](const fastpath::Corners& t) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  triangle({{{-4, -1, 4}, {1, -1, 4}, {1, 5, 4}}});
  triangle({{{0.1875, 0.1875, 3}, {0.203125, 0.1875, 3}, {0.1875, 0.203125, 3}}});
  mesh.face_of.resize(mesh.triangles.size());
  std::iota(mesh.face_of.begin(), mesh.face_of.end(), 0U);
  const auto cell = scene::parse_cell("box:-0.25,-0.25,-0.25,0.25,0.25,0").points;

  const auto [whole, closure] = both(mesh, cell);
  EXPECT_EQ(whole.size(), mesh.triangles.size());
  EXPECT_EQ(closure.visible, whole);
  EXPECT_GT(closure.counts.passes, 1);
  for (const PartBug bug : {PartBug::dark_everywhere, PartBug::wedges_touch_nothing}) {
    EXPECT_EQ(close(mesh, cell, bug).visible.size(), whole.size() - 1);
  }
  // Only what is behind the screen is asked about: strips of the screen that no ray meets need not be listed.
  std::vector<std::uint8_t> counting(mesh.triangles.size(), 0);
  counting.end()[-1] = counting.end()[-2] = 1;
  const auto behind_listed = [&](PartBug bug) {
    const auto listed = close(mesh, cell, bug, {}, {}, counting).visible;
    return std::count_if(listed.begin(), listed.end(), [&](std::uint32_t t) { return counting[t] != 0; });
  };
  EXPECT_EQ(behind_listed(PartBug::none), 2);
  EXPECT_EQ(behind_listed(PartBug::dark_everywhere), 1);
  EXPECT_EQ(behind_listed(PartBug::wedges_touch_nothing), 1);
}

// A plate over the cell, and a second face in it: light from below meets both. The plate is mapped first; the second has to fail its proof, which asks on both
// sides of the plane.
TEST(Closure, AFaceInThePlaneOfALitOneIsAskedAboutOnBothSides) {
  scene::TriangleMesh mesh;
  mesh.points = {{-2, -2, 2}, {2, -2, 2}, {0, 3, 2}, {0, 0, 2}, {0.5, 0, 2}, {0.5, 0.5, 2}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.face_of = {0, 1};
  const auto cell = scene::parse_cell("box:-1,-1,-1,1,1,0").points;
  EXPECT_EQ(close(mesh, cell, PartBug::none, kByProofsAlone).visible, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(close(mesh, cell, PartBug::dark_below, kByProofsAlone).visible.size(), 1);
}

// Blocks of whole numbers that stand flush on a floor, in rows, with tops of a few heights, and cells of whole numbers among them: what light does not meet it
// grazes, mostly.
struct Blocks {
  scene::TriangleMesh mesh;
  std::vector<scene::Point> cell;
};

Blocks blocks(std::uint64_t seed, int rows) {
  fuzz::Random random(seed);
  Blocks out;
  const auto quad = [&](const std::vector<scene::Point>& p, std::array<std::size_t, 4> corner) {
    const auto first = static_cast<std::uint32_t>(out.mesh.points.size());
    for (const std::size_t i : corner) out.mesh.points.push_back(p[i]);
    out.mesh.triangles.push_back({first, first + 1, first + 2});
    out.mesh.triangles.push_back({first, first + 2, first + 3});
  };
  const double half = 3.0 * rows;
  quad({{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}, {0, 1, 2, 3});
  for (int x = -rows; x < rows; ++x) {
    for (int y = -rows; y < rows; ++y) {
      if (x == 0 && y == 0) continue;  // the cell's place
      const double height = 1 + static_cast<double>(random.next() % 4);
      const auto p = fuzz::box_of({3.0 * x, 3.0 * y, 0}, {3.0 * x + 2, 3.0 * y + 2, height});
      for (const auto& q : {std::array<std::size_t, 4>{0, 2, 3, 1},
                            {4, 5, 7, 6},
                            {0, 1, 5, 4},
                            {2, 6, 7, 3},
                            {0, 4, 6, 2},
                            {1, 3, 7, 5}})
        quad(p, q);
    }
  }
  out.mesh.face_of.resize(out.mesh.triangles.size());
  std::iota(out.mesh.face_of.begin(), out.mesh.face_of.end(), 0U);
  const double low = static_cast<double>(random.next() % 2);
  out.cell = fuzz::box_of({0, 0, low}, {1 + static_cast<double>(random.next() % 2), 2, low + 1});
  return out;
}

TEST(Closure, WhatLightOnlyGrazesIsHidden) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const Blocks scene = blocks(seed, 1);
    const auto [whole, closure] = both(scene.mesh, scene.cell);
    EXPECT_EQ(closure.visible, whole);
  }
  // The engine, from a guess by rays and from none, against itself without a closure.
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const Blocks scene = blocks(seed, 2 + static_cast<int>(seed % 2));
    const fastpath::Bvh bvh(scene.mesh);
    using Guess = exact::Dials::FirstGuess;
    std::vector<std::uint32_t> whole;
    for (const Guess guess : {Guess::everything, Guess::seen, Guess::nothing}) {
      fastpath::LocalMapOptions options;
      options.dials.first_guess = guess;
      const fastpath::FirstOrder answer = fastpath::first_order_visibility(bvh, scene.cell, options);
      if (guess == Guess::everything) whole = answer.visible;
      EXPECT_EQ(answer.visible, whole);
      EXPECT_EQ(answer.conservative_fallbacks, 0);
      EXPECT_EQ(answer.part.size() < scene.mesh.triangles.size(), guess != Guess::everything);
    }
  }
}

// All but one triangle are mapped from the start: most are dark, and leave with the first map.
TEST(Closure, DropsWhatLightDoesNotTouch) {
  const auto mesh = fuzz::make_city(300, 1);
  const auto cell = fuzz::street_cell(300, 1);
  const auto whole = reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell), {}).visible;
  std::vector<std::uint32_t> guess(mesh.triangles.size());
  std::iota(guess.begin(), guess.end(), 0U);
  std::erase(guess, whole.back());
  const auto closure = close(mesh, cell, PartBug::none, kByProofsAlone, guess);
  EXPECT_EQ(closure.visible, whole);
  EXPECT_EQ(closure.counts.passes, 2);
  EXPECT_LT(closure.part.size(), guess.size() / 2);
}

// A plate, and behind it a triangle that touches the border of its umbra, so that its proof fails as long as it is not mapped. All rays to it meet the plate, which the planted map calls dark: were it taken
// up again each time, as rays that begin beside the cell by a rounding might ask for, the loop would not end.
TEST(Closure, EndsThoughARayMeetsWhatIsDark) {
  scene::TriangleMesh mesh;
  mesh.points = {{-40, 2, 1}, {40, 2, 1}, {0, -60, 1}, {0, 3, 2}, {1, 3, 2}, {0.5, 2.5, 2}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.face_of = {0, 1};
  const auto cell = scene::parse_cell("box:-1,-1,0,1,1,0").points;
  const auto right = close(mesh, cell, PartBug::none);
  EXPECT_EQ(right.visible, std::vector<std::uint32_t>{0});
  EXPECT_EQ(right.part, (std::vector<std::uint32_t>{0, 1}));
  const auto planted = close(mesh, cell, PartBug::unlit);
  EXPECT_EQ(planted.counts.passes, 2);
  EXPECT_EQ(planted.part, std::vector<std::uint32_t>{1});
}

// Every third triangle is asked about, or none. What the list holds of these is all that is visible, and little else; less is mapped than if all were asked about.
TEST(Closure, NeedsNoProofOfWhatDoesNotCount) {
  std::size_t mapped = 0, mapped_of_all = 0, listed = 0, visible = 0;
  for (const auto kind : fuzz::all_kinds) {
    const auto scene = fuzz::generate(kind, 20261125, 0);
    SCOPED_TRACE(scene.name);
    std::vector<std::uint8_t> counting(scene.mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < counting.size(); t += 3) counting[t] = 1;
    const auto [whole, all] = both(scene.mesh, scene.cell);
    for (const bool by_rays : {true, false}) {
      const auto dials = by_rays ? exact::Dials{} : kByProofsAlone;
      const auto closure = close(scene.mesh, scene.cell, PartBug::none, dials, {}, counting);
      for (const std::uint32_t t : whole) {
        EXPECT_TRUE(counting[t] == 0 || std::binary_search(closure.visible.begin(), closure.visible.end(), t)) << t;
      }
      if (!by_rays) continue;
      const auto counts = [&](std::uint32_t t) { return counting[t] != 0; };
      listed += static_cast<std::size_t>(std::count_if(closure.visible.begin(), closure.visible.end(), counts));
      visible += static_cast<std::size_t>(std::count_if(whole.begin(), whole.end(), counts));
      mapped += closure.part.size();
      mapped_of_all += all.part.size();
    }
    std::fill(counting.begin(), counting.end(), 0);
    EXPECT_EQ(close(scene.mesh, scene.cell, PartBug::none, kByProofsAlone, {}, counting).counts.passes, 1);
  }
  EXPECT_LE(mapped, mapped_of_all);
  EXPECT_LE(listed, visible + visible / 10);
}

// Whichever map is given up: what is visible is listed, as light meets it in the map before or as there is no proof. And what is listed without need is no more than what lacks a proof.
TEST(Closure, ListsWhatIsVisibleWhereAMapIsGivenUp) {
  const SmallCity city;
  std::size_t listed_before = city.mesh.triangles.size() + 1, given_up = 0;
  for (std::uint64_t most = 0;; ++most) {
    SCOPED_TRACE(most);
    std::uint64_t made = 0;
    const auto some = [&](const scene::TriangleMesh& part, const std::vector<std::uint32_t>& ids,
                          fastpath::PartStage stage) {
      return made++ < most ? city.make_map(part, ids, stage) : nullptr;
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
      std::size_t counting_in_second = 0;
      std::vector<fastpath::PartStage> stages;
      std::vector<std::vector<std::uint32_t>> hulls;  // of all maps asked for, what does not count
      const auto some = [&](const scene::TriangleMesh& part, const std::vector<std::uint32_t>& ids,
                            fastpath::PartStage stage) {
        std::copy_if(ids.begin(), ids.end(), std::back_inserter(hulls.emplace_back()),
                     [&](std::uint32_t t) { return counting[t] == 0; });
        const std::uint64_t number = made++;
        if (number == first + 1) counting_in_second = static_cast<std::size_t>(counted(ids));
        stages.push_back(stage);
        return number == first || number == second || number == third ? nullptr : city.make_map(part, ids, stage);
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
      EXPECT_EQ(counting_in_second, std::count(counting.begin(), counting.end(), 1));
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
    const auto some = [&](const scene::TriangleMesh& part, const std::vector<std::uint32_t>& ids,
                          fastpath::PartStage stage) {
      const std::size_t number = parts.size();
      parts.push_back(ids);
      stages.push_back(stage);
      return number == first || number == first + 1 ? nullptr : city.make_map(part, ids, stage);
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
    const auto some = [&](const scene::TriangleMesh& part, const std::vector<std::uint32_t>& ids,
                          fastpath::PartStage stage) {
      EXPECT_EQ(ids.size(), city.mesh.triangles.size());
      stages.push_back(stage);
      return stages.size() <= given_up ? nullptr : city.make_map(part, ids, stage);
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

TEST(Closure, TheFirstTriesGetLittleEffort) {
  EXPECT_EQ(fastpath::effort_of_first_try(500), 31U);
  EXPECT_EQ(fastpath::effort_of_first_try(15), 1U) << "not 0, which is without end";
  EXPECT_EQ(fastpath::effort_of_first_try(0), 0U);
  EXPECT_EQ(fastpath::effort_of_next_try(500), 200U);
  EXPECT_EQ(fastpath::effort_of_next_try(2), 1U) << "not 0, which is without end";
  EXPECT_EQ(fastpath::effort_of_next_try(0), 0U);
}

// What a scene remembers from cell to cell changes nothing: triangles that pierce each other, and cells whose borders cut some.
TEST(Closure, ASceneThatServesManyCellsAnswersAsAFreshOneDoes) {
  scene::FlaggedMesh scene;
  for (std::uint64_t i = 0; i < 8; ++i) {
    const scene::TriangleMesh part = fuzz::generate(fuzz::Kind::interpenetrating, 20261128, i).mesh;
    const auto first = static_cast<std::uint32_t>(scene.mesh.points.size());
    for (scene::Point p : part.points) {
      p[0] += 40.0 * static_cast<double>(i);
      scene.mesh.points.push_back(p);
    }
    for (const scene::Triangle& t : part.triangles) {
      scene.mesh.face_of.push_back(static_cast<std::uint32_t>(scene.mesh.triangles.size()));
      scene.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  ASSERT_GT(scene.mesh.triangles.size(), fastpath::kMappedWhole);
  const fastpath::SeeThroughScene served(scene);
  fastpath::LocalMapOptions options;
  options.dials.sight_rays = 0;  // so that there are several maps
  options.dials.batch = 10;
  options.effort = 20;
  std::uint64_t most_passes = 0, least_mapped = scene.mesh.triangles.size();
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    const double x = 3.0 * k - 5;
    std::vector<scene::Point> cell;
    for (int c = 0; c < 8; ++c) cell.push_back({x + 9 * (c & 1), (c & 2) != 0 ? 5.0 : -4.0, (c & 4) != 0 ? 5.0 : -4.0});
    const auto list = fastpath::visible_through(served, cell, options);
    const auto fresh = fastpath::visible_through(fastpath::SeeThroughScene(scene), cell, options);
    EXPECT_EQ(list.all(), fresh.all());
    EXPECT_EQ(list.walks, fresh.walks);
    EXPECT_EQ(list.mapped, fresh.mapped);
    EXPECT_EQ(list.passes, fresh.passes);
    EXPECT_EQ(list.conservative_fallbacks, fresh.conservative_fallbacks);
    most_passes = std::max(most_passes, list.passes);
    least_mapped = std::min(least_mapped, list.mapped);
  }
  EXPECT_GT(most_passes, 1U);
  EXPECT_LT(least_mapped, scene.mesh.triangles.size());
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

TEST(Closure, IsTheSameForAnyNumberOfThreads) {
  const auto mesh = fuzz::make_city(300, 1);
  const auto cell = fuzz::street_cell(300, 1);
  std::vector<std::uint32_t> part;
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena arena(threads);
    const auto closure = arena.execute([&] { return close(mesh, cell, PartBug::none); });
    if (part.empty()) part = closure.part;
    EXPECT_EQ(closure.part, part);
  }
}

}  // namespace
}  // namespace clues::tests
