// The spherical Delaunay mesh: what is inserted and removed, degenerate samples included.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "fastpath/motion/base_mesh.h"
#include "fastpath/motion/triangulation.h"
#include "scene/messages/error.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

using namespace fastpath::motion;

const MotionThresholds delaunay{2000, 4e-14, true};

std::set<std::set<MotionPoint>> triangles_of(const DepthMesh& mesh) {
  std::set<std::set<MotionPoint>> all;
  for (const auto& t : mesh.triangles)
    all.insert({mesh.samples[t[0]].at, mesh.samples[t[1]].at, mesh.samples[t[2]].at});
  return all;
}

TEST(Triangulation, BaseHas162DirectionsAnd320Triangles) {
  const DepthMesh base = icosahedral_base();
  EXPECT_EQ(base.samples.size(), 162U);
  EXPECT_EQ(base.triangles.size(), 320U);
  EXPECT_EQ(fault_of(base, {3, -7, 100}, {}), "");
  // A1.4: edges of 0.2767 to 0.3265 rad.
  double least = 9, most = 0;
  for (const auto& t : base.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const MotionPoint &p = base.samples[t[i]].at, &q = base.samples[t[(i + 1) % 3]].at;
      double pq = 0, pp = 0, qq = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        pq += p[k] * q[k];
        pp += p[k] * p[k];
        qq += q[k] * q[k];
      }
      const double angle = std::acos(pq / std::sqrt(pp * qq));
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
  }
  EXPECT_NEAR(least, 0.2767, 1e-4);
  EXPECT_NEAR(most, 0.3265, 2e-4);
}

TEST(Triangulation, DoesNotDependOnTheOrder) {
  fuzz::Random random(7);
  std::vector<DepthSample> samples;
  for (int k = 0; k < 400; ++k) {
    const MotionPoint d = direction(random);
    const double r = uniform(random, 1, 3);
    samples.push_back({{r * d[0], r * d[1], r * d[2]}, random.one_in(5), false});
  }
  Triangulation there(delaunay, {0, 0, 0}), back(delaunay, {0, 0, 0});
  for (const DepthSample& s : samples) ASSERT_NE(there.insert(s), kNone);
  std::reverse(samples.begin(), samples.end());
  for (const DepthSample& s : samples) ASSERT_NE(back.insert(s), kNone);
  EXPECT_EQ(fault_of(there.mesh().to_depth_mesh(), {0, 0, 0}, delaunay), "");
  EXPECT_EQ(triangles_of(there.mesh().to_depth_mesh()), triangles_of(back.mesh().to_depth_mesh()));
}

TEST(Triangulation, RemovingGivesBackWhatWasThere) {
  fuzz::Random random(8);
  Triangulation mesh(delaunay, {0, 0, 0});
  for (int k = 0; k < 200; ++k) mesh.insert({direction(random), false, false});
  const auto before = triangles_of(mesh.mesh().to_depth_mesh());
  for (int k = 0; k < 100; ++k) {
    const std::uint32_t v = mesh.insert({direction(random), false, false});
    if (v == kNone) continue;
    mesh.mesh().changed().clear();
    ASSERT_TRUE(mesh.remove(v, mesh.view(), mesh.view()));
    std::vector<std::uint32_t> faces = mesh.mesh().changed();
    mesh.legalise(faces, [](std::uint32_t, std::uint32_t) { return true; });
    EXPECT_EQ(triangles_of(mesh.mesh().to_depth_mesh()), before);
  }
}

// A grid on a wall right in front: all squares are cocircular in pairs of symmetric places; the same ray twice, and the viewpoint itself, are refused.
TEST(Triangulation, CocircularEqualAndOnTheViewpoint) {
  const MotionPoint at{0, 0, 0};
  Triangulation mesh(delaunay, at);
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      const DepthSample s{{x / 16.0, y / 16.0, 1}, false, false};
      mesh.insert(s);
      const std::size_t count = mesh.mesh().vertex_count();
      EXPECT_EQ(mesh.insert(s), kNone);
      EXPECT_EQ(mesh.insert({{x / 4.0, y / 4.0, 4}, false, false}), kNone);  // behind it
      EXPECT_EQ(mesh.insert({{x / 16.0, y / 16.0, 1}, true, false}), kNone);
      EXPECT_EQ(mesh.mesh().vertex_count(), count);
    }
  }
  EXPECT_EQ(mesh.insert({at, false, false}), kNone);
  EXPECT_EQ(mesh.insert({at, true, false}), kNone);
  EXPECT_EQ(fault_of(mesh.mesh().to_depth_mesh(), at, delaunay), "");
  EXPECT_GT(mesh.constraints().counts.exact, 0U);
  // Each base direction may be one of them: it was there first.
  EXPECT_GT(mesh.mesh().vertex_count(), 162U + 75U);
}

TEST(Triangulation, AMeshThatIsNoSphereIsRefused) {
  DepthMesh mesh = icosahedral_base();
  mesh.triangles.pop_back();
  EXPECT_THROW(SphereMesh{mesh}, scene::Error);
  mesh.triangles.push_back(mesh.triangles.front());
  EXPECT_THROW(SphereMesh{mesh}, scene::Error);
  mesh.triangles.back() = {0, 1, 900};
  EXPECT_THROW(SphereMesh{mesh}, scene::Error);
}

}  // namespace
}  // namespace clues::tests
