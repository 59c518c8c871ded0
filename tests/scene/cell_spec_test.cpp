// D2: cells as the user writes them.
#include <gmock/gmock.h>

#include <cmath>

#include "scene/cell_spec.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::ErrorCode;
using scene::parse_cell;
using scene::parse_cells;
using scene::Point;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Box, EightCorners) {
  const auto cell = parse_cell("box:0,1,2,3,4,5");
  EXPECT_EQ(cell.name, "box:0,1,2,3,4,5");
  EXPECT_THAT(cell.points, ElementsAre(Point{0, 1, 2}, Point{3, 1, 2}, Point{0, 4, 2}, Point{3, 4, 2}, Point{0, 1, 5},
                                       Point{3, 1, 5}, Point{0, 4, 5}, Point{3, 4, 5}));
}

TEST(Box, FlatOnesHaveTheirDistinctCorners) {
  EXPECT_THAT(parse_cell("box:0,0,0,1,1,0").points,
              ElementsAre(Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{1, 1, 0}));
  EXPECT_THAT(parse_cell("box:0,0,0,0,0,1").points, ElementsAre(Point{0, 0, 0}, Point{0, 0, 1}));
  EXPECT_THAT(parse_cell("box:1,2,3,1,2,3").points, ElementsAre(Point{1, 2, 3}));
  EXPECT_EQ(parse_cell("box:-0,0,0,0,0,0").points.size(), 1u);
}

TEST(Box, NumbersAsInScenes) {
  EXPECT_EQ(bits_of(parse_cell("box:-0,0x1p-1074,0.1,0,0x1p-1074,0.1").points), bits_of({Point{-0.0, 0x1p-1074, 0.1}}));
}

struct BadCell {
  const char* name;
  std::string text;
  ErrorCode code;
  const char* mentions;
};

void PrintTo(const BadCell& cell, std::ostream* out) { *out << cell.name; }

class BadCellTest : public testing::TestWithParam<BadCell> {};

TEST_P(BadCellTest, IsRefused) {
  const auto thrown = thrown_by([] { parse_cells(GetParam().text); });
  EXPECT_EQ(thrown.code, GetParam().code) << thrown.text;
  EXPECT_THAT(thrown.text, HasSubstr(GetParam().mentions));
}

INSTANTIATE_TEST_SUITE_P(
    Cells, BadCellTest,
    testing::Values(BadCell{"Empty", "", ErrorCode::bad_cell, "empty"},
                    BadCell{"FiveNumbers", "box:0,0,0,1,1", ErrorCode::bad_cell, "5"},
                    BadCell{"SevenNumbers", "box:0,0,0,1,1,1,1", ErrorCode::bad_cell, "7"},
                    BadCell{"Word", "box:0,0,zero,1,1,1", ErrorCode::bad_cell, "zero"},
                    BadCell{"MissingNumber", "box:0,0,,1,1,1", ErrorCode::bad_cell, "''"},
                    BadCell{"Nan", "box:0,0,nan,1,1,1", ErrorCode::non_finite, "nan"},
                    BadCell{"Infinity", "box:0,0,0,1,1,inf", ErrorCode::non_finite, "inf"},
                    BadCell{"Overflow", "box:0,0,0,1,1,1e999", ErrorCode::non_finite, "1e999"},
                    BadCell{"InvertedX", "box:1,0,0,0,1,1", ErrorCode::bad_cell, "axis x"},
                    BadCell{"InvertedY", "box:0,2,0,1,1,1", ErrorCode::bad_cell, "axis y"},
                    BadCell{"InvertedZ", "box:0,0,2,1,1,1", ErrorCode::bad_cell, "axis z"},
                    BadCell{"GridOfNone", "grid:2x0x1:box:0,0,0,1,1,1", ErrorCode::bad_cell, "2x0x1"},
                    BadCell{"GridOfMinusOne", "grid:-1x1x1:box:0,0,0,1,1,1", ErrorCode::bad_cell, "-1x1x1"},
                    BadCell{"GridOfTwoCounts", "grid:2x2:box:0,0,0,1,1,1", ErrorCode::bad_cell, "2x2"},
                    BadCell{"GridTooLarge", "grid:99999x99999x99999:box:0,0,0,1,1,1", ErrorCode::bad_cell, "cells"},
                    BadCell{"GridWithoutBox", "grid:2x2x2", ErrorCode::bad_cell, "box:"},
                    BadCell{"GridOfInvertedBox", "grid:2x2x2:box:0,0,0,1,-1,1", ErrorCode::bad_cell, "axis y"},
                    BadCell{"GridOnFlatAxis", "grid:1x1x2:box:0,0,0,1,1,0", ErrorCode::bad_cell, "axis z"},
                    BadCell{"MissingFile", "nowhere/nothing.off", ErrorCode::file_not_found, "nothing.off"}),
    [](const auto& test) { return test.param.name; });

TEST(CellFile, VerticesWithoutFaces) {
  const SceneFolder folder;
  for (const auto& path :
       {folder.write("c.obj", "v 0 0 0\nv 1 0 0\n"), folder.write("c.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n"),
        folder.write("c.ply",
                     "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
                     "y\nproperty float z\nend_header\n0 0 0\n1 0 0\n")}) {
    const auto cell = parse_cell(path);
    EXPECT_EQ(cell.name, path);
    EXPECT_THAT(cell.points, ElementsAre(Point{0, 0, 0}, Point{1, 0, 0}));
  }
}

TEST(CellFile, WithoutAPoint) {
  const SceneFolder folder;
  for (const auto& path : {folder.write("c.obj", "# nothing\n"), folder.write("c.off", "OFF\n0 0 0\n"),
                           folder.write("c.stl", "solid\nendsolid\n")}) {
    const auto thrown = thrown_by([&] { parse_cell(path); });
    EXPECT_EQ(thrown.code, ErrorCode::bad_cell);
    EXPECT_THAT(thrown.text, AllOf(HasSubstr(path), HasSubstr("no point")));
  }
}

TEST(CellFile, WithNan) {
  const SceneFolder folder;
  const auto path = folder.write("c.obj", "v 0 0 0\nv 0 nan 0\n");
  const auto thrown = thrown_by([&] { parse_cell(path); });
  EXPECT_EQ(thrown.code, ErrorCode::non_finite);
  EXPECT_THAT(thrown.text, HasSubstr(path + ":2"));
}

TEST(Grid, OneCellIsNoGrid) {
  EXPECT_EQ(thrown_by([] { parse_cell("grid:1x1x1:box:0,0,0,1,1,1"); }).code, ErrorCode::bad_cell);
  EXPECT_EQ(parse_cells("box:0,0,0,1,1,1").size(), 1u);
}

TEST(Grid, XFastestAndNamedByIndex) {
  const auto cells = parse_cells("grid:2x3x1:box:0,0,0,2,3,1");
  ASSERT_EQ(cells.size(), 6u);
  std::vector<std::string> names;
  for (const auto& cell : cells) names.push_back(cell.name);
  EXPECT_THAT(names, ElementsAre("0,0,0", "1,0,0", "0,1,0", "1,1,0", "0,2,0", "1,2,0"));
  EXPECT_EQ(cells[3].points.front(), (Point{1, 1, 0}));
  EXPECT_EQ(cells[3].points.back(), (Point{2, 2, 1}));
}

TEST(Grid, NeighboursShareTheirBoundBitForBit) {
  const auto cells = parse_cells("grid:49x1x1:box:0.1,0,0,0.7,1,1");
  ASSERT_EQ(cells.size(), 49u);
  EXPECT_EQ(cells.front().points.front()[0], 0.1);
  EXPECT_EQ(cells.back().points.back()[0], 0.7);
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    EXPECT_EQ(cells[i].points.back()[0], cells[i + 1].points.front()[0]);
    EXPECT_LT(cells[i].points.front()[0], cells[i].points.back()[0]);
  }
}

TEST(Grid, BoundsAreTheNearestDoubles) {
  const auto whole = parse_cells("grid:49x1x1:box:0,0,0,49,1,1");
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(whole[i].points.front()[0], static_cast<double>(i));
  // A width that no double holds does not overflow; a subnormal one does not vanish.
  const auto huge = parse_cells("grid:2x1x1:box:-1.7e308,0,0,1.7e308,1,1");
  EXPECT_EQ(huge[1].points.front()[0], 0.0);
  const auto tiny = parse_cells("grid:3x1x1:box:-0x1p-1074,0,0,0x2p-1074,1,1");
  EXPECT_EQ(tiny[1].points.front()[0], 0.0);
  EXPECT_EQ(tiny[2].points.front()[0], 0x1p-1074);
  // As division rounds them.
  const auto thirds = parse_cells("grid:3x1x1:box:-1,0,0,0,1,1");
  EXPECT_EQ(thirds[1].points.front()[0], -2.0 / 3.0);
  EXPECT_EQ(thirds[2].points.front()[0], -1.0 / 3.0);
  // These lie above the middle of two doubles, and below.
  const auto fifths = parse_cells("grid:5x1x1:box:0,0,0,1,1,1");
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(fifths[i].points.front()[0], static_cast<double>(i) / 5.0);
  // Half way between two doubles: the even one.
  const auto tie = parse_cells("grid:2x1x1:box:1,0,0,0x1.0000000000003p+0,1,1");
  EXPECT_EQ(tie[1].points.front()[0], 0x1.0000000000002p+0);
}

}  // namespace
}  // namespace clues::tests
