// clues maps as a user types it: outputs, refusals, and nothing half-written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "fuzz/multires/surfaces.h"
#include "scene/mesh_io.h"
#include "scene/multires/attributes.h"
#include "scene/scenes/scene_io.h"
#include "tests/app/program.h"

namespace clues {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(MapsCommand, WritesWhatItVerifies) {
  const tests::TestFolder folder;
  folder.write("ball.off", scene::to_off_text(fuzz::ball(4)));
  const auto ran = tests::run_clues(
      {"maps",       "ball.off", "--base",    "20", "-o",       "a.maps", "--patches", "p.ply",   "--svg",  "b.svg",
       "--base-out", "b.off",    "--uniform", "2",  "--remesh", "r.obj",  "--proof",   "r.proof", "--json", "t.json"},
      folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("verified: a homeomorphism"));
  EXPECT_THAT(folder.names(),
              ElementsAre("a.maps", "b.off", "b.svg", "ball.off", "p.ply", "r.obj", "r.proof", "t.json"));
  for (const char* mesh : {"b.off", "p.ply", "r.obj"}) EXPECT_NO_THROW(scene::read_mesh(folder.path() / mesh)) << mesh;
  EXPECT_EQ(tests::run_clues({"maps", "verify", "a.maps"}, folder.path()).exit_code, 0);
  const std::vector<std::string> judge{"maps", "verify", "a.maps", "--remesh", "r.obj", "--proof", "r.proof"};
  EXPECT_EQ(tests::run_clues(judge, folder.path()).exit_code, 0);
  auto obj = tests::read_all(folder.path() / "r.obj");
  obj.insert(obj.find('.') + 1, "0");  // a first coordinate is a tenth of what it was
  folder.write("r.obj", obj);
  const auto moved = tests::run_clues(judge, folder.path());
  EXPECT_EQ(moved.exit_code, 1);
  EXPECT_THAT(moved.out, HasSubstr("E7 vertex"));
  auto text = tests::read_all(folder.path() / "a.maps");
  text.replace(text.rfind("\npieces"), 7, "\npiecse");
  folder.write("b.maps", text);
  EXPECT_EQ(tests::run_clues({"maps", "verify", "b.maps"}, folder.path()).exit_code, 2);
}

// Texture coordinates jump at the edges of the square's halves: glTF splits vertices there, and its positions are floats.
TEST(MapsCommand, CarriesTexturesAndWritesGltf) {
  const tests::TestFolder folder;
  folder.write("sheet.obj",
               "v 0 0 0.1 1 0 0\nv 1 0 0.2 0 1 0\nv 2 0 0.3 0 0 1\nv 0 1 0.1 1 1 0\nv 1 1 0.7 0 1 1\nv 2 1 0.3 1 0 1\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
               "f 1/1 2/2 5/3\nf 1/1 5/3 4/4\nf 2/1 3/2 6/3\nf 2/1 6/3 5/4\n");
  for (const char* mesh : {"r.glb", "r.gltf", "r.ply", "r.obj"}) {
    const auto ran = tests::run_clues({"maps", "sheet.obj", "-o", "a.maps", "--uniform", "2", "--smooth", "1",
                                       "--remesh", mesh, "--proof", "r.proof", "--checker", "c.ply"},
                                      folder.path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("smoothed: "));
    const auto judged =
        tests::run_clues({"maps", "verify", "a.maps", "--remesh", mesh, "--proof", "r.proof"}, folder.path());
    EXPECT_EQ(judged.exit_code, 0) << mesh << judged.out << judged.err;
  }
  const auto remesh = scene::read_mesh(folder.path() / "r.obj");
  const auto carried = scene::read_attributes(folder.path() / "r.obj", remesh);
  EXPECT_EQ(carried.colours.size(), remesh.points.size());
  ASSERT_EQ(carried.texture_corners.size(), remesh.triangles.size());
  for (const auto& corners : carried.texture_corners) EXPECT_NE(corners[0], scene::no_vertex);
  const auto in_ply = scene::read_mesh(folder.path() / "r.ply");
  EXPECT_EQ(scene::read_attributes(folder.path() / "r.ply", in_ply).texture_corners.size(), remesh.triangles.size());
  EXPECT_GT(scene::read_scene(folder.path() / "r.glb").mesh.points.size(), remesh.points.size());
  EXPECT_GT(scene::read_mesh(folder.path() / "c.ply").triangles.size(), remesh.triangles.size());
}

// The ball, so many times as large.
scene::TriangleMesh scaled_ball(double by) {
  auto mesh = fuzz::ball(3);
  for (auto& p : mesh.points) {
    for (double& x : p) x *= by;
  }
  return mesh;
}

// Up to where squares of distances are doubles no more.
TEST(MapsCommand, ReachesAnErrorInSmallAndLargeUnits) {
  for (const double unit : {0x1p-490, 0x1p490}) {
    const tests::TestFolder folder;
    folder.write("ball.off", scene::to_off_text(scaled_ball(unit)));
    const auto ran = tests::run_clues(
        {"maps", "ball.off", "--base", "20", "--adaptive", "5", "--remesh", "r.ply", "-o", "b.maps", "--proof", "p"},
        folder.path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const auto judged =
        tests::run_clues({"maps", "verify", "b.maps", "--remesh", "r.ply", "--proof", "p"}, folder.path());
    EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  }
}

// Near the largest double positions became infinite; the box is infinitely wide there, and a part of that was "reached".
TEST(MapsCommand, WritesFinitePositionsOfHugeCoordinates) {
  const tests::TestFolder folder;
  auto mesh = scaled_ball(1);
  for (auto& p : mesh.points)
    p[0] = p[2] > 0 ? std::numeric_limits<double>::max() : -std::numeric_limits<double>::max();
  folder.write("huge.off", scene::to_off_text(mesh));
  const auto ran = tests::run_clues({"maps", "huge.off", "--base", "20", "--uniform", "1", "--remesh", "r.ply",
                                     "--checker", "c.ply", "--patches", "p.ply"},
                                    folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("bounds none (input to remesh)"));
  EXPECT_THAT(ran.out, HasSubstr("coordinates are too large for bounds"));
  for (const char* file : {"r.ply", "c.ply", "p.ply"}) EXPECT_NO_THROW(scene::read_mesh(folder.path() / file)) << file;
}

TEST(MapsCommand, PrintsNoPartOfABoxThatIsAPoint) {
  const tests::TestFolder folder;
  folder.write("point.off", scene::to_off_text(scaled_ball(0)));
  const auto ran =
      tests::run_clues({"maps", "point.off", "--base", "20", "--uniform", "1", "--remesh", "r.ply"}, folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("no point of the input is farther from it than 0, none of it"));
}

TEST(MapsCommand, RefusesAndWritesNothing) {
  const tests::TestFolder folder;
  const std::string ball = scene::to_off_text(fuzz::ball(4));
  folder.write("ball.off", ball);
  folder.write("strip.off", scene::to_off_text(fuzz::moebius(5)));
  folder.write("huge.off", scene::to_off_text(scaled_ball(0x1p1020)));
  folder.write("point.off", scene::to_off_text(scaled_ball(0)));
  folder.write("tiny.off", scene::to_off_text(scaled_ball(0x1p-1040)));
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    words.insert(words.begin(), "maps");
    const auto ran = tests::run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << why;
    EXPECT_THAT(ran.err, HasSubstr(why));
  };
  refused({"strip.off", "-o", "s.maps"}, "one side only");
  refused({"ball.off", "--uniform", "1", "--remesh", "ball.off"}, "ball.off");
  refused({"ball.off", "--svg", "ball.off"}, "ball.off");
  refused({"ball.off", "--uniform", "9", "--remesh", "r.off"}, "--uniform 9");
  refused({"ball.off", "--uniform", "1"}, "--remesh");
  refused({"ball.off", "--adaptive", "5", "--smooth", "1", "--remesh", "r.off"}, "--uniform L");
  refused({"ball.off", "--proof", "r.proof"}, "--remesh FILE is missing");
  refused({"verify", "ball.off", "--proof", "r.proof"}, "--remesh and --proof");
  refused({"ball.off", "--adaptive", "0", "--remesh", "r.off"}, "--adaptive 0");
  refused({"ball.off", "--uniform", "1", "--remesh", "r.stl"}, ".ply, .obj, .off, .glb or .gltf");
  refused({"ball.off", "--features", "181"}, "180 degrees");
  refused({"ball.off", "--base", "-1"}, "a number of triangles is 0 or more");
  refused({"huge.off", "--adaptive", "5", "--remesh", "r.ply"}, "coordinates below 2^500");
  refused({"huge.off", "--uniform", "1", "--remesh", "r.glb"}, "glTF has floats");
  refused({"point.off", "--adaptive", "5", "--remesh", "r.ply"}, "the longest side of the box is 0");
  refused({"tiny.off", "--adaptive", "5", "--remesh", "r.ply"}, "boxes above 2^-500");
  EXPECT_THAT(folder.names(), ElementsAre("ball.off", "huge.off", "point.off", "strip.off", "tiny.off"));
  EXPECT_EQ(tests::read_all(folder.path() / "ball.off"), ball);
}

}  // namespace
}  // namespace clues
