// The closure over the exact reference gives the answer of the exact reference alone, from a part of the scene.
#include "fastpath/visibility/closure/closure.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <numeric>

#include "fastpath/queries/bvh.h"
#include "fuzz/generators/city.h"
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

fastpath::Closure close(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell, PartBug bug) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  const fastpath::Bvh bvh(mesh);
  return fastpath::close_over_visible(bvh, fastpath::Cell(cell), reference_parts(exact_cell, bug), 0);
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
