// Files of meshes, bounds and walks; the validity of meshes (T7), by the reference and by the checker of walks; walks that are wrong.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include "fuzz/motion/motion_cases.h"
#include "reference/motion/mesh.h"
#include "scene/messages/error.h"
#include "scene/motion/motion_files.h"
#include "scene/motion/walk_file.h"
#include "validate/motion/check_walk.h"

namespace clues {
namespace {

class MotionFiles : public testing::Test {
 protected:
  MotionFiles()
      : folder_(std::filesystem::temp_directory_path() /
                ("clues_motion_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~MotionFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& text) {
    const auto path = folder_ / ("file" + std::to_string(++files_));
    std::ofstream(path) << text;
    return path;
  }

 private:
  std::filesystem::path folder_;
  int files_ = 0;
};

validate::WalkReport checked(const scene::DepthMesh& mesh, const scene::MotionPoint& viewpoint,
                             const scene::MotionThresholds& thresholds) {
  validate::WalkReport report;
  validate::check_frame({0, viewpoint, thresholds, mesh}, report);
  return report;
}

TEST_F(MotionFiles, MeshesAndBoundsComeBackAsTheyWere) {
  auto mesh = fuzz::globe(3, 0.7, 4, true);
  mesh.samples[0].at = {0.1, 1e-310, -1e300};
  EXPECT_TRUE(mesh == scene::read_depth_mesh(file(scene::to_json_text(mesh))));
  scene::MotionBounds bounds{
      scene::MotionPoint{0.1, 0.2, 0.3}, {1.5, 1e-17, true}, {0, 0.1, 5e-324, std::numeric_limits<double>::infinity()}};
  const auto again = scene::read_motion_bounds(file(scene::to_json_text(bounds)));
  EXPECT_EQ(again.bounds, bounds.bounds);
  EXPECT_EQ(again.viewpoint, bounds.viewpoint);
  EXPECT_EQ(again.thresholds.kappa, 1.5);
  EXPECT_EQ(again.thresholds.sigma, 1e-17);
  EXPECT_TRUE(again.thresholds.delaunay);
}

TEST_F(MotionFiles, WalksComeBackAsTheyWereAndSayOnlyWhatChanged) {
  auto mesh = fuzz::globe(4, 0.5, 5);
  scene::WalkWriter writer;
  std::string text = scene::WalkWriter::header();
  text += writer.frame(mesh, {0, 0, 0}, {20, 1e-9, false});
  const auto first = text.size();
  auto second = mesh;
  second.samples[3].at[0] += 0.125;
  second.triangles[7] = {scene::no_sample, scene::no_sample, scene::no_sample};
  text += writer.frame(second, {0.25, 0, 0}, {20, 1e-9, false});
  EXPECT_LT(text.size() - first, 200U);
  auto third = second;
  third.triangles[7] = mesh.triangles[7];
  third.triangles.pop_back();
  third.samples.push_back({{1, 2, 3}, true, true});
  text += writer.frame(third, {0.5, 0, 0}, {10, 1e-9, true});
  scene::WalkReader reader(file(text));
  scene::WalkFrame frame;
  ASSERT_TRUE(reader.next(frame));
  EXPECT_TRUE(frame.mesh == mesh);
  ASSERT_TRUE(reader.next(frame));
  second.triangles.erase(second.triangles.begin() + 7);
  EXPECT_TRUE(frame.mesh == second);
  EXPECT_EQ(frame.viewpoint[0], 0.25);
  EXPECT_EQ(frame.thresholds.kappa, 20);
  ASSERT_TRUE(reader.next(frame));
  EXPECT_TRUE(frame.mesh == third);
  EXPECT_EQ(frame.thresholds.kappa, 10);
  EXPECT_TRUE(frame.thresholds.delaunay);
  EXPECT_FALSE(reader.next(frame));
}

TEST_F(MotionFiles, WhatIsWrongIsSaidWithItsPlace) {
  const auto message = [&](const auto& read) -> std::string {
    try {
      read();
    } catch (const scene::Error& e) {
      return e.what();
    }
    return "nothing was wrong";
  };
  const auto of_mesh = [&](const std::string& text) { return message([&] { scene::read_depth_mesh(file(text)); }); };
  EXPECT_NE(of_mesh("[]").find("clues-depth-mesh/1"), std::string::npos);
  const std::string begin = R"({"format":"clues-depth-mesh/1","samples":)";
  EXPECT_NE(of_mesh(begin + R"([[0,0,1]],"triangles":[[0,1,2]]})").find("there is no sample 1"), std::string::npos);
  EXPECT_NE(of_mesh(begin + R"([[0,0,1],[1,0,1]],"triangles":[[0,1,1]]})").find("a sample twice"), std::string::npos);
  EXPECT_NE(of_mesh(begin + R"([[0,0,0,"direction"]],"triangles":[]})").find("length 0"), std::string::npos);
  EXPECT_NE(of_mesh(begin + R"([[0,0,0,"sky"]],"triangles":[]})").find("base-direction"), std::string::npos);
  EXPECT_NE(of_mesh(begin + R"([[0,0,1e999]],"triangles":[]})").find("too large"), std::string::npos);
  EXPECT_NE(of_mesh(begin + R"([],"triangles":[],"more":1})").find("\"more\""), std::string::npos);
  const auto of_bounds = [&](const std::string& text) {
    return message([&] { scene::read_motion_bounds(file(text)); });
  };
  const std::string bounds = R"({"format":"clues-motion-bounds/1","thresholds":{"kappa":1,"sigma":0},"bounds":)";
  EXPECT_NE(of_bounds(bounds + "[-1]}").find("bound 0"), std::string::npos);
  EXPECT_NE(of_bounds(bounds + "[\"1\"]}").find("no number"), std::string::npos);
  EXPECT_EQ(of_bounds(bounds + "[0, null]}"), "nothing was wrong");
  const auto of_walk = [&](const std::string& text) { return message([&] { validate::check_walk(file(text)); }); };
  const std::string header = scene::WalkWriter::header();
  EXPECT_NE(of_walk("{}").find("first line"), std::string::npos);
  EXPECT_NE(of_walk(header).find("nothing was checked"), std::string::npos);
  EXPECT_NE(of_walk(header + R"({"viewpoint":[0,0,0]})").find("thresholds"), std::string::npos);
  EXPECT_NE(of_walk(header + R"({"viewpoint":[0,0,0],"thresholds":{"kappa":1,"sigma":2}})").find("sigma"),
            std::string::npos);
  EXPECT_NE(of_walk(header + R"({"viewpoint":[0,0,0],"thresholds":{"kappa":1,"sigma":0},"samples":[[0,1,2,3]]})")
                .find("beyond"),
            std::string::npos);
  EXPECT_NE(of_walk(header + "nonsense").find(":2: this is not JSON"), std::string::npos);
  EXPECT_THROW(scene::WalkReader("no such file"), scene::Error);
}

// Planted: a sample that nobody has given would be (0, 0, 0), or one that is gone.
TEST_F(MotionFiles, NewSamplesOfAWalkAreGivenAllAndOnce) {
  const auto verified = [&](const std::string& frames) -> std::string {
    try {
      return validate::check_walk(file(scene::WalkWriter::header() + frames)).sound() ? "sound" : "not sound";
    } catch (const scene::Error& e) {
      return e.what();
    }
  };
  const std::string triangles = R"("triangles":[[0,0,1,2],[1,0,2,3],[2,0,3,1],[3,3,2,1]],"viewpoint":[0,0,0])",
                    first = R"({"sizes":[4,4],"thresholds":{"kappa":2000,"sigma":0},"samples":[[0,1,1,1],[1,-1,-1,1],)",
                    four = first + "[2,1,-1,-1],[3,-1,1,-1]]," + triangles + "}\n",
                    three = R"({"sizes":[3,4],"triangles":[[1],[2],[3]],"viewpoint":[0,0,0]})"
                            "\n",
                    again = R"({"sizes":[4,4],"samples":[[)";
  EXPECT_EQ(verified(four), "sound");
  EXPECT_NE(verified(first + "[2,1,-1,-1],[2,1,-1,-1]]," + triangles + "}").find(":2: sample 2 is given twice"),
            std::string::npos);
  EXPECT_NE(
      verified(four + R"({"samples":[[3,-1,1,-1],[3,-1,1,-2]],"viewpoint":[0,0,0]})").find(":3: sample 3 is given"),
      std::string::npos);
  EXPECT_NE(verified(four + R"({"sizes":[5,4],"samples":[[0,1,1,1]],"viewpoint":[0,0,0]})").find(":3: sample 4 is new"),
            std::string::npos);
  EXPECT_NE(verified(four + three + again + "0,1,1,1]]," + triangles + "}").find(":4: sample 3 is new"),
            std::string::npos);
  EXPECT_EQ(verified(four + three + again + "3,-1,1,-1]]," + triangles + "}"),
            "not sound");  // the second frame is open
}

TEST_F(MotionFiles, AWriterOfAListThatShrinksAndGrowsIsRead) {
  const scene::DepthMesh mesh = fuzz::globe(2, 0.3, 3);
  scene::DepthMesh shorter = mesh;
  shorter.samples.pop_back();
  const auto last = static_cast<std::uint32_t>(shorter.samples.size());
  std::erase_if(shorter.triangles, [&](const auto& t) { return std::count(t.begin(), t.end(), last) != 0; });
  scene::WalkWriter writer;
  std::string text = scene::WalkWriter::header();
  for (const auto& now : {mesh, shorter, mesh}) text += writer.frame(now, {0, 0, 0}, {20, 1e-9, false});
  scene::WalkReader reader(file(text));
  scene::WalkFrame frame;
  for (const auto& now : {mesh, shorter, mesh}) {
    ASSERT_TRUE(reader.next(frame));
    EXPECT_TRUE(frame.mesh == now);
  }
}

TEST(DepthMeshes, AGlobeIsOneAndWhatIsBrokenIsNone) {
  const auto origin = exact::exact_viewpoint({0, 0, 0});
  const scene::MotionThresholds thresholds{1000, 1e-12, true};
  for (const bool sky : {false, true}) {
    const auto mesh = fuzz::globe(5, 0.4, 6, sky);
    EXPECT_TRUE(reference::depth_mesh_state(mesh, origin).valid());
    const auto report = checked(mesh, {0, 0, 0}, thresholds);
    EXPECT_EQ(report.sound(), reference::violations(mesh, thresholds, origin).empty());
    EXPECT_EQ(report.open_frames + report.overlapping_frames, 0);
    EXPECT_EQ(report.violated[0], 0);
    EXPECT_LT(report.by_integers, report.tested / 2);
    // From outside, everything that is a point faces away or overlaps.
    EXPECT_GT(reference::depth_mesh_state(mesh, exact::exact_viewpoint({0, 0, -9})).not_facing, 0);
    EXPECT_FALSE(checked(mesh, {0, 0, -9}, thresholds).sound());
  }
  const auto mesh = fuzz::globe(3, 0.4, 7);
  // A triangle is missing.
  auto open = mesh;
  open.triangles.pop_back();
  EXPECT_EQ(reference::depth_mesh_state(open, origin).open_edges, 3);
  EXPECT_EQ(checked(open, {0, 0, 0}, thresholds).open_frames, 1);
  // Two shells: every direction is covered twice, and no triangle tells.
  auto twice = mesh;
  const auto offset = static_cast<std::uint32_t>(mesh.samples.size());
  twice.samples.insert(twice.samples.end(), mesh.samples.begin(), mesh.samples.end());
  for (const auto& t : mesh.triangles) twice.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  EXPECT_EQ(reference::depth_mesh_state(twice, origin).degree, 2);
  EXPECT_EQ(checked(twice, {0, 0, 0}, thresholds).overlapping_frames, 1);
  // A sample pushed through its neighbours.
  auto folded = mesh;
  folded.samples[5].at = {-folded.samples[5].at[0], -folded.samples[5].at[1], -folded.samples[5].at[2]};
  EXPECT_GT(reference::depth_mesh_state(folded, origin).not_facing, 0);
  EXPECT_GT(checked(folded, {0, 0, 0}, thresholds).violated[0], 0);
}

// Closed but for one triangle that is there twice: nothing is across three of its edges. That is a finding, and no error.
TEST(DepthMeshes, ATriangleThatIsThereTwiceIsFoundWithAndWithoutDelaunay) {
  auto mesh = fuzz::globe(3, 0.4, 7);
  mesh.triangles.push_back(mesh.triangles[0]);
  for (const bool delaunay : {false, true}) {
    const auto report = checked(mesh, {0, 0, 0}, {1000, 1e-12, delaunay});
    EXPECT_EQ(report.open_frames, 1);
    EXPECT_FALSE(report.sound());
  }
}

// The reference and the checker name the same violations at viewpoints on a way out of the mesh.
TEST(DepthMeshes, ReferenceAndCheckerCountTheSameViolations) {
  const auto mesh = fuzz::globe(4, 0.6, 8);
  const scene::MotionThresholds thresholds{6, 1e-3, true};
  int with = 0;
  for (int n = 0; n <= 20; ++n) {
    const scene::MotionPoint viewpoint{0.06 * n, 0.03 * n, 0.01 * n};
    const auto found = reference::violations(mesh, thresholds, exact::exact_viewpoint(viewpoint));
    const auto report = checked(mesh, viewpoint, thresholds);
    const auto count = [&](scene::MotionConstraint constraint) {
      return static_cast<std::uint64_t>(
          std::count_if(found.begin(), found.end(), [&](const auto& place) { return place.constraint == constraint; }));
    };
    EXPECT_EQ(report.violated[0], count(scene::MotionConstraint::facing)) << n;
    EXPECT_EQ(report.violated[2], count(scene::MotionConstraint::separation)) << n;
    // Once for an edge, where the list has both triangles.
    EXPECT_EQ(2 * report.violated[1], count(scene::MotionConstraint::edge_length)) << n;
    EXPECT_EQ(2 * report.violated[3], count(scene::MotionConstraint::delaunay)) << n;
    with += found.empty() ? 0 : 1;
  }
  EXPECT_GT(with, 5);
}

// Planted: a walk that skips a bin. The bounds of the reference say when the first triangle has to be looked at; a walk that never does goes
// wrong in a frame that the checker finds, and in none before the least bound.
TEST(DepthMeshes, AWalkThatSkipsABinIsCaught) {
  const auto mesh = fuzz::globe(3, 0.8, 9);
  const scene::MotionThresholds thresholds{20, 1e-8, false};
  const auto bounds = reference::motion_bounds(mesh, thresholds, exact::exact_viewpoint({0, 0, 0}));
  const double least = *std::min_element(bounds.begin(), bounds.end());
  ASSERT_GT(least, 0);
  bool caught = false;
  for (int frame = 0; frame <= 60; ++frame) {
    const double far = least * frame / 10;
    const auto report = checked(mesh, {far * 0.6, far * 0.48, far * 0.64}, thresholds);
    if (frame < 10) {
      ASSERT_TRUE(report.sound()) << frame;
    }
    caught = caught || !report.sound();
  }
  EXPECT_TRUE(caught);
}

}  // namespace
}  // namespace clues
