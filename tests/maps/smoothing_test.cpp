// Smoothing moves vertices of a remesh on the input, and leaves it what the judge asks for.
#include "reference/multires/smoothing.h"

#include <gtest/gtest.h>

#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/stars/features.h"
#include "scene/messages/error.h"
#include "tests/maps/hierarchy_over.h"
#include "tests/seed.h"
#include "validate/multires/check_remesh.h"

namespace clues {
namespace {

std::string verdict(const scene::Hierarchy& h, const reference::Remesh& remesh) {
  validate::HierarchyReport report;
  validate::check_remesh(h, remesh.mesh, remesh.proof, false, report);
  std::string out;
  for (const auto& f : report.findings) out += f.check + " " + f.what + "\n";
  return out;
}

reference::Remesh uniform(const scene::Hierarchy& h, int level) {
  reference::RemeshOptions options;
  options.level = level;
  return reference::remeshed(h, options);
}

TEST(Smoothing, LessensAnglesAndIsJudgedRight) {
  for (const auto& mesh : {fuzz::ball(8), fuzz::frame(1, 3), fuzz::sheet(8)}) {
    const auto h = test::hierarchy_over(mesh, 40);
    auto remesh = uniform(h, 2);
    const auto before = reference::neighbour_angles_estimate(remesh.mesh);
    const auto triangles = remesh.mesh.triangles;
    reference::SmoothingOptions options;
    options.rounds = 3;
    EXPECT_GT(reference::smooth(remesh, h, options), remesh.mesh.points.size() / 2);
    const auto after = reference::neighbour_angles_estimate(remesh.mesh);
    EXPECT_LT(after.mean, before.mean);
    EXPECT_LT(after.largest, before.largest);
    EXPECT_EQ(remesh.mesh.triangles, triangles);
    EXPECT_EQ(verdict(h, remesh), "");
  }
}

TEST(Smoothing, KeepsFeaturesAndTheBoundary) {
  const auto mesh = fuzz::frame(1, 3);
  reference::HierarchyOptions options;
  options.features = reference::sharp_edges(mesh, 0.5);
  const auto h = test::hierarchy_over(mesh, 40, options);
  const std::set<scene::Edge> features(h.features.begin(), h.features.end());
  ASSERT_FALSE(features.empty());
  auto remesh = uniform(h, 2);
  const auto before = remesh.sources;
  reference::smooth(remesh, h, {});
  for (std::size_t v = 0; v < before.size(); ++v) {
    const auto& at = before[v];
    if (at.size() != 2 || features.count({at.corner[0], at.corner[1]}) == 0) continue;
    EXPECT_EQ(at, remesh.sources[v]) << v;
  }
  EXPECT_EQ(verdict(h, remesh), "");
  const auto sheet = test::hierarchy_over(fuzz::sheet(6), 8);
  auto flat = uniform(sheet, 2);
  const double error = flat.error();
  reference::smooth(flat, sheet, {});
  EXPECT_EQ(verdict(sheet, flat), "");
  EXPECT_LT(flat.error(), 1.1 * error);
}

void judge_smoothed_surfaces(std::uint64_t seed, std::uint64_t count) {
  std::uint64_t judged = 0, moves = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto h = test::hierarchy_over(fuzz::surface_case(seed, k).mesh, 20);
    try {
      auto remesh = uniform(h, 1 + static_cast<int>(k % 2));
      reference::SmoothingOptions options;
      options.rounds = 2;
      moves += reference::smooth(remesh, h, options);
      EXPECT_EQ(verdict(h, remesh), "") << k;
      ++judged;
    } catch (const scene::Error& error) {
      EXPECT_EQ(error.code(), scene::ErrorCode::unsupported) << k << error.what();
    }
  }
  EXPECT_GT(judged, count / 2);
  EXPECT_GT(moves, 4 * count);
}
TEST(Smoothing, OfRandomSurfacesIsJudgedRight) { judge_smoothed_surfaces(kSeed + 7, 24); }
TEST(SmoothingLong, OfRandomSurfacesIsJudgedRight) { judge_smoothed_surfaces(kSeed + 8, 1000); }

}  // namespace
}  // namespace clues
