// What a bake lists draws what the whole scene draws, pixel for pixel; without a triangle that is seen it does not.
#include "pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scene/bakes/bake_store.h"
#include "scene/levels/bsp_scene.h"
#include "tests/app/program.h"
#include "tests/levels/made_level.h"
#include "tests/point_within.h"

namespace clues::tests {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(Pictures, EachPixelIsTheNearestTriangle) {
  scene::TriangleMesh mesh;
  for (const double z : {3.0, 2.0}) {
    for (const scene::Point& p : {scene::Point{-9, -9, z}, scene::Point{9, -9, z}, scene::Point{0, 9, z}})
      mesh.points.push_back(p);
  }
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.face_of = {0, 1};
  Pictures pictures(33, 0.125, 64);
  const auto middle = [&](const Ids& coloured, const Ids& plain, int direction) {
    return pictures.draw(mesh, coloured, plain, {0, 0, 0}, direction)[33 * 16 + 16];
  };
  EXPECT_EQ(middle({0, 1}, {}, 5), 3U);
  EXPECT_EQ(middle({0}, {}, 5), 2U);
  EXPECT_EQ(middle({0}, {1}, 5), 1U);
  EXPECT_EQ(middle({0, 1}, {}, 4), 0U) << "behind the eye";
  EXPECT_EQ(middle({0, 1}, {}, 0), 0U);
}

TEST(Pictures, ABakedListDrawsWhatTheLevelDraws) {
  const TestFolder folder;
  const auto bytes = two_rooms().bytes();
  folder.write("made.bsp", bytes);
  ASSERT_EQ(run_clues({"bake", "made.bsp", "--cells", "leaves", "-o", "made.bake"}, folder.path()).exit_code, 0);
  const scene::FinishedBake bake(folder.path() / "made.bake");
  const auto level = scene::scene_of_level(scene::parse_bsp(bytes, "made.bsp")).scene;
  Ids all, hulls;  // hulls are not drawn by games; what they hide is hidden by walls that have no picture
  for (std::uint32_t t = 0; t < level.mesh.triangles.size(); ++t) (level.counting(t) ? all : hulls).push_back(t);
  Pictures pictures(64, 0.0625, 4096);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0.1, 1);
  std::size_t views = 0, without = 0;
  for (std::uint32_t c = 0; c < bake.plan().cells.size(); ++c) {
    const auto& cell = bake.plan().cells[c];
    const Ids list = bake.cell(c).list;
    for (int i = 0; i < 4; ++i) {
      const scene::Point eye = point_within(cell.inner, [&] { return weight(random); });
      for (int direction = 0; direction < 6; ++direction, ++views) {
        const auto whole = pictures.draw(level.mesh, all, hulls, eye, direction);
        EXPECT_EQ(whole, pictures.draw(level.mesh, list, hulls, eye, direction)) << cell.name << " " << direction;
        const auto seen = std::find_if(whole.begin(), whole.end(), [](std::uint32_t pixel) { return pixel >= 2; });
        if (seen == whole.end()) continue;
        Ids fewer = list;
        std::erase(fewer, *seen - 2);
        EXPECT_NE(whole, pictures.draw(level.mesh, fewer, hulls, eye, direction));
        ++without;
      }
    }
  }
  EXPECT_GE(views, 48U);
  EXPECT_GE(without, 20U);
}

}  // namespace
}  // namespace clues::tests
