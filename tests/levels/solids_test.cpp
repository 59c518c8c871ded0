// Brushes as the file gives them: what they block before a level is accused, and which drawings move the sides of their hulls.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "scene/levels/bsp_hulls.h"
#include "scene/levels/bsp_solids.h"
#include "tests/app/program.h"
#include "tests/levels/made_level.h"

namespace clues::tests {
namespace {

using scene::HalfSpace;
using scene::Point;
using scene::SolidBrushes;
using testing::HasSubstr;

// In the plane y = 18, and nowhere near a brush.
constexpr std::array<Point, 3> far_wall{{{-20, 18, -20}, {20, 18, -20}, {20, 18, 20}}};

void add_word(std::string& lump, std::int64_t value) {
  for (int i = 0; i < 4; ++i) lump += static_cast<char>(value >> (8 * i) & 0xFF);
}

// A wall from y = 0 to 16 of two brushes that abut in the plane 0.6 x + 0.8 z = 0, neither of whose corners there is a
// double; a face before it, and one behind it. No cluster lists the other's face.
MadeLevel slanted_seam() {
  MadeLevel level;
  level.add_shader("textures/stone", 0, 1);
  level.add_shader("textures/caulk", 0x80, 1);
  for (const auto& p : {Point{-50, 10, 20}, {50, 10, 20}, {50, 10, 90}, {-50, 10, 90}}) level.add_vertex(p);
  level.add_quad(0);
  for (const auto& p : {Point{20, 110, 20}, {230, 110, 20}, {230, 110, 110}, {20, 110, 110}}) level.add_vertex(p);
  level.add_quad(0);
  level.add_plane(0, 1, 0, 40);
  level.add_plane(0, 1, 0, 56);
  const auto add_brush = [&](float sign) {
    add_word(level.lumps[brushes_lump], level.count(sides_lump, 8));
    add_word(level.lumps[brushes_lump], 6);
    add_word(level.lumps[brushes_lump], 1);
    for (int i = 0; i < 6; ++i) {
      add_word(level.lumps[sides_lump], level.count(planes_lump, 16) + i);
      add_word(level.lumps[sides_lump], 1);
    }
    level.add_plane(0, 1, 0, 56);
    level.add_plane(0, -1, 0, -40);
    level.add_plane(0, 0, 1, 300);
    level.add_plane(0, 0, -1, 300);
    level.add_plane(-sign, 0, 0, 500);
    level.add_plane(sign * 0.6F, 0, sign * 0.8F, sign * 100);
  };
  add_brush(1);
  add_brush(-1);
  level.add_model(0, 2, 0, 2);
  for (const int word : {0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -3, -2, 0, 0, 0, 0, 0, 0})
    add_word(level.lumps[nodes_lump], word);
  for (const int word :
       {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0})
    add_word(level.lumps[leaves_lump], word);
  for (const int word : {0, 1}) add_word(level.lumps[leaf_faces_lump], word);
  for (const int word : {2, 1}) add_word(level.lumps[visibility_lump], word);
  level.lumps[visibility_lump] += "\x01\x02";
  return level;
}

SolidBrushes brushes_of(const MadeLevel& level) { return SolidBrushes(scene::parse_bsp(level.bytes(), "made.bsp")); }

bool blocks(const SolidBrushes& brushes, const Point& v, const Point& p, const std::array<Point, 3>& drawn = far_wall) {
  return brushes.block(scene::to_rational(v), scene::to_rational(p), drawn);
}

MadeLevel two_boxes() {
  MadeLevel level = two_rooms();
  for (const auto lump : {brushes_lump, sides_lump}) level.lumps[lump].clear();
  level.add_brush_box({0, 0, 0}, {16, 16, 16}, 0);
  level.add_brush_box({16, 0, 0}, {32, 16, 16}, 0);
  level.lumps[models_lump].clear();
  level.add_model(0, 7, 0, 2);
  return level;
}

TEST(SolidBrushes, BlockWhatRunsBetweenThem) {
  const auto brushes = brushes_of(two_boxes());
  EXPECT_TRUE(blocks(brushes, {16, -8, 8}, {16, 18, 8})) << "in their common face";
  EXPECT_TRUE(blocks(brushes, {8, -8, 8}, {8, 18, 8}));
  EXPECT_TRUE(blocks(brushes, {8, -8, 16}, {8, 18, 16})) << "in a face";
  EXPECT_TRUE(blocks(brushes, {-8, -8, 8}, {8, 8, 8 - 0x1p-40})) << "of the edge x = 0, y = 0, and on into the brush";
  EXPECT_TRUE(blocks(brushes, {-8, 8, 8}, {8, -8, 8})) << "it touches that edge on its way";
  EXPECT_FALSE(blocks(brushes, {-8, 8 - 0x1p-40, 8}, {8, -8 - 0x1p-40, 8}));
  EXPECT_FALSE(blocks(brushes, {8, -8, 8}, {8, 0, 8})) << "it ends on a face";
  EXPECT_FALSE(blocks(brushes, {16, -8, 8}, {16, 0, 8})) << "on two faces";
  EXPECT_TRUE(blocks(brushes, {8, 8, 8}, {8, -8, 8})) << "it begins in a brush";
  EXPECT_TRUE(blocks(brushes, {8, 8, 8}, {8, 12, 8})) << "and ends there";
}

TEST(SolidBrushes, PassOverDrawingsALittleWithin) {
  const auto brushes = brushes_of(two_boxes());
  const std::array<Point, 3> within{{{2, 0.25, 2}, {14, 0.25, 2}, {2, 0.25, 14}}};
  EXPECT_FALSE(blocks(brushes, {4, -8, 4}, {4, 0.25, 4}, within));
  EXPECT_TRUE(blocks(brushes, {4, 32, 4}, {4, 0.25, 4}, within)) << "from behind, through the whole brush";
  const Point p{2 + 0x1p-10, 0.25, 4};
  EXPECT_FALSE(blocks(brushes, {2 + 0x1p-10, -8, 4}, p, within));
  EXPECT_TRUE(blocks(brushes, {-400, -8, 4}, p, within)) << "it enters beside the triangle";
  const std::array<Point, 3> deep{{{2, 0.625, 2}, {14, 0.625, 2}, {2, 0.625, 14}}};
  EXPECT_TRUE(blocks(brushes, {4, -8, 4}, {4, 0.625, 4}, deep));
}

// The drawing of a side, which is an ulp of a float in front of it, looked at from behind: past the edge at its foot the line is in the brush for a hundredth of a unit only, and over the triangle. (`oa_koth1`: three
// holes of a list that had none, cells 293, 1084 and 3581.)
TEST(SolidBrushes, StopWhatComesFromBehindADrawing) {
  const auto brushes = brushes_of(two_boxes());
  const double y = 16 - 0x1p-20;
  const std::array<Point, 3> drawn{{{4, y, 0}, {8, y, 12}, {12, y, 0}}};
  EXPECT_TRUE(blocks(brushes, {8, -8, -8}, {8, y, 0x1p-8}, drawn));
  EXPECT_FALSE(blocks(brushes, {8, 32, -8}, {8, y, 0x1p-8}, drawn)) << "from before it";
  EXPECT_FALSE(blocks(brushes, {8, 32, 8}, {8, y, 8}, drawn));
}

// Doubles near the corners of the two brushes leave a crack between their hulls, through which the wall behind is seen.
TEST(SolidBrushes, DoNotLetALevelBeAccusedThroughACrack) {
  const TestFolder folder;
  const auto level = slanted_seam();
  folder.write("seam.bsp", level.bytes());
  folder.write("shipped.txt", "0\n1\n");
  const auto one = run_clues(
      {"check", "seam.bsp", "--cell", "box:10,20,10,240,36,110", "--pvs", "shipped.txt", "--json"}, folder.path());
  EXPECT_EQ(one.exit_code, 3) << one.err;
  EXPECT_THAT(one.out, HasSubstr("missing-undecided")) << "the crack is there";
  const auto all = run_clues({"check", "seam.bsp", "--all-cells"}, folder.path());
  EXPECT_NE(all.exit_code, 1) << all.out;
  EXPECT_NE(all.exit_code, 2) << all.err;
}

std::set<Point> corners_of_hull(const std::vector<std::array<Point, 3>>& drawn) {
  const auto level = scene::parse_bsp(two_boxes().bytes(), "made.bsp");
  const auto bounds = scene::box_polytope({-100, -100, -100}, {100, 100, 100});
  std::set<Point> corners;
  for (const auto& face : scene::hull_of_solid(*scene::solid_of_brush(level, level.brushes[0], bounds, drawn)))
    corners.insert(face.begin(), face.end());
  return corners;
}

TEST(Hulls, AreNotMovedByWhatOnlyComesNearThePlaneOfASide) {
  const auto whole = corners_of_hull({});
  EXPECT_EQ(whole.size(), 8U);
  // Beside the brush, and within 0.5 of the plane of its side x = 16.
  EXPECT_EQ(corners_of_hull({{{{15.5, -0.75, 4}, {15.5, -0.75, 12}, {15.9375, -0.75, 8}}}}), whole);
  // The same on its side y = 0, which it touches.
  EXPECT_EQ(corners_of_hull({{{{15.5, 0, 4}, {15.5, 0, 12}, {15.9375, 0, 8}}}}), whole);
  // And a little within: the brush would hide it.
  const auto moved = corners_of_hull({{{{4, 0.125, 4}, {12, 0.125, 4}, {4, 0.125, 12}}}});
  EXPECT_TRUE(std::all_of(moved.begin(), moved.end(), [](const Point& p) { return p[1] == 0.125 || p[1] == 16; }));
  EXPECT_EQ(moved.size(), 8U);
}

}  // namespace
}  // namespace clues::tests
