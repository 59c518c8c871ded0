// The first guess of the closure: it need not be complete, but the time of a map goes with what it leaves out.
#include "fastpath/visibility/closure/sight_rays.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <set>

#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/city.h"

namespace clues::tests {
namespace {

using Ids = std::set<std::uint32_t>;

Ids without_nothing(const std::vector<std::uint32_t>& met) {
  Ids ids(met.begin(), met.end());
  ids.erase(fastpath::SightRays::kNothing);
  return ids;
}

// As the closure does it: from triangle to neighbour until nothing new is met.
Ids spread(fastpath::SightRays& rays, Ids fresh) {
  Ids all;
  while (!fresh.empty()) {
    all.insert(fresh.begin(), fresh.end());
    const std::vector<std::uint32_t> wave(fresh.begin(), fresh.end());
    fresh.clear();
    for (const std::uint32_t t : without_nothing(rays.beside(wave))) {
      if (!all.contains(t)) fresh.insert(t);
    }
  }
  return all;
}

TEST(SightRays, FindNearlyAllThatIsVisibleInACity) {
  for (const std::uint32_t size : {1000U, 3000U}) {
    SCOPED_TRACE(size);
    const auto mesh = fuzz::make_city(size, 1);
    const auto points = fuzz::street_cell(size, 1);
    const fastpath::Bvh bvh(mesh);
    const fastpath::Cell cell(points);
    const auto visible = fastpath::first_order_visibility(bvh, points, {}).visible;
    fastpath::SightRays rays(bvh, cell);
    const Ids around = without_nothing(rays.around(mesh.triangles.size(), 0));
    const Ids found = spread(rays, around);
    EXPECT_TRUE(std::includes(visible.begin(), visible.end(), found.begin(), found.end()));
    EXPECT_GE(20 * found.size(), 19 * visible.size());
    EXPECT_LT(20 * around.size(), 19 * visible.size());  // the neighbours do it, not the number of rays
  }
}

TEST(SightRays, AreTheSameForAnyNumberOfThreads) {
  const auto mesh = fuzz::make_city(1000, 1);
  const fastpath::Bvh bvh(mesh);
  const fastpath::Cell cell(fuzz::street_cell(1000, 1));
  std::vector<std::uint32_t> met;
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena arena(threads);
    const auto now = arena.execute([&] {
      fastpath::SightRays rays(bvh, cell);
      auto ids = rays.around(1000, 1);
      for (const std::uint32_t t : rays.beside(std::vector<std::uint32_t>{7, 8, 9})) ids.push_back(t);
      for (const std::uint32_t t : rays.towards(std::vector<std::uint32_t>{7, 8, 9})) ids.push_back(t);
      return ids;
    });
    if (met.empty()) met = now;
    EXPECT_EQ(now, met);
  }
}

TEST(SightRays, TowardsATriangleMeetWhatIsInFrontOfIt) {
  scene::TriangleMesh mesh;
  mesh.points = {{-4, -4, 8}, {4, -4, 8}, {0, 6, 8}, {-4, -4, 9}, {4, -4, 9}, {0, 4, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.face_of = {0, 1};
  const fastpath::Bvh bvh(mesh);
  const fastpath::Cell cell({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  fastpath::SightRays rays(bvh, cell);
  const auto met = rays.towards(std::vector<std::uint32_t>{0});
  EXPECT_EQ(met.size(), fastpath::SightRays::kTowards);
  EXPECT_LE(without_nothing(met).size(), 1U);  // the end of a ray is on the triangle, but for its rounding
  EXPECT_FALSE(without_nothing(met).contains(1));
  EXPECT_TRUE(without_nothing(rays.towards(std::vector<std::uint32_t>{1})).contains(0));
}

}  // namespace
}  // namespace clues::tests
