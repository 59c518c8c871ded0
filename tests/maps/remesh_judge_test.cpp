// E7: the judge of remeshes accepts what is made, and finds what is planted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/remesh.h"
#include "scene/messages/error.h"
#include "tests/maps/hierarchy_over.h"
#include "tests/seed.h"
#include "validate/multires/check_remesh.h"
#include "validate/multires/triangle_distance.h"

namespace clues {
namespace {

using testing::HasSubstr;

struct Made {
  scene::Hierarchy hierarchy;
  reference::Remesh remesh;
};
Made made(const scene::TriangleMesh& mesh, std::uint64_t base, const reference::RemeshOptions& options) {
  Made out{test::hierarchy_over(mesh, base), {}};
  out.remesh = reference::remeshed(out.hierarchy, options);
  return out;
}
Made uniform_ball() {
  reference::RemeshOptions options;
  options.level = 2;
  return made(fuzz::ball(5), 24, options);
}

std::string verdict(const Made& m) {
  validate::HierarchyReport report;
  const auto& points = m.hierarchy.input.points;
  const auto proof = scene::parse_remesh_proof(scene::to_text(m.remesh.proof), "proof", points.size(),
                                               m.hierarchy.input.triangles.size());
  validate::check_remesh(m.hierarchy, m.remesh.mesh, proof, false, report);
  std::string out;
  for (const auto& f : report.findings) out += f.check + " " + f.what + "\n";
  return out;
}

TEST(JudgeOfRemeshes, AcceptsUniformAndAdaptiveOnes) {
  EXPECT_EQ(verdict(uniform_ball()), "");
  reference::RemeshOptions adaptive;
  adaptive.error = 0.1;
  EXPECT_EQ(verdict(made(fuzz::ball(8), 20, adaptive)), "");
  EXPECT_EQ(verdict(made(fuzz::sheet(6), 20, adaptive)), "");
  adaptive.error = 0.3;
  EXPECT_EQ(verdict(made(fuzz::frame(2, 2), 20, adaptive)), "");
}

// Connected like the input, as near as is said and as was asked for.
void judge_random_surfaces(std::uint64_t seed, std::uint64_t count) {
  std::uint64_t judged = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    reference::RemeshOptions options;
    options.level = static_cast<int>(k % 2);
    if (k % 3 != 0) options.error = 0.3;
    options.most = 2;
    try {
      const Made m = made(fuzz::surface_case(seed, k).mesh, 20, options);
      EXPECT_EQ(verdict(m), "") << k;
      EXPECT_TRUE(!m.remesh.reached || m.remesh.error() <= options.error) << k;
      ++judged;
    } catch (const scene::Error& error) {
      EXPECT_EQ(error.code(), scene::ErrorCode::unsupported) << k << error.what();
      EXPECT_GT(options.level, 0) << k;  // an error that is asked for may be missed, and nothing is refused
    }
  }
  EXPECT_GT(judged, count / 2);
}
TEST(JudgeOfRemeshes, AcceptsThoseOfRandomSurfaces) { judge_random_surfaces(kSeed + 5, 40); }
TEST(JudgeOfRemeshesLong, AcceptsThoseOfRandomSurfaces) { judge_random_surfaces(kSeed + 6, 2000); }

// Neighbours of fine triangles lay where the grids are too coarse for cuts: no remesh was made at all. One of them reaches the error since crowded pieces get room.
TEST(JudgeOfRemeshes, AcceptsWhatMissesAnErrorThatGridsForbid) {
  const auto judged = [](const scene::TriangleMesh& mesh, std::uint64_t base) {
    reference::RemeshOptions options;
    options.error = 0.1;
    options.most = 4;
    const Made m = made(mesh, base, options);
    EXPECT_EQ(verdict(m), "");
    return m.remesh.reached;
  };
  EXPECT_FALSE(judged(fuzz::surface_case(77, 30).mesh, 20));
  EXPECT_TRUE(judged(fuzz::surface_case(77, 40).mesh, 20));
}

// Squares of distances overflow: there is no bound, and nothing else is wrong.
TEST(JudgeOfRemeshes, AcceptsHugeCoordinatesWithoutABound) {
  auto mesh = fuzz::ball(3);
  for (auto& p : mesh.points) {
    for (double& x : p) x *= 0x1p1020;
  }
  Made m = made(mesh, 24, {});
  EXPECT_TRUE(std::isinf(m.remesh.proof.to_remesh));
  EXPECT_TRUE(std::isinf(m.remesh.proof.to_input));
  EXPECT_EQ(verdict(m), "");
  for (auto& x : m.remesh.mesh.points[0]) x /= 2;
  EXPECT_THAT(verdict(m), HasSubstr("is not where the input is"));
}

TEST(JudgeOfRemeshes, FindsAMovedVertex) {
  for (const double by : {0.1, 0x1p-50}) {
    Made m = uniform_ball();
    std::size_t v = 0;
    while (std::abs(m.remesh.mesh.points[v][0]) < 0.5) ++v;
    m.remesh.mesh.points[v][0] *= 1 + by;
    EXPECT_THAT(verdict(m), HasSubstr("E7 vertex " + std::to_string(v) + " of the remesh is not where the input is"));
  }
}

// g++ 12 left out the rounding of two coordinates of three, and the bound was that of another mesh than the file has.
TEST(JudgeOfRemeshes, FindsFloatsThatAreNone) {
  reference::RemeshOptions options;
  options.level = 1;
  options.single = true;
  Made m = made(fuzz::ball(5), 24, options);
  const auto judged = [&] {
    validate::HierarchyReport report;
    validate::check_remesh(m.hierarchy, m.remesh.mesh, m.remesh.proof, true, report);
    return report.sound();
  };
  for (const auto& p : m.remesh.mesh.points) {
    for (const double x : p) {
      const double unit = x == 0 ? 1 : std::ldexp(1.0, std::ilogb(x) - 23);
      EXPECT_EQ(std::remainder(x, unit), 0) << x;
    }
  }
  EXPECT_TRUE(judged());
  std::size_t v = 0;
  while (std::abs(m.remesh.mesh.points[v][0]) < 0.5) ++v;
  m.remesh.mesh.points[v][0] *= 1 + 0x1p-40;
  EXPECT_FALSE(judged());
}

TEST(JudgeOfRemeshes, FindsABoundThatIsALittleTooSmall) {
  Made m = uniform_ball();
  m.remesh.proof.to_remesh *= 1 - 0x1p-40;
  EXPECT_THAT(verdict(m), HasSubstr("of the input is farther from the remesh than the bound"));
  m = uniform_ball();
  m.remesh.proof.to_input *= 1 - 0x1p-40;
  EXPECT_THAT(verdict(m), HasSubstr("of the remesh is farther from triangle"));
}

TEST(JudgeOfRemeshes, FindsWhatIsNoMap) {
  Made m = uniform_ball();
  m.remesh.mesh.triangles.pop_back();
  EXPECT_THAT(verdict(m), HasSubstr("E7 the remesh has 287 triangles, its proof is about 288"));
  m.remesh.proof.triangles.pop_back();
  EXPECT_THAT(verdict(m), HasSubstr("the remesh has Euler number"));
  m = uniform_ball();
  std::swap(m.remesh.mesh.triangles[3][0], m.remesh.mesh.triangles[3][1]);
  EXPECT_THAT(verdict(m), HasSubstr("is in two places (triangle"));
  m = uniform_ball();
  m.remesh.proof.pieces.pop_back();
  m.remesh.proof.near.pop_back();
  EXPECT_THAT(verdict(m), HasSubstr("has no neighbour at the edge"));
  m = uniform_ball();
  std::swap(m.remesh.proof.pieces[7].corners[0], m.remesh.proof.pieces[7].corners[1]);
  EXPECT_THAT(verdict(m), HasSubstr("piece 7 is flipped or flat on the input"));
  m = uniform_ball();
  for (auto& p : m.remesh.proof.points) {
    if (p.source.size() == 3) {
      ++p.source.weight[1];
      break;
    }
  }
  EXPECT_THAT(verdict(m), HasSubstr("its weights sum to 1 + 1 * 2^-60"));
  m = uniform_ball();
  std::swap(m.remesh.proof.parameters[0], m.remesh.proof.parameters[1]);
  EXPECT_THAT(verdict(m), HasSubstr("the base domain"));
  m = uniform_ball();
  m.remesh.proof.parameters.pop_back();
  EXPECT_THROW(verdict(m), scene::Error);  // a vertex that is not there
}

// What formats do to vertices: split they may be, joined not. Two tetrahedra that share a vertex in the file were verified as two.
TEST(JudgeOfRemeshes, FindsVerticesThatTheFileJoins) {
  scene::TriangleMesh two;
  two.points.resize(8);  // all in one place
  for (const std::uint32_t v : {0U, 4U}) {
    for (const scene::Triangle& t : {scene::Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
      two.triangles.push_back({v + t[0], v + t[1], v + t[2]});
  }
  Made m = made(two, 8, {});
  EXPECT_EQ(verdict(m), "");
  auto& mesh = m.remesh.mesh;
  mesh.points.push_back(mesh.points[0]);
  for (auto& t : mesh.triangles) std::replace(t.begin(), t.end(), mesh.triangles[7][0], 8U);
  EXPECT_EQ(verdict(m), "");
  mesh.triangles[7][0] = mesh.triangles[0][0];
  EXPECT_THAT(verdict(m), HasSubstr("E7 vertex " + std::to_string(mesh.triangles[0][0]) + " of the file is vertices"));
}

TEST(JudgeOfRemeshes, FindsPointsBesideThePieces) {
  Made m = uniform_ball();
  m.remesh.proof.points.push_back(m.remesh.proof.points[0]);
  EXPECT_EQ(
      verdict(m).find("E7 point " + std::to_string(m.remesh.proof.points.size() - 1) + " is a corner of no piece"), 0U);
}

// Fractions against doubles on either side of the bound, and triangles that are none.
TEST(DistanceToATriangle, IsExact) {
  scene::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 3}, {-3, -4, 0}, {4, 4, 0}};
  const auto within = [&](std::uint32_t v, std::array<std::uint32_t, 3> t, double bound) {
    const auto at = scene::at_vertex(v);
    return validate::is_within({at, mesh}, {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, bound);
  };
  EXPECT_TRUE(within(3, {0, 1, 2}, 3));
  EXPECT_FALSE(within(3, {0, 1, 2}, std::nextafter(3, 0)));
  EXPECT_TRUE(within(4, {0, 1, 2}, 5));
  EXPECT_FALSE(within(4, {0, 1, 2}, std::nextafter(5, 0)));
  EXPECT_TRUE(within(5, {0, 1, 2}, std::nextafter(std::sqrt(8), 3)));
  EXPECT_FALSE(within(5, {0, 1, 2}, std::nextafter(std::sqrt(8), 2)));
  EXPECT_TRUE(within(4, {0, 0, 0}, 5));
  EXPECT_TRUE(within(4, {0, 1, 1}, 5));
  EXPECT_TRUE(within(0, {0, 1, 2}, 0));
  EXPECT_FALSE(within(4, {0, 1, 2}, 0));
}

}  // namespace
}  // namespace clues
