// What `clues bake --export` gives to engines, read with the header that engines get: a point of a cell gets the list of that cell, at least.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include "app/engine/clues_pvs.h"
#include "scene/bakes/bake_store.h"
#include "scene/formats/file_bytes.h"
#include "scene/levels/bsp_scene.h"
#include "tests/app/program.h"
#include "tests/levels/made_level.h"

namespace clues::tests {
namespace {

using scene::Point;

struct Loaded {
  std::vector<std::uint64_t> words;  // aligned
  const clues_pvs* pvs = nullptr;
};

Loaded load(const std::string& bytes) {
  Loaded file;
  file.words.resize((bytes.size() + 7) / 8);
  std::memcpy(file.words.data(), bytes.data(), bytes.size());
  file.pvs = clues_pvs_open(file.words.data(), bytes.size());
  return file;
}

std::vector<std::uint32_t> cells_at(const clues_pvs* pvs, const Point& p) {
  std::vector<std::uint32_t> cells(64);
  cells.resize(clues_pvs_cells(pvs, p.data(), cells.data(), cells.size()));
  return cells;
}

Point mixed(const std::vector<Point>& points, std::mt19937& random) {
  Point p{};
  double sum = 0;
  for (const auto& q : points) {
    // Often on a face, an edge or a corner.
    const double weight = random() % 3 == 0 ? 0 : std::uniform_real_distribution<double>(0, 1)(random);
    sum += weight;
    for (std::size_t i = 0; i < 3; ++i) p[i] += weight * q[i];
  }
  if (sum == 0) return points[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [i](const Point& a, const Point& b) { return a[i] < b[i]; });
    p[i] = std::clamp(p[i] / sum, (*low)[i], (*high)[i]);  // the header allows for roundings within the box
  }
  return p;
}

void expect_lists_of_cells(const TestFolder& folder, const std::string& bake, const std::string& exported) {
  const auto file = load(read_all(folder.path() / exported / "engine.cluespvs"));
  ASSERT_NE(file.pvs, nullptr);
  const scene::FinishedBake baked(folder.path() / bake);
  EXPECT_EQ(file.pvs->cells, baked.plan().cells.size());
  EXPECT_EQ(file.pvs->triangles, baked.plan().triangles);
  std::mt19937 random(1);
  for (std::uint32_t c = 0; c < file.pvs->cells; ++c) {
    std::size_t count = 0;
    const auto* list = clues_pvs_triangles(file.pvs, c, &count);
    EXPECT_EQ(std::vector<std::uint32_t>(list, list + count), baked.cell(c).list);
    const auto& points = baked.plan().cells[c].points;
    for (const auto& p : points) EXPECT_THAT(cells_at(file.pvs, p), testing::Contains(c));
    for (int i = 0; i < 200; ++i) EXPECT_THAT(cells_at(file.pvs, mixed(points, random)), testing::Contains(c));
  }
  for (const Point& far : {Point{1e9, 0, 0}, Point{0, -1e300, 0}, Point{NAN, 0, 0}, Point{0, INFINITY, 0}})
    EXPECT_TRUE(cells_at(file.pvs, far).empty());
}

TEST(EngineFile, HoldsTheListsOfAGrid) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const auto ran = run_clues({"bake", "scene.off", "--cells", "grid:3x2x2:box:-0.3,-0.25,-0.25,0.3,0.25,0.1", "-o",
                              "s.bake", "--export", "engine"},
                             folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  expect_lists_of_cells(folder, "s.bake", "engine");
  const auto bytes = read_all(folder.path() / "engine/engine.cluespvs");
  EXPECT_EQ(load(bytes.substr(0, bytes.size() - 1)).pvs, nullptr) << "not whole";
  EXPECT_EQ(load("CLUESPVS").pvs, nullptr);
  EXPECT_EQ(load(std::string(bytes.size(), 'x')).pvs, nullptr);
}

TEST(EngineFile, HoldsTheListsOfSkewCells) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  folder.write("skew.obj", "v 0 0 0\nv 0.3 0.1 0\nv 0.1 0.3 0\nv 0.1 0.1 0.37\n");
  folder.write("flat.obj", "v 0 0 0\nv 0.3 0.1 0.05\nv 0.1 0.3 0\n");
  folder.write("cells.txt", "# name cell\nskew skew.obj\nflat flat.obj  # in a plane\npoint box:0.5,0.5,0,0.5,0.5,0\n");
  const auto ran =
      run_clues({"bake", "scene.off", "--cells", "cells.txt", "-o", "s.bake", "--export", "engine"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  expect_lists_of_cells(folder, "s.bake", "engine");
}

// Normals of facets that are no doubles until they are scaled, and distances that are none at all.
TEST(EngineFile, HoldsTheListsOfTinyAndHugeCells) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  for (const char* size : {"1e-310", "1e-300", "1e-165", "1e-110", "1e155", "1e160", "1e300", "1.7e308"}) {
    SCOPED_TRACE(size);
    const std::string s = size;
    folder.write("cell.obj", "v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nv 0 0 " + s + "\n");
    folder.write("cells.txt", "only cell.obj\n");
    const auto ran =
        run_clues({"bake", "scene.off", "--cells", "cells.txt", "-o", s + ".bake", "--export", s}, folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto file = load(read_all(folder.path() / s / "engine.cluespvs"));
    ASSERT_NE(file.pvs, nullptr);
    const scene::FinishedBake baked(folder.path() / (s + ".bake"));
    for (const auto& p : baked.plan().cells[0].points)
      EXPECT_THAT(cells_at(file.pvs, p), testing::ElementsAre(0U)) << p[0] << " " << p[1] << " " << p[2];
    const double quarter = std::strtod(size, nullptr) / 4;
    EXPECT_THAT(cells_at(file.pvs, {quarter, quarter, quarter}), testing::ElementsAre(0U));
  }
}

TEST(EngineFile, HoldsTheLeavesOfALevel) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  const auto ran =
      run_clues({"bake", "made.bsp", "--cells", "leaves", "-o", "l.bake", "--export", "engine"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  expect_lists_of_cells(folder, "l.bake", "engine");
  EXPECT_THAT(read_all(folder.path() / "engine/cells.txt"), testing::HasSubstr("0 0 0\n1 1 1\n"));
  EXPECT_THAT(read_all(folder.path() / "engine/parts.txt"), testing::HasSubstr("face 0"));
}

}  // namespace
}  // namespace clues::tests
