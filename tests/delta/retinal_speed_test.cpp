// FIG. 50A: speeds over the retina are bounded from below, and details go unseen only where that is proved. Against
// points taken at random, and with a bound that is too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "reference/link/retinal_speed.h"
#include "scene/messages/error.h"
#include "tests/app/program.h"
#include "tests/reference/support.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Point3;
using exact::Vector3;
using reference::MovingEye;

Point3 random_point(std::mt19937_64& random, int size) {
  const auto number = [&] { return static_cast<int>(random() % static_cast<unsigned>(2 * size + 1)) - size; };
  return {number(), number(), number()};
}

// A mesh of one triangle.
scene::TriangleMesh one_triangle(const std::array<Point3, 3>& corners) {
  scene::TriangleMesh mesh;
  for (const Point3& p : corners) mesh.points.push_back(exact::to_double_estimate(p));
  mesh.triangles.push_back({0, 1, 2});
  return mesh;
}

// A point of the triangle, by fractions.
Point3 point_of(const std::array<Point3, 3>& t, std::mt19937_64& random) {
  FT u = FT(static_cast<int>(random() % 17)) / 16, v = FT(static_cast<int>(random() % 17)) / 16;
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

FT squared_speed_of(const MovingEye& eye, const Point3& p) {
  const Vector3 r = p - eye.at;
  return CGAL::cross_product(eye.velocity, r).squared_length() / (r.squared_length() * r.squared_length());
}

TEST(RetinalSpeed, DistancesToATriangleAreExact) {
  const Point3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(reference::squared_distance({1, 1, 3}, a, b, c), FT(9));   // above its inside
  EXPECT_EQ(reference::squared_distance({2, -2, 1}, a, b, c), FT(5));  // beside an edge
  EXPECT_EQ(reference::squared_distance({6, 0, 0}, a, b, c), FT(4));   // at a corner
  EXPECT_EQ(reference::squared_distance({1, 1, 0}, a, b, c), FT(0));   // in it
  EXPECT_EQ(reference::squared_distance({2, 3, 0}, a, b, b), FT(9));   // a segment
  EXPECT_EQ(reference::squared_distance({2, 3, 0}, a, a, a), FT(13));  // a point
}

TEST(RetinalSpeed, NoPointOfTheTriangleIsSlower) {
  std::mt19937_64 random(kSeed);
  std::uint64_t moving = 0;
  for (int i = 0; i < 300; ++i) {
    const std::array<Point3, 3> corners{random_point(random, 9), random_point(random, 9), random_point(random, 9)};
    const MovingEye eye{random_point(random, 9), random_point(random, 9) - CGAL::ORIGIN};
    const FT bound = reference::squared_speed_bound(eye, one_triangle(corners), 0);
    moving += bound > 0 ? 1U : 0U;
    for (int k = 0; k < 20; ++k) {
      const Point3 p = point_of(corners, random);
      if (p == eye.at) continue;
      EXPECT_LE(bound, squared_speed_of(eye, p)) << "triangle " << i;
    }
  }
  EXPECT_GT(moving, 100U);
}

TEST(RetinalSpeed, OfAPointIsItsSpeedAndWhatIsAheadStandsStill) {
  const Point3 p(3, 4, 0);
  const MovingEye eye{{0, 0, 0}, {5, 0, 0}};
  EXPECT_EQ(reference::squared_speed_bound(eye, one_triangle({p, p, p}), 0), squared_speed_of(eye, p));
  EXPECT_EQ(squared_speed_of(eye, p), FT(400) / 625);  // |(5, 0, 0) x (3, 4, 0)| / 25
  EXPECT_EQ(reference::squared_speed_bound(eye, one_triangle({{{9, -1, -1}, {9, 2, -1}, {9, 0, 2}}}), 0), FT(0));
  EXPECT_EQ(reference::squared_speed_bound(eye, one_triangle({{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}}), 0), FT(0));
}

// The speed of the slowest corner, which is what comes to mind first: between corners that pass on either side of what
// is ahead the image stands still.
TEST(PlantedRetinalSpeed, TheSlowestCornerIsNoBound) {
  std::mt19937_64 random(kSeed);
  std::uint64_t caught = 0;
  for (int i = 0; i < 100; ++i) {
    const std::array<Point3, 3> corners{random_point(random, 9), random_point(random, 9), random_point(random, 9)};
    const MovingEye eye{random_point(random, 9), random_point(random, 9) - CGAL::ORIGIN};
    if (std::find(corners.begin(), corners.end(), eye.at) != corners.end()) continue;
    const FT wrong = std::min(
        {squared_speed_of(eye, corners[0]), squared_speed_of(eye, corners[1]), squared_speed_of(eye, corners[2])});
    for (int k = 0; k < 20; ++k) {
      const Point3 p = point_of(corners, random);
      if (p == eye.at || squared_speed_of(eye, p) >= wrong) continue;
      ++caught;
      break;
    }
  }
  EXPECT_GT(caught, 10U);
}

TEST(RetinalSpeed, TheCoarsestDetailThatGoesUnseenIsTaken) {
  // Ten units to the side of a viewer who passes at ten units a second: about a radian a second.
  const auto mesh = one_triangle({{{10, 0, 0}, {10, 1, 0}, {10, 0, 1}}});
  const MovingEye eye{{0, 0, 0}, {0, 0, 10}};
  const std::vector<double> errors{0, 0.05, 0.5, 2};
  using Curve = std::vector<scene::PerceptionRow>;
  const auto detail = [&](const Curve& curve) { return reference::detail_unseen(curve, eye, mesh, 0, errors); };
  EXPECT_EQ(detail({{0, 0}, {0.5, 0.01}}), 1U);  // 0.1 at ten units, and the sine of it
  EXPECT_EQ(detail({{0, 0}, {0.5, 0.06}}), 2U);
  EXPECT_EQ(detail({{0, 0}, {0.5, 0.05}}), 1U);  // 0.5 would need the sine to be 0.05
  EXPECT_EQ(detail({{0, 0}, {0.5, 1}}), 3U);
  EXPECT_EQ(detail({{0, 0}, {2, 1}}), 0U);  // it is slower than that
  EXPECT_EQ(detail({{2, 1}}), 0U);          // below the first line
  EXPECT_EQ(detail({{0, 0.06}, {2, 1}}), 2U);
}

TEST(PerceptionCurve, IsReadStrictly) {
  const tests::TestFolder folder;
  const auto read = [&](const std::string& text) { return scene::read_perception_curve(folder.write("c", text)); };
  const auto curve = read("# speed error\n0 0.0003\n0.5 0.001 # faster\n\n3e0 0.01\n");
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_EQ(curve[2].speed, 3);
  EXPECT_EQ(curve[1].error, 0.001);
  for (const char* bad : {"", "# none\n", "1\n", "1 2 3\n", "a 0.1\n", "0 0.1x\n", "-1 0.1\n", "0 -0.1\n", "0 1.5\n",
                          "nan 0.1\n", "0 inf\n", "1 0.1\n1 0.2\n", "1 0.1\n0 0.2\n", "0 0.2\n1 0.1\n"})
    EXPECT_THROW(read(bad), scene::Error) << bad;
  try {
    read("0 0.1\n1 0.01\n");
    ADD_FAILURE();
  } catch (const scene::Error& e) {
    EXPECT_NE(std::string(e.what()).find("c:2: the error is below that of the line before"), std::string::npos)
        << e.what();
  }
}

TEST(DetailCommand, CountsTrianglesByDetailAndRefusesWhatMakesNoSense) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  folder.write("c", "0 0\n0.001 1\n");
  const std::vector<std::string> detail{"delta",
                                        "detail",
                                        "screen.off",
                                        "--from",
                                        "box:-0.25,-0.25,-0.25,0,0.25,0",
                                        "--to",
                                        "box:0,-0.25,-0.25,0.25,0.25,0",
                                        "--curve",
                                        "c"};
  const auto ran =
      tests::run_clues(detail, {"--eye", "0,0,-0.1", "--velocity", "1,0,0", "--errors", "0.1,0.2"}, folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("packet +: "), std::string::npos) << ran.out;
  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"--eye", "-0.1,0,-0.1", "--velocity", "1,0,0", "--errors",
                                              "0.1"},  // in the first cell, where nothing of it is seen
                                             {"--eye", "0.1,0", "--velocity", "1,0,0", "--errors", "0.1"},
                                             {"--eye", "0.1,0,-0.1", "--velocity", "1,0,nan", "--errors", "0.1"},
                                             {"--eye", "0.1,0,-0.1", "--velocity", "1,0,0", "--errors", "0.2,0.1"},
                                             {"--eye", "0.1,0,-0.1", "--velocity", "1,0,0", "--errors", ""}}) {
    const auto refused = tests::run_clues(detail, bad, folder.path());
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
}

}  // namespace
}  // namespace clues::test
