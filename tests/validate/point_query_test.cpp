// Single points: known answers in a small scene, and on random scenes the two halves of each proof, checked by other means.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "exact/sight/witness.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/messages/error.h"
#include "validate/certificates/point_query.h"
#include "validate/certificates/points_file.h"
#include "validate/certificates/segment_query.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Point3;
using testing::ElementsAre;
using testing::HasSubstr;

// Two triangles at z = 1 make the square |x|, |y| <= 2; at z = 2 two make |x|, |y| <= 10. The cell is |x|, |y| <= 1, -1/2 <= z <= 0.
class PointQueryTest : public testing::Test {
 protected:
  scene::TriangleMesh mesh_{
      {{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}, {-10, -10, 2}, {10, -10, 2}, {10, 10, 2}, {-10, 10, 2}},
      {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}},
      {0, 1, 2, 3}};
  exact::ConvexCell cell_ = exact::ConvexCell::from_doubles(
      {{-1, -1, -0.5}, {1, -1, -0.5}, {-1, 1, -0.5}, {1, 1, -0.5}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}});
  reference::Omega omega_{mesh_, cell_, {}};
  PointQuery query_{mesh_, omega_, CGAL::Bbox_3(-50, -50, -50, 50, 50, 50)};

  PointAnswer one(const Point3& p) const {
    const PointReport report = query_.ask(p);
    EXPECT_EQ(report.answers.size(), 1U);
    EXPECT_FALSE(report.answers.at(0).contradiction);
    return report.answers.at(0);
  }
};

TEST_F(PointQueryTest, InSpace) {
  const PointAnswer behind = one(Point3(0.5, -0.25, 1.5));
  EXPECT_FALSE(behind.v);
  EXPECT_FALSE(behind.first_order);
  EXPECT_THAT(behind.covered_by, ElementsAre(0, 1));
  EXPECT_FALSE(behind.triangle);
  const PointAnswer beside = one(Point3(8, 8, 1.5));
  ASSERT_TRUE(beside.v);
  EXPECT_TRUE(exact::check_sight_line(mesh_, cell_, *beside.v, Point3(8, 8, 1.5)).blockers.empty());
  EXPECT_TRUE(beside.first_order);
  const PointAnswer far = one(Point3(0, 0.125, 45));  // outside the box of the scene
  EXPECT_FALSE(far.v);
  EXPECT_FALSE(far.first_order);
}

TEST_F(PointQueryTest, OnAWedgeThePointIsOnTheBorderOfBoth) {
  // The umbra is |x|, |y| <= (4 z + 2 - 2 (z - 1)) / 3 = (2 z + 4) / 3, by the lower corners of the cell. No point of int V sees its border, but any point beside it is seen.
  const PointAnswer border = one(Point3(FT(7) / FT(3), FT(0), FT(3) / FT(2)));
  EXPECT_FALSE(border.v);
  EXPECT_TRUE(border.first_order);
}

TEST_F(PointQueryTest, OnASurfaceEachSideHasItsAnswer) {
  const PointReport report = query_.ask(Point3(0.5, 0.25, 2));
  ASSERT_EQ(report.answers.size(), 2U);
  EXPECT_EQ(report.answers[0].triangle, 2U);
  EXPECT_TRUE(report.answers[0].front && report.answers[0].faces_away);
  EXPECT_THAT(report.answers[1].covered_by, ElementsAre(0, 1));
  EXPECT_FALSE(report.answers[1].first_order);
}

TEST_F(PointQueryTest, OnAnEdgeAllTrianglesThere) {
  const PointReport seam = query_.ask(Point3(1, 1, 1));
  ASSERT_EQ(seam.answers.size(), 4U);
  for (const PointAnswer& a : seam.answers) EXPECT_EQ(a.v.has_value(), !a.front);
  EXPECT_EQ(query_.ask(Point3(2, 2, 1)).answers.size(), 4U);  // a corner of both
  EXPECT_EQ(query_.ask(Point3(2, 0, 1)).answers.size(), 2U);
}

TEST_F(PointQueryTest, OnTheBorderOfRegionsTheVisibleOneCounts) {
  // The umbra ends at |x| = 8/3 on the wall.
  const PointReport report = query_.ask(Point3(FT(8) / FT(3), FT(0.125), FT(2)));
  ASSERT_EQ(report.answers.size(), 2U);
  EXPECT_FALSE(report.answers[1].v);
  EXPECT_TRUE(report.answers[1].first_order);
}

TEST_F(PointQueryTest, InTheCell) {
  for (const auto& p : {Point3(0, 0, -0.25), Point3(1, 1, 0)}) {
    EXPECT_TRUE(query_.ask(p).in_cell);
    EXPECT_TRUE(query_.ask(p).answers.empty());
  }
}

TEST_F(PointQueryTest, ASegmentThroughTheUmbra) {
  // At z = 3/2 the umbra is |x|, |y| <= 7/3, on the way from x = -8 to x = 8.
  const Point3 a(FT(-8), FT(0), FT(3) / FT(2)), b(FT(8), FT(0), FT(3) / FT(2));
  const auto parts = ask_segment(query_, omega_, a, b);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].sight, PartSight::visible);
  EXPECT_EQ(parts[1].sight, PartSight::hidden);
  EXPECT_EQ(parts[1].from, FT(17) / FT(48));
  EXPECT_EQ(parts[1].to, FT(31) / FT(48));
  EXPECT_EQ(parts[2].sight, PartSight::visible);
  EXPECT_TRUE(exact::check_sight_line(mesh_, cell_, *parts[2].v, parts[2].at).blockers.empty());
}

TEST_F(PointQueryTest, ASegmentInASurfaceAndOneOutOfTheCell) {
  // On the wall the umbra is |x|, |y| <= 8/3.
  const auto wall = ask_segment(query_, omega_, Point3(-8, 1, 2), Point3(8, 1, 2));
  ASSERT_EQ(wall.size(), 3U);
  EXPECT_EQ(wall[1].from, FT(1) / FT(3));
  EXPECT_EQ(wall[1].to, FT(2) / FT(3));
  EXPECT_EQ(wall[1].sight, PartSight::hidden);
  // From within the cell up to the plate, and through it.
  const auto up =
      ask_segment(query_, omega_, Point3(FT(1) / FT(3), FT(0), FT(0)), Point3(FT(1) / FT(3), FT(0), FT(3) / FT(2)));
  ASSERT_EQ(up.size(), 2U);
  EXPECT_EQ(up[0].sight, PartSight::visible);
  EXPECT_EQ(up[0].to, FT(2) / FT(3));
  EXPECT_EQ(up[1].sight, PartSight::hidden);
}

// D17: wedges that a limit left out cut nothing. The middle of this segment is outside of all that they could show, and its end is seen from the cell; all of it was called hidden for that of
// the middle.
TEST(PointQueryLimits, APartOfASegmentIsHiddenAsAWholeOnly) {
  const scene::TriangleMesh mesh{
      {{-18, 60, 4}, {18, -60, 4}, {-120, -36, 4}, {-60, -18, 12}, {60, 18, 12}, {36, -120, 12}},
      {{0, 1, 2}, {3, 4, 5}},
      {0, 1}};
  const auto cell = exact::ConvexCell::from_doubles(
      {{-1, -1, -1}, {-1, -1, 0}, {-1, 1, -1}, {-1, 1, 0}, {1, -1, -1}, {1, -1, 0}, {1, 1, -1}, {1, 1, 0}});
  reference::Options options;
  options.dials.csv_limit = options.dials.csv_limit_per_edge = 0;
  const reference::Omega omega(mesh, cell, options);
  const PointQuery query(mesh, omega, CGAL::Bbox_3(-50, -50, -50, 50, 50, 50));
  const Point3 a(FT(-321) / 25, FT(-607) / 200, FT(5)), b(-3.040573065902578, -2.200401146131805, 30.0);
  const auto at = [&](const FT& share) { return a + share * (b - a); };
  EXPECT_FALSE(query.ask(at(FT(3) / 7)).answers.at(0).first_order);
  EXPECT_TRUE(query.ask(at(FT(99) / 100)).answers.at(0).v);
  const auto parts = ask_segment(query, omega, a, b);
  for (const SegmentPart& part : parts)
    EXPECT_NE(part.sight, PartSight::hidden) << CGAL::to_double(part.from) << " " << CGAL::to_double(part.to);
}

TEST(PointQueryRandom, ProofsHoldAndLabelsAreSound) {
  constexpr std::uint64_t kSeed = 20261121;
  std::uint64_t visible = 0, occluded = 0, only_first_order = 0;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    const auto scene = fuzz::generate(kind, kSeed, 2);
    SCOPED_TRACE(scene.name);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    const reference::Omega omega(scene.mesh, cell, {});
    const PointQuery query(scene.mesh, omega, CGAL::Bbox_3(-64, -64, -64, 64, 64, 64));
    fuzz::Random random(kSeed);
    for (int i = 0; i < 40; ++i) {
      const Point3 p(FT(random.between(-500, 500)) / FT(17), FT(random.between(-500, 500)) / FT(19),
                     FT(random.between(-500, 500)) / FT(23));
      for (const PointAnswer& a : query.ask(p).answers) {
        EXPECT_FALSE(a.contradiction);
        if (a.v) {
          const auto line = exact::check_sight_line(scene.mesh, cell, *a.v, p);
          EXPECT_TRUE(line.valid && line.blockers.empty());
          ++visible;
          continue;
        }
        ++occluded;
        only_first_order += a.first_order;
        // Sight lines from anywhere in the cell meet a triangle of the cover.
        for (int k = 0; k < 8; ++k) {
          std::vector<int> weights;
          for (std::size_t j = 0; j < cell.vertices().size(); ++j) weights.push_back(random.between(1, 40));
          const auto line = exact::check_sight_line(scene.mesh, cell, cell.interior_point(weights), p);
          EXPECT_TRUE(std::any_of(a.covered_by.begin(), a.covered_by.end(), [&](std::uint32_t t) {
            return std::binary_search(line.blockers.begin(), line.blockers.end(), t);
          }));
        }
      }
    }
  }
  std::printf("%lu visible, %lu occluded points, %lu of these in Omega\n", visible, occluded, only_first_order);
  EXPECT_GT(visible, 0U);
  EXPECT_GT(occluded, 0U);
}

class PointsFile : public testing::Test {
 protected:
  std::string path_ = testing::TempDir() + "/clues-points.txt";
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  ~PointsFile() override { std::remove(path_.c_str()); }
  std::string fault() const {
    try {
      read_points(path_);
    } catch (const scene::Error& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(PointsFile, DecimalsAndFractions) {
  write("# points\n\n0.1 -2/6 0x1p-3  # one\n1e3 0/5 -0\n");
  const auto points = read_points(path_);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].line, 3U);
  EXPECT_EQ(points[0].point, Point3(FT(0.1), FT(-1) / FT(3), FT(0.125)));
  EXPECT_EQ(points[1].point, Point3(1000, 0, 0));
  EXPECT_FALSE(points[1].end);
  write("0 0 0 1/2 0 0\n");
  EXPECT_EQ(read_points(path_).at(0).end, Point3(0.5, 0, 0));
}

// Leading zeros once made octal numbers of fractions, and an internal error of 08/1.
TEST_F(PointsFile, FractionsAreDecimalWhateverTheyBeginWith) {
  write("010/1 -08/09 007/0100\n");
  EXPECT_EQ(read_points(path_).at(0).point, Point3(10, FT(-8) / FT(9), FT(7) / FT(100)));
}

TEST_F(PointsFile, FaultsNameFileAndLine) {
  for (const auto& [text, mentions] : {std::pair("1 2 3\n1 2\n", "three coordinates"),
                                       {"1 2 3\n1 2 x\n", "not a number"},
                                       {"0 0 0\n1 2 1/0\n", "fraction"},
                                       {"0 0 0\n1 2 1/-2\n", "fraction"},
                                       {"0 0 0\n1 2 nan\n", "finite"},
                                       {"0 0 0\n1 2 1.5/2\n", "fraction"}}) {
    write(text);
    EXPECT_THAT(fault(), testing::AllOf(HasSubstr(path_ + ":2"), HasSubstr(mentions))) << text;
  }
  write("# nothing\n");
  EXPECT_THAT(fault(), HasSubstr("no points"));
}

}  // namespace
}  // namespace clues::validate
