// Refined maps (D20, D21, T4) against what shares no algorithm with them: the point-occlusion oracle, exact sight lines and the exact visible set. All generators,
// about a thousand small scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "exact/sight/point_occlusion.h"
#include "fuzz/campaign/generators.h"
#include "judges.h"
#include "tests/seed.h"
#include "validate/verdicts/precision.h"
#include "validate/visible_set/visible_set.h"

namespace clues::test {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Plane3;
using exact::Point3;
using reference::Bounds;
using reference::side_index;
using validate::Refinement;

struct Judged {
  std::uint64_t scenes = 0, gained = 0, decided = 0, points = 0, witnessed_points = 0;
};

std::ostream& operator<<(std::ostream& out, const Judged& j) {
  return out << j.scenes << " scenes, " << j.gained << " with less area than first-order, " << j.decided << " decided; "
             << j.points << " hidden points, " << j.witnessed_points << " faces of the lower bound";
}

// After triangles were cut by each other and by the cell: maps of many pieces take minutes.
std::size_t pieces_of(const fuzz::Case& scene, const ConvexCell& cell) {
  return exact::build_complex(scene.mesh, &cell).pieces.size();
}

// lower in E in upper in the first-order map, as far as three independent judges can tell.
void judge(const fuzz::Case& scene, Refinement by, int depth, std::size_t points, Judged& judged) {
  SCOPED_TRACE(scene.generator + ", seed " + std::to_string(scene.seed) + ", index " + std::to_string(scene.index));
  const ConvexCell cell = ConvexCell::from_doubles(scene.cell);
  reference::Options options;
  if (scene.solid) options.mode = reference::Mode::solid;
  Bounds bounds(scene.mesh, cell, options);
  const reference::SideSets first = bounds.upper();
  const auto depths = validate::refine(bounds, by, {depth, 0}).depths;
  ++judged.scenes;
  judged.gained += depths.back().area.upper < depths.back().area.first_order;
  judged.decided += bounds.closed();
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(subtract(bounds.lower()[i], bounds.upper()[i]).empty()) << "side " << i;
    EXPECT_TRUE(subtract(bounds.upper()[i], first[i]).empty()) << "side " << i;
  }

  const auto map = bounds.refined_map("refined");
  const Contradictions c = contradictions(map, points, kSeed);
  EXPECT_EQ(c.total(), 0U);
  judged.points += c.points;
  std::vector<FT> covered(first.size(), FT(0)), of_first_order(first.size(), FT(0));
  for (const auto& r : map.regions) covered[side_index(r.piece, r.front)] += r.area_fraction;
  for (const auto& r : bounds.first_order().regions) of_first_order[side_index(r.piece, r.front)] += r.area_fraction;
  EXPECT_EQ(covered, of_first_order);

  validate::VisibleSetOptions exhaustive;
  exhaustive.mode = options.mode;
  const auto visible = validate::exact_visible_set(scene.mesh, cell, exhaustive);
  for (std::uint32_t t = 0; t < visible.triangles.size(); ++t) {
    if (visible.triangles[t].sight != validate::Sight::visible) continue;
    EXPECT_TRUE(std::binary_search(map.visible.begin(), map.visible.end(), t)) << "triangle " << t << " is visible";
  }

  // Points of the lower bound are seen.
  std::vector<exact::TriangleCorners> corners;
  for (std::uint32_t t = 0; t < map.complex.pieces.size(); ++t) {
    if (map.complex.in_cell[t]) continue;
    const auto& p = map.complex.pieces[t].corners;
    corners.push_back({map.complex.points[p[0]], map.complex.points[p[1]], map.complex.points[p[2]]});
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto t = static_cast<std::uint32_t>(i / 2);
    if (map.complex.in_cell[t]) continue;
    const reference::TriangleFrame frame(map.complex, t);
    const Plane3 side = i % 2 == 0 ? map.complex.planes[t] : map.complex.planes[t].opposite();
    for (const auto& face : bounds.lower()[i].faces()) {
      // Between what two viewpoints see there may be a line that neither sees (the sets have no seams): a point beside it then.
      const exact::Point2 q = reference::inner_point(face, 0), &a = face[0][0], &b = face[0][1];
      const auto is_seen = [&](const exact::Point2& x) {
        return !exact::point_occlusion(frame.lift(x), side, cell, corners).occluded;
      };
      EXPECT_TRUE(is_seen(q) || is_seen(q + (a - q) / FT(1009) + (b - q) / FT(2003))) << "side " << i;
      ++judged.witnessed_points;
    }
  }
}

struct Limits {
  std::uint64_t scenes;
  int depth;
  std::size_t points, most_pieces;  // of a scene; twice as many, and so on, for a generator that makes none so small
};

Judged judge_generator(const fuzz::NamedGenerator& generator, Refinement by, const Limits& limits) {
  Judged judged;
  for (std::size_t most = limits.most_pieces; judged.scenes == 0 && most < 1000; most *= 2) {
    for (std::uint64_t i = 0; judged.scenes < limits.scenes && i < 20 * limits.scenes; ++i) {
      const auto scene = generator.make(kSeed, i);
      if (scene.mesh.triangles.size() > most) continue;
      if (pieces_of(scene, ConvexCell::from_doubles(scene.cell)) > most) continue;
      judge(scene, by, limits.depth, limits.points, judged);
      if (judged.scenes % 5 == 0) std::cout << generator.name << " up to index " << i << ": " << judged << std::endl;
    }
  }
  std::cout << generator.name << ", " << validate::name_of(by) << ", seed " << kSeed << ", depth " << limits.depth
            << ": " << judged << std::endl;
  return judged;
}

void judge_few(Refinement by, int depth) {
  const fuzz::GivenScenes none;
  Judged all;
  for (const auto& generator : fuzz::generators_named({"loose_triangles", "open_sheets", "axis_boxes"}, none)) {
    const Judged judged = judge_generator(generator, by, {2, depth, 2, 16});
    all.gained += judged.gained;
    all.points += judged.points;
  }
  EXPECT_GT(all.points, 0U);
}

TEST(RefinedSoundness, ByCells) { judge_few(Refinement::cells, 2); }
TEST(RefinedSoundness, ByBackprojection) { judge_few(Refinement::backprojection, 2); }

// One test for each generator and kind of refinement, so that they run side by side.
class RefinedSoundnessLong : public testing::TestWithParam<std::tuple<std::string, Refinement>> {};

TEST_P(RefinedSoundnessLong, NothingHiddenIsSeen) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  const fuzz::GivenScenes none;
  const auto& [name, by] = GetParam();
  const Judged judged = judge_generator(fuzz::generators_named({name}, none).at(0), by, {21, 2, 2, 24});
  EXPECT_GT(judged.scenes, 0U);
}

std::vector<std::string> generator_names() {
  const fuzz::GivenScenes none;
  std::vector<std::string> names;
  for (const auto& generator : fuzz::generators_named({}, none)) names.push_back(generator.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Generators, RefinedSoundnessLong,
                         testing::Combine(testing::ValuesIn(generator_names()),
                                          testing::Values(Refinement::cells, Refinement::backprojection)),
                         [](const auto& test) {
                           std::string name = std::get<0>(test.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_by_" + validate::name_of(std::get<1>(test.param));
                         });

}  // namespace
}  // namespace clues::test
