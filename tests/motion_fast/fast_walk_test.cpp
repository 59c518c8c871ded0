// Walks: after each frame every triangle satisfies every constraint, by exact arithmetic (D30), whatever the path does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "exact/dials.h"
#include "fastpath/motion/base_mesh.h"
#include "fastpath/motion/walk.h"
#include "scene/messages/error.h"
#include "scene/motion/view_path.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

using namespace fastpath::motion;
using Bounds = WalkOptions::Bounds;

WalkOptions options_of(std::uint32_t samples, bool delaunay, Bounds bounds = Bounds::sound) {
  WalkOptions options;
  options.samples = samples;
  options.thresholds.delaunay = delaunay;
  options.bounds = bounds;
  return options;
}

struct Summary {
  std::uint64_t examined = 0, tested = 0, removed = 0, flipped = 0, inserted = 0, reinserted = 0, triangles = 0,
                rebuilt = 0;
  std::vector<DepthMesh> meshes;
};

// Every frame is checked.
Summary walk_along(const scene::TriangleMesh& mesh, const WalkOptions& options, const std::vector<MotionPoint>& path) {
  const fastpath::Bvh bvh(mesh);
  Walk walk(bvh, options, path.front());
  EXPECT_EQ(fault_of(walk.depth_mesh(), path.front(), options.thresholds), "");
  Summary sum;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const FrameReport r = walk.move_to(path[k]);
    sum.meshes.push_back(walk.depth_mesh());
    const std::string fault = fault_of(sum.meshes.back(), path[k], options.thresholds);
    EXPECT_EQ(fault, "") << "frame " << k;
    if (!fault.empty()) return sum;
    EXPECT_EQ(r.triangles, sum.meshes.back().triangles.size());
    EXPECT_LE(r.tested, r.examined);
    EXPECT_LE(r.reused, r.triangles);
    sum.examined += r.examined;
    sum.tested += r.tested;
    sum.removed += r.removed;
    sum.flipped += r.flipped;
    sum.inserted += r.inserted;
    sum.reinserted += r.reinserted;
    sum.triangles += r.triangles;
    sum.rebuilt += r.rebuilt ? 1 : 0;
  }
  return sum;
}

const char* const around = "orbit:0,0,0,0.5,0.25";

TEST(FastWalk, EveryFrameIsValidThoughFewTrianglesAreExamined) {
  const auto path = scene::read_view_path(around, 60);
  for (const bool delaunay : {false, true}) {
    const Summary sum = walk_along(room(), options_of(600, delaunay), path);
    EXPECT_EQ(sum.rebuilt, 0U);
    EXPECT_GT(sum.removed, 0U);
    EXPECT_GT(sum.inserted, 0U);
    EXPECT_GT(sum.flipped, 0U);
    EXPECT_LT(sum.examined, sum.triangles / (delaunay ? 4 : 20));
  }
}

// The Delaunay mesh is a function of samples and viewpoint: with bounds it is what examining all triangles makes of it.
TEST(FastWalk, ExaminingAllChangesNothingInADelaunayMesh) {
  const auto path = scene::read_view_path(around, 30);
  const Summary with = walk_along(room(), options_of(400, true), path);
  const Summary without = walk_along(room(), options_of(400, true, Bounds::none), path);
  EXPECT_EQ(without.examined, without.triangles);
  const auto canonical = [](const DepthMesh& mesh) {
    std::set<std::set<std::array<double, 3>>> triangles;
    for (const auto& t : mesh.triangles) {
      triangles.insert({mesh.samples[t[0]].at, mesh.samples[t[1]].at, mesh.samples[t[2]].at});
    }
    return triangles;
  };
  // Until a first sample is taken out, of which there may be a choice.
  EXPECT_EQ(canonical(with.meshes.front()), canonical(without.meshes.front()));
}

TEST(FastWalk, SameInputSameMeshes) {
  const auto path = scene::read_view_path("walk:0,0,0:1,-1,0.5", 20);
  const Summary a = walk_along(room(), options_of(300, true), path),
                b = walk_along(room(), options_of(300, true), path);
  for (std::size_t k = 0; k < a.meshes.size(); ++k) {
    EXPECT_EQ(a.meshes[k].triangles, b.meshes[k].triangles);
    for (std::size_t i = 0; i < a.meshes[k].samples.size(); ++i)
      EXPECT_EQ(a.meshes[k].samples[i].at, b.meshes[k].samples[i].at);
  }
}

// With filters that never know every sign comes from exact arithmetic: the same walk.
TEST(FastWalk, ExactSignsGiveTheSameWalk) {
  const auto path = scene::read_view_path("walk:0,0,0:0.3,-0.2,0.1", 4);
  const Summary fast = walk_along(room(), options_of(40, true), path);
  exact::ProcessDials dials;
  dials.unsure_doubles = true;
  const exact::TurnedProcessDials turned(dials);
  const Summary exact = walk_along(room(), options_of(40, true), path);
  ASSERT_EQ(fast.meshes.size(), exact.meshes.size());
  for (std::size_t k = 0; k < fast.meshes.size(); ++k) EXPECT_EQ(fast.meshes[k].triangles, exact.meshes[k].triangles);
}

TEST(FastWalk, JumpsStandsStillReturnsAndGoesThroughWalls) {
  std::vector<MotionPoint> path{{0, 0, 0},    {0, 0, 0}, {0, 0, 0},   {0.01, 0, 0}, {0, 0, 0},
                                {0.01, 0, 0}, {0, 0, 0}, {-4, -3, 1}, {0, 0, 0}};
  for (int k = 0; k <= 30; ++k) path.push_back({4 + 0.1 * k, 0.1, 0.2});  // through the wall at x = 5, out of the room
  for (int k = 0; k <= 10; ++k) path.push_back({1.5, 0.5 + 0.1 * k, 0});  // into a box
  path.push_back({1e6, 0, 0});
  path.push_back({5, 0, 0});  // on the wall
  path.push_back({5, 4, 2});  // on a corner
  for (const bool delaunay : {false, true}) {
    const Summary sum = walk_along(room(), options_of(150, delaunay), path);
    EXPECT_GT(sum.rebuilt, 1U);
    EXPECT_EQ(sum.meshes.size(), path.size() - 1);
  }
}

TEST(FastWalk, StandingStillCostsNothing) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  Walk walk(bvh, options_of(200, false), {0, 0, 0});
  walk.move_to({0.001, 0, 0});
  const FrameReport r = walk.move_to({0.001, 0, 0});
  EXPECT_EQ(r.tested, 0U);
  EXPECT_EQ(r.reused, r.triangles);
}

TEST(FastWalk, ASampleInTheWayGoes) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  Walk walk(bvh, options_of(300, false), {0, 0, 0});
  // Onto a sample, in steps.
  MotionPoint goal{};
  for (const DepthSample& s : walk.depth_mesh().samples) {
    if (!s.is_direction) goal = s.at;
  }
  for (const double t : {0.5, 0.9, 0.99, 0.999999, 1.0}) {
    const MotionPoint at{goal[0] * t, goal[1] * t, goal[2] * t};
    walk.move_to(at);
    ASSERT_EQ(fault_of(walk.depth_mesh(), at, {}), "") << t;
  }
}

TEST(FastWalk, FewSamplesAndNone) {
  const auto path = scene::read_view_path(around, 10);
  for (const std::uint32_t samples : {0U, 1U, 3U}) {
    for (const bool delaunay : {false, true}) {
      const Summary sum = walk_along(room(), options_of(samples, delaunay), path);
      EXPECT_LE(sum.meshes.back().samples.size(), 162 + samples);
    }
  }
}

TEST(FastWalk, RebuildsWhenAskedTo) {
  const Summary sum = walk_along(room(), options_of(100, true, Bounds::rebuild), scene::read_view_path(around, 3));
  EXPECT_EQ(sum.rebuilt, 3U);
}

TEST(FastWalk, RefusesWhatCannotBeMeant) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Walk(bvh, options_of(10, false), {nan, 0, 0}), scene::Error);
  EXPECT_THROW(Walk(bvh, options_of(10, true, Bounds::sketch_unsound), {0, 0, 0}), scene::Error);
  EXPECT_THROW(Walk(bvh, options_of(1U << 25U, true), {0, 0, 0}), scene::Error);
  Walk walk(bvh, options_of(10, false), {0, 0, 0});
  EXPECT_THROW(walk.move_to({0, nan, 0}), scene::Error);
  EXPECT_THROW(walk.move_to({0, 1e300, 0}), scene::Error);
  WalkOptions bad = options_of(10, false);
  bad.thresholds.sigma = 2;
  EXPECT_THROW(Walk(bvh, bad, {0, 0, 0}), scene::Error);
  bad.thresholds = {};
  bad.thresholds.kappa = 1;  // 45 degrees
  EXPECT_THROW(Walk(bvh, bad, {0, 0, 0}), scene::Error);
}

// Directions of the base stay where they are while the samples of a near wall go past them. Base vertices used to take all samples in their way out, one
// layer after the other: of 6,000 samples hundreds in a frame, where none was hidden.
TEST(FastWalk, BaseVerticesDoNotPloughThroughNearWalls) {
  std::vector<MotionPoint> path;
  for (int k = 0; k <= 12; ++k) path.push_back({4.7, -1 + 0.03 * k, 0.2});  // the wall is 0.3 away
  for (const bool delaunay : {false, true}) {
    const Summary sum = walk_along(room(), options_of(6000, delaunay), path);
    EXPECT_EQ(sum.rebuilt, 0U);
    EXPECT_LT(sum.removed, 12U * 60);
    for (const DepthMesh& mesh : sum.meshes) EXPECT_GT(mesh.samples.size(), 5950U);
  }
}

// A base vertex is out where three samples near its direction do for it, and is there where samples are missing: no direction is far from a vertex.
TEST(FastWalk, BaseVerticesAreThereWhereSamplesAreMissing) {
  scene::TriangleMesh wall;  // sky all around but for one side
  wall.points = {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const auto& mesh : {room(), wall}) {
    const fastpath::Bvh bvh(mesh);
    Walk walk(bvh, options_of(6000, true), {0, 0, 0});
    for (int k = 0; k <= 20; ++k) {
      const MotionPoint at{0.04 * k, 0.01 * k, 0};
      if (k > 0) walk.move_to(at);
      const DepthMesh now = walk.depth_mesh();
      const auto base = std::count_if(now.samples.begin(), now.samples.end(), [](const auto& s) { return s.is_base; });
      EXPECT_LE(base, 20);
      // Each base direction has a vertex within 0.1 of it.
      std::vector<Row> rows;
      for (const DepthSample& s : now.samples) rows.push_back(row_of(s, at));
      for (const DepthSample& s : icosahedral_base().samples) {
        const Row b = row_of(s, at);
        EXPECT_TRUE(std::any_of(rows.begin(), rows.end(),
                                [&](const Row& r) { return dot(b.x, r.x) > 0.995 * b.length * r.length; }));
      }
    }
  }
}

// Short steps, and then one over more than half of the calendar: triangles that waited outside of its ring are due at once, and were not looked at.
TEST(FastWalk, ALongStepAfterManyShortOnesLeavesNothingUnseen) {
  constexpr double step = 0.0003;
  std::vector<MotionPoint> path;
  for (int k = 0; k <= 120; ++k) path.push_back({step * k, 0.1 * step * k, 0});
  path.push_back({370 * step, 37 * step, 0});
  for (const bool delaunay : {false, true}) {
    const Summary sum = walk_along(room(), options_of(1200, delaunay), path);
    EXPECT_EQ(sum.meshes.size(), path.size() - 1);
    EXPECT_EQ(sum.rebuilt, 0U);  // else nothing is asked of the calendar
  }
}

// After a jump the mesh is made anew, with fewer triangles than the one in which edges had failed: those numbers mean nothing any more. They were read
// beyond the end of the new table (which only sanitizers and checked containers notice).
TEST(FastWalk, AMeshMadeAnewForgetsWhichEdgesHadFailed) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  WalkOptions options = options_of(3000, true);
  options.thresholds.kappa = 16;
  options.thresholds.sigma = 1e-4;
  Walk walk(bvh, options, {0, 0, 0});
  for (int k = 1; k <= 30; ++k) walk.move_to({0.02 * k, 0.005 * k, 0});
  const std::size_t before = walk.mesh().faces().size();
  const MotionPoint far{4.5, -3.5, 1.5};
  EXPECT_TRUE(walk.move_to(far).rebuilt);
  EXPECT_LT(walk.mesh().faces().size(), before);
  EXPECT_EQ(fault_of(walk.depth_mesh(), far, options.thresholds), "");
}

// The sketch takes the chord from a vertex to the foot on the opposite edge: where the thresholds are coarse, triangles fail that it never looks at.
TEST(FastWalk, TheBoundOfTheSketchIsFoundOut) {
  WalkOptions options = options_of(600, false, Bounds::sketch_unsound);
  options.thresholds.kappa = 100;
  options.thresholds.sigma = 1e-5;
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  int faults = 0;
  for (const Bounds bounds : {Bounds::sketch_unsound, Bounds::sound}) {
    options.bounds = bounds;
    const auto path = scene::read_view_path(around, 40);
    Walk walk(bvh, options, path.front());
    int here = 0;
    for (std::size_t k = 1; k < path.size(); ++k) {
      walk.move_to(path[k]);
      here += fault_of(walk.depth_mesh(), path[k], options.thresholds).empty() ? 0 : 1;
    }
    if (bounds == Bounds::sound) {
      EXPECT_EQ(here, 0);
    } else {
      faults = here;
    }
  }
  EXPECT_GT(faults, 0);
}

// What is left of the bounds holds: viewpoints within violate nothing.
TEST(FastWalk, BoundsThatAreLeftHold) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  const WalkOptions options = options_of(200, true);
  const auto path = scene::read_view_path(around, 10);
  Walk walk(bvh, options, path.front());
  for (std::size_t k = 1; k < path.size(); ++k) walk.move_to(path[k]);
  const DepthMesh depth = walk.depth_mesh();
  const auto left = walk.bounds_left();
  ASSERT_EQ(left.size(), depth.triangles.size());
  const exact::ExactThresholds limits(options.thresholds);
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> opposite;
  for (const auto& t : depth.triangles) {
    for (std::size_t i = 0; i < 3; ++i) opposite[{t[(i + 1) % 3], t[(i + 2) % 3]}] = t[i];
  }
  fuzz::Random random(9);
  int finite = 0;
  for (std::size_t t = 0; t < left.size(); ++t) {
    if (!std::isfinite(left[t]) || left[t] == 0) continue;
    ++finite;
    const MotionPoint way = direction(random);
    MotionPoint p = path.back();
    for (std::size_t i = 0; i < 3; ++i) p[i] += way[i] * left[t] * (1 - 1e-9);
    std::array<exact::SightRow, 3> r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = exact::sight_row(depth.samples[depth.triangles[t][i]], p);
    EXPECT_GT(exact::facing_sign(r[0], r[1], r[2]), 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &a = r[i], &b = r[(i + 1) % 3], &c = r[(i + 2) % 3];
      EXPECT_TRUE(exact::edge_length_holds(a, b, limits));
      EXPECT_TRUE(exact::separation_holds(a, b, c, limits));
      const auto across = opposite.at({depth.triangles[t][(i + 2) % 3], depth.triangles[t][(i + 1) % 3]});
      EXPECT_GE(exact::delaunay_sign(a, b, c, exact::sight_row(depth.samples[across], p)), 0);
    }
  }
  EXPECT_GT(finite, 300);
}

}  // namespace
}  // namespace clues::tests
