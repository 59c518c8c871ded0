// The closure over the exact reference gives the answer of the exact reference alone, from a part of the scene.
#include "fastpath/visibility/closure/closure.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
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

fastpath::Closure close(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell, PartBug bug,
                        const exact::Dials& dials = {}, const std::vector<std::uint32_t>& guess = {},
                        const std::vector<std::uint8_t>& counting = {},
                        fastpath::Wanted wanted = fastpath::Wanted::map) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  const fastpath::Bvh bvh(mesh);
  return fastpath::close_over_visible(bvh, fastpath::Cell(cell), reference_parts(exact_cell, bug), 0, dials, guess,
                                      counting, wanted);
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

// A plate over the cell, and a second face in it: light from below meets both. The plate is mapped first; the second has to fail its proof, which asks on the
// side of the plane that the cell is on.
TEST(Closure, AFaceInThePlaneOfALitOneIsAskedAboutOnTheSideOfTheCell) {
  scene::TriangleMesh mesh;
  mesh.points = {{-2, -2, 2}, {2, -2, 2}, {0, 3, 2}, {0, 0, 2}, {0.5, 0, 2}, {0.5, 0.5, 2}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.face_of = {0, 1};
  const auto cell = scene::parse_cell("box:-1,-1,-1,1,1,0").points;
  EXPECT_EQ(close(mesh, cell, PartBug::none, kByProofsAlone).visible, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(close(mesh, cell, PartBug::dark_below, kByProofsAlone).visible.size(), 0);
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
  const auto quad = [&](const std::vector<scene::Point>& p, std::array<std::uint32_t, 4> corner) {
    const auto first = static_cast<std::uint32_t>(out.mesh.points.size());
    for (const std::uint32_t i : corner) out.mesh.points.push_back(p[i]);
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
      for (const auto& q : fuzz::box_sides) quad(p, q);
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
      EXPECT_EQ(answer.closure.mapped < scene.mesh.triangles.size(), guess != Guess::everything);
    }
  }
}

// From no guess at all, one failed proof or ten at a time, the engine lists what it lists of the whole scene; what is dark comes in beside the part.
TEST(Closure, APartAndWhatIsDarkBesideItListWhatAllOfTheSceneDoes) {
  std::size_t beside = 0, mapped = 0, scenes = 0;
  for (const auto kind : fuzz::all_kinds) {
    for (std::uint64_t index = 0; index < 4; ++index) {
      const auto scene = fuzz::generate(kind, 20261129, index);
      SCOPED_TRACE(scene.name);
      const fastpath::Bvh bvh(scene.mesh);
      fastpath::LocalMapOptions all;
      all.dials.first_guess = exact::Dials::FirstGuess::everything;
      const fastpath::FirstOrder whole = fastpath::first_order_visibility(bvh, scene.cell, all);
      if (whole.conservative_fallbacks > 0) continue;  // what is in doubt may be proved dark in a part
      ++scenes;
      for (const int batch : {1, 10}) {
        fastpath::LocalMapOptions options;
        options.dials = kByProofsAlone;
        options.dials.batch = static_cast<std::size_t>(batch);
        const fastpath::FirstOrder part = fastpath::first_order_visibility(bvh, scene.cell, options);
        EXPECT_EQ(part.visible, whole.visible);
        beside += part.part.size() - part.closure.mapped;
        mapped += part.closure.mapped;
      }
    }
  }
  EXPECT_GT(scenes, 20U);
  EXPECT_GT(beside, mapped / 20);
}

// Corners on a prism with eight sides about the first point of a cell: more than a box has.
std::vector<scene::Point> prism_about(const scene::Point& p) {
  std::vector<scene::Point> corners;
  for (int i = 0; i < 16; ++i) {
    const double angle = (i / 2 + 0.3) * 0.78539816339744831;
    corners.push_back({p[0] + 0.75 * std::cos(angle), p[1] + 0.75 * std::sin(angle), p[2] + (i % 2 == 0 ? 0.5 : -0.5)});
  }
  return corners;
}

// What is open after the map of a part, mapped alone, gives the list that a map of all of it gives: with the reference, from half of what is visible, and with the engine.
TEST(Closure, WhatIsOpenAloneListsWhatAllOfThePartDoes) {
  std::size_t settled = 0;
  for (const std::uint32_t size : {100U, 300U}) {
    const auto mesh = fuzz::make_city(size, 1);
    const auto cell = fuzz::street_cell(size, 1);
    const auto whole = reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell), {}).visible;
    std::vector<std::uint32_t> half;
    for (std::size_t i = 0; i < whole.size(); i += 2) half.push_back(whole[i]);
    exact::Dials dials;
    dials.first_guess = exact::Dials::FirstGuess::nothing;
    dials.open_percent = 100;
    const auto closure = close(mesh, cell, PartBug::none, dials, half, {}, fastpath::Wanted::list);
    EXPECT_EQ(closure.visible, whole);
    settled += closure.counts.settled;
  }
  EXPECT_GT(settled, 20U);
  std::size_t scenes = 0, alone = 0;
  for (const auto kind : fuzz::all_kinds) {
    for (std::uint64_t index = 0; index < 8; ++index) {
      const auto scene = fuzz::generate(kind, 20261130, index);
      SCOPED_TRACE(scene.name);
      const fastpath::Bvh bvh(scene.mesh);
      const auto cell = index % 4 == 3 ? prism_about(scene.cell[0]) : scene.cell;
      const auto list = [&](std::int64_t percent) {
        fastpath::LocalMapOptions options;
        options.dials.first_guess = exact::Dials::FirstGuess::nothing;
        options.dials.sight_rays = 100;
        options.dials.open_percent = percent;
        return fastpath::first_order_visibility(bvh, cell, options);
      };
      const auto all = list(0), open = list(100);
      if (all.conservative_fallbacks > 0) continue;  // what is in doubt may be proved dark in a part
      ++scenes;
      EXPECT_EQ(open.visible, all.visible);
      EXPECT_TRUE(std::includes(open.part.begin(), open.part.end(), open.visible.begin(), open.visible.end()));
      alone += open.closure.settled > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(scenes, 40U);
  EXPECT_GT(alone, 20U);
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

// What a scene remembers from cell to cell changes nothing: triangles that pierce each other, and cells whose borders cut some.
TEST(Closure, ASceneThatServesManyCellsAnswersAsAFreshOneDoes) {
  scene::FlaggedMesh scene;
  for (std::uint64_t i = 0; i < 8; ++i) {
    scene::TriangleMesh part = fuzz::generate(fuzz::Kind::interpenetrating, 20261128, i).mesh;
    for (scene::Point& p : part.points) p[0] += 40.0 * static_cast<double>(i);
    for (const auto& [a, b, c] : part.triangles) fuzz::add(scene.mesh, part.points[a], part.points[b], part.points[c]);
  }
  ASSERT_GT(scene.mesh.triangles.size(), fastpath::kMappedWhole);
  const fastpath::SeeThroughScene served(scene);
  fastpath::LocalMapOptions options;
  options.dials = kSeveralMaps;
  options.effort = 20;
  std::uint64_t most_passes = 0, least_mapped = scene.mesh.triangles.size();
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    const double x = 3.0 * k - 5;
    const auto cell = fuzz::box_of({x, -4, -4}, {x + 9, 5, 5});
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
