// The tree itself: every triangle once, inside all boxes above it in exact arithmetic, the same for any number of threads.
#include "fastpath/queries/bvh.h"

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "bvh_tamperer.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random_scenes.h"
#include "oracle.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

struct Faults {
  int outside = 0;  // corners outside a box that should hold them
  std::vector<int> times;
  int depth = 0;
};

void look(const Bvh& bvh, std::uint32_t node, std::vector<std::pair<std::uint32_t, std::size_t>>& path,
          Faults& faults) {
  faults.depth = std::max(faults.depth, static_cast<int>(path.size()) + 1);
  for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
    const std::uint32_t child = bvh.nodes()[node].child[lane];
    if (child == BoxLanes::kEmpty) continue;
    path.emplace_back(node, lane);
    if ((child & BoxLanes::kLeaf) == 0) {
      look(bvh, child, path, faults);
    } else {
      const TriangleBlock& block = bvh.blocks()[child & ~BoxLanes::kLeaf];
      for (std::size_t i = 0; i < 4; ++i) {
        if (i > 0 && block.id[i] == block.id[0]) continue;
        ++faults.times[block.id[i]];
        for (const Point& p : bvh.corners(block.id[i])) {
          for (std::size_t k = 0; k < 3; ++k) {
            const mpq_class x = (mpq_class(p[k]) - mpq_class(bvh.frame().center[k])) * mpq_class(bvh.frame().scale);
            for (const auto& [above, in] : path) {
              const auto& side = bvh.nodes()[above].side;
              faults.outside += mpq_class(side[k][in]) > x || mpq_class(side[k + 3][in]) < x ? 1 : 0;
            }
          }
        }
      }
    }
    path.pop_back();
  }
}

Faults look(const Bvh& bvh) {
  Faults faults;
  faults.times.assign(bvh.mesh().triangles.size(), 0);
  std::vector<std::pair<std::uint32_t, std::size_t>> path;
  if (!bvh.nodes().empty()) look(bvh, 0, path, faults);
  return faults;
}

TEST(Bvh, EveryTriangleIsOnceInsideItsBoxes) {
  const auto city = fuzz::make_city(2000, kSeed);
  for (const double offset : {0.0, 0.1, 1e7}) {
    for (const int power : {-1060, -60, 0, 60, 1000}) {
      const auto mesh = moved(city, std::ldexp(1.0, power), offset);
      const Bvh bvh(mesh);
      const Faults faults = look(bvh);
      EXPECT_EQ(faults.outside, 0) << "2^" << power << " + " << offset;
      EXPECT_LE(faults.depth, Bvh::kDeepest);
      for (std::size_t i = 0; i < faults.times.size(); ++i) {
        const bool none = std::binary_search(bvh.degenerate().begin(), bvh.degenerate().end(), i);
        ASSERT_EQ(faults.times[i], none ? 0 : 1) << i;
      }
    }
  }
}

TEST(Bvh, BoxesThatAreNotRoundedOutwardAreCaught) {
  const auto mesh = moved(fuzz::make_city(2000, kSeed), 0.1, 0.3);
  Bvh bvh(mesh);
  ASSERT_EQ(look(bvh).outside, 0);
  BvhTamperer::shrink_boxes(bvh, 0x1p-24F);
  EXPECT_GT(look(bvh).outside, 0);
}

// Many triangles at the same place, and a spiral that halves its size 900 times: no way to cut them well, and no endless tree.
TEST(Bvh, HardDistributionsStayShallow) {
  scene::TriangleMesh same, spiral;
  same.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  same.triangles.assign(5000, {0, 1, 2});
  for (int i = 0; i < 900; ++i) {
    const double x = std::ldexp(1.0, -i);
    const auto n = static_cast<std::uint32_t>(spiral.points.size());
    spiral.points.insert(spiral.points.end(), {{x, 0, 0}, {x, x, 0}, {x, 0, x}});
    spiral.triangles.push_back({n, n + 1, n + 2});
  }
  for (const auto* mesh : {&same, &spiral}) {
    const Bvh bvh(*mesh);
    const Faults faults = look(bvh);
    EXPECT_EQ(faults.outside, 0);
    EXPECT_LE(faults.depth, Bvh::kDeepest);
    EXPECT_EQ(std::count(faults.times.begin(), faults.times.end(), 1),
              static_cast<std::ptrdiff_t>(mesh->triangles.size()));
  }
}

TEST(Bvh, TheSameTreeForAnyNumberOfThreads) {
  const auto city = fuzz::make_city(60000, kSeed);
  const Bvh usual(city);
  for (const std::size_t threads : {1U, 2U, 5U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Bvh bvh(city);
    ASSERT_EQ(bvh.nodes().size(), usual.nodes().size());
    ASSERT_EQ(bvh.blocks().size(), usual.blocks().size());
    EXPECT_EQ(std::memcmp(bvh.nodes().data(), usual.nodes().data(), usual.nodes().size() * sizeof(BoxLanes)), 0);
    EXPECT_EQ(std::memcmp(bvh.blocks().data(), usual.blocks().data(), usual.blocks().size() * sizeof(TriangleBlock)),
              0);
  }
}

TEST(Bvh, AnEmptySceneHasNoTree) {
  const scene::TriangleMesh mesh;
  EXPECT_TRUE(Bvh(mesh).nodes().empty());
}

}  // namespace
}  // namespace clues::fastpath
