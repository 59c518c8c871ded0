// The identities of D24: on random scenes, on the suite, and between leaves of a real level, region for region.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "exact/cell/touching.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/formats/file_bytes.h"
#include "scene/levels/bsp_scene.h"
#include "tests/delta/identities.h"
#include "tests/levels/real_levels.h"
#include "tests/seed.h"
#include "validate/vectors/reader.h"

namespace clues::test {
namespace {

void expect_on_random_scenes(fuzz::Kind kind, std::uint64_t first, std::uint64_t end, TransitionSums& sums) {
  for (std::uint64_t i = first; i < end; ++i) {
    const auto scene = fuzz::generate(kind, kSeed, i);
    SCOPED_TRACE(scene.name);
    expect_identities_of_halves(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), {}, sums);
  }
}

TEST(DeltaIdentities, HoldOnRandomScenes) {
  TransitionSums sums;
  for (const fuzz::Kind kind : fuzz::all_kinds) expect_on_random_scenes(kind, 0, 2, sums);
  expect_seen_something(sums);
}

// Six kinds, fifty of each: three hundred. A test for each kind, so that they can be run side by side.
class DeltaIdentitiesLong : public ::testing::TestWithParam<fuzz::Kind> {};

TEST_P(DeltaIdentitiesLong, HoldOnFiftyRandomScenes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  TransitionSums sums;
  expect_on_random_scenes(GetParam(), 2, 52, sums);
  expect_seen_something(sums);
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, DeltaIdentitiesLong, ::testing::ValuesIn(fuzz::all_kinds), [](const auto& kind) {
  std::string name = fuzz::name_of(kind.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// The suite: every case with a solid cell, each `step`-th of them.
void expect_on_the_suite(std::size_t first, std::size_t step) {
  TransitionSums sums;
  const auto suite = validate::read_suite(CLUES_SOURCE_DIR "/vectors");
  for (std::size_t i = first; i < suite.size(); i += step) {
    SCOPED_TRACE(suite[i].id);
    reference::Options options;
    if (suite[i].mode == validate::CaseMode::solid) options.mode = reference::Mode::solid;
    expect_identities_of_halves(suite[i].mesh, exact::ConvexCell::from_doubles(suite[i].cell), options, sums);
  }
  expect_seen_something(sums);
}

TEST(DeltaIdentities, HoldOnPartOfTheSuite) { expect_on_the_suite(0, 30); }

TEST(DeltaIdentitiesOfTheSuiteLong, HoldOnAllOfIt) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_on_the_suite(0, 1);
}

// What blocks in a level, as the scene; as cells those of its leaves whose shipped lists are short, so that maps are
// quick.
struct LevelWithLeaves {
  scene::TriangleMesh blocks;
  std::vector<std::vector<scene::Point>> cells;
  std::vector<std::uint32_t> leaves;

  LevelWithLeaves(const std::filesystem::path& file, std::size_t most_shipped) {
    const auto level = scene::parse_bsp(scene::read_file_bytes(file), file.string());
    const auto made = scene::scene_of_level(level);
    blocks = scene::part_of(made.scene.mesh, scene::blocking_ids(made.scene));
    for (const auto& cell : scene::cells_of_level(level)) {
      if (cell.outer.empty() || scene::shipped_set(level, made, cell.cluster).size() > most_shipped) continue;
      cells.push_back(cell.outer);
      leaves.push_back(cell.leaf);
    }
  }
};

// In the whole level. The fast path's lists are the second way to what the maps list: these may have more, of what is
// in doubt (D17b), where the fast path met less of the scene.
TEST(DeltaIdentitiesOfALevelLong, HoldBetweenItsLeaves) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  const tests::TestFolder folder;
  const auto [levels, why_not] = tests::real_levels(folder);
  if (levels.empty()) GTEST_SKIP() << why_not;
  const LevelWithLeaves part(levels / "oa_bases5.bsp", 120);
  std::vector<exact::ConvexCell> hulls;
  for (const auto& points : part.cells) hulls.push_back(exact::ConvexCell::from_doubles(points));
  const fastpath::Bvh bvh(part.blocks);
  TransitionSums sums;
  std::uint64_t listed = 0, more = 0;
  const auto neighbours = exact::touching_cells(hulls);
  for (std::uint32_t a = 0; a < hulls.size(); ++a) {
    for (const std::uint32_t b : neighbours[a]) {
      if (b < a) continue;  // both ways are asked at once
      SCOPED_TRACE("leaves " + std::to_string(part.leaves[a]) + " and " + std::to_string(part.leaves[b]));
      const auto record = expect_identities(part.blocks, hulls[a], hulls[b], {}, sums);
      for (const auto& [cell, end] : {std::pair(a, &record.from), {b, &record.to}}) {
        const auto fast = fastpath::first_order_visibility(bvh, part.cells[cell], {}).visible;
        EXPECT_TRUE(std::includes(end->visible.begin(), end->visible.end(), fast.begin(), fast.end()));
        more += end->visible.size() - fast.size();
        listed += fast.size();
      }
    }
  }
  std::cout << "a level of " << part.blocks.triangles.size() << " triangles, " << hulls.size()
            << " leaves of it; the fast path's lists have " << listed << " triangles, those of the maps " << more
            << " more\n";
  expect_seen_something(sums);
  EXPECT_GE(sums.transitions, 4U);
}

}  // namespace
}  // namespace clues::test
