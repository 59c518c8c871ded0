// Levels: what counts, what blocks, the cells of the tree, the lists that were shipped, and files that are no levels.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "scene/levels/bsp_hulls.h"
#include "scene/levels/bsp_scene.h"
#include "scene/levels/entities.h"
#include "scene/levels/rounding.h"
#include "tests/levels/made_level.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::ErrorCode;
using testing::ElementsAre;
using testing::HasSubstr;

scene::BspFile parsed(const MadeLevel& level) { return scene::parse_bsp(level.bytes(), "made.bsp"); }

std::vector<std::uint32_t> triangles_of(const scene::LevelScene& level, std::uint32_t face) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < level.scene.mesh.triangles.size(); ++t) {
    if (level.scene.mesh.face_of[t] == face) ids.push_back(t);
  }
  return ids;
}

TEST(Level, KnowsWhatCountsAndWhatBlocks) {
  const auto level = scene::scene_of_level(parsed(two_rooms()));
  const auto flags = [&](std::uint32_t face) {
    std::set<std::pair<bool, bool>> found;
    for (const auto t : triangles_of(level, face)) found.insert({level.scene.blocking(t), level.scene.counting(t)});
    return found;
  };
  const std::set<std::pair<bool, bool>> both{{true, true}}, seen_through{{false, true}}, wall{{true, false}}, none;
  EXPECT_EQ(flags(0), both);
  EXPECT_EQ(flags(1), both);
  EXPECT_EQ(flags(2), seen_through) << "glass";
  EXPECT_EQ(flags(3), seen_through) << "a patch";
  EXPECT_EQ(flags(4), none) << "a billboard";
  EXPECT_EQ(flags(5), none) << "not drawn";
  EXPECT_EQ(flags(6), seen_through) << "a mesh is not known to be opaque";
  EXPECT_EQ(flags(7), none) << "the door moves";
  EXPECT_EQ(flags(8), wall) << "the slab";
  EXPECT_EQ(flags(9), wall) << "caulk";
  EXPECT_EQ(flags(10), none) << "detail";
  EXPECT_EQ(flags(11), none) << "translucent";
  EXPECT_EQ(flags(12), none) << "of the door";
  EXPECT_EQ(level.scene.name_of(0), "face 0 (textures/stone)");
  EXPECT_EQ(level.scene.name_of(static_cast<std::uint32_t>(level.scene.mesh.triangles.size() - 1)),
            "brush 1 (textures/caulk)");
  EXPECT_EQ(triangles_of(level, 3).size(), 32U);
  EXPECT_EQ(triangles_of(level, 8).size(), 10U) << "its top is drawn all over";
}

TEST(Level, TessellatesAPatchOnItsCurve) {
  const auto level = scene::scene_of_level(parsed(two_rooms()));
  double highest = 0;
  for (const auto t : triangles_of(level, 3)) {
    for (const auto corner : level.scene.mesh.triangles[t]) {
      const auto& p = level.scene.mesh.points[corner];
      const double u = (p[0] - 200) / 16;
      EXPECT_EQ(p[2], 32 + 16 * 2 * u * (1 - u)) << "a parabola";
      EXPECT_EQ(u * 4, static_cast<int>(u * 4));
      highest = std::max(highest, p[2]);
    }
  }
  EXPECT_EQ(highest, 40);
}

// A face that was moved a little into its slab by a compiler stays visible: the slab is held behind it.
TEST(Level, HoldsHullsBehindWhatIsDrawnOnThem) {
  auto made = two_rooms();
  made.put_float(vertices_lump, 2, -0.125F);  // one corner of the floor of room 0
  const auto level = scene::scene_of_level(parsed(made));
  double top = -1000;
  for (const auto t : triangles_of(level, 8)) {
    for (const auto corner : level.scene.mesh.triangles[t]) top = std::max(top, level.scene.mesh.points[corner][2]);
  }
  EXPECT_EQ(top, -0.125);
  made.put_float(vertices_lump, 2, -1.0F);  // this one is no drawing of the side
  const auto deep = scene::scene_of_level(parsed(made));
  top = -1000;
  for (const auto t : triangles_of(deep, 8)) {
    for (const auto corner : deep.scene.mesh.triangles[t]) top = std::max(top, deep.scene.mesh.points[corner][2]);
  }
  EXPECT_EQ(top, 0);
}

// A few bytes could ask for hours: brushes share sides.
TEST(Level, WithBrushesOfTooManySidesIsRefused) {
  auto made = two_rooms();
  std::string& sides = made.lumps[sides_lump];
  const std::string one = sides.substr(0, 8);
  while (sides.size() < 8 * 1025) sides += one;
  made.put_word(brushes_lump, 0, 0);
  made.put_word(brushes_lump, 1, 1024);
  EXPECT_NO_THROW(parsed(made));
  made.put_word(brushes_lump, 1, 1025);
  EXPECT_THROW(parsed(made), scene::Error);
  made.put_word(brushes_lump, 1, 1024);
  std::string& brushes = made.lumps[brushes_lump];
  const std::string brush = brushes.substr(0, 12);
  for (int i = 0; i < 1024; ++i) brushes += brush;
  EXPECT_THROW(parsed(made), scene::Error);
}

// Far from the origin doubles lose the height of a corner above its side: they must not decide that it is no drawing.
TEST(Level, HoldsHullsBehindWhatIsDrawnFarFromTheOrigin) {
  constexpr double far = 0x1p60;
  scene::BspFile level;
  level.planes.push_back({{0.5, 0.5, -0.5}, 5});  // 0.5 * 2^60 - 0.5 * 2^60 hides what stands between them
  level.sides.push_back({0, 0});
  scene::BspFile::Brush brush;
  brush.sides = {0, 1};
  const scene::Polytope bounds = scene::box_polytope(scene::to_rational({far - 0x1p20, -0x1p20, far - 0x1p20}),
                                                     scene::to_rational({far + 0x1p20, 0x1p20, far + 0x1p20}));
  const std::vector<std::array<scene::Point, 3>> drawn{
      {{{far, 9.5, far}, {far + 1024, 9.5, far + 1024}, {far, 10, far}}}};
  const auto hull = scene::hull_of_solid(*scene::solid_of_brush(level, brush, bounds, drawn));
  EXPECT_FALSE(hull.empty());
  const scene::HalfSpace behind{scene::to_rational(level.planes[0].normal),
                                mpq_class(4.75)};  // the lowest corner's height
  for (const auto& triangle : hull) {
    for (const auto& corner : triangle) EXPECT_TRUE(behind.holds(scene::to_rational(corner)));
  }
}

TEST(Level, HasItsLeavesAsCells) {
  const auto cells = scene::cells_of_level(parsed(two_rooms()));
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[0].cluster, 0U);
  EXPECT_THAT(cells[0].outer,
              ElementsAre(scene::Point{0, 0, -16}, scene::Point{0, 0, 128}, scene::Point{0, 128, -16},
                          scene::Point{0, 128, 128}, scene::Point{128, 0, -16}, scene::Point{128, 0, 128},
                          scene::Point{128, 128, -16}, scene::Point{128, 128, 128}));
  EXPECT_EQ(cells[0].inner, cells[0].outer);
  EXPECT_EQ(cells[1].outer.front(), (scene::Point{128, 0, -16}));
}

TEST(Level, SaysHowFarItIsSeen) {
  const auto far = [](const std::string& text) { return scene::far_plane_in(text); };
  EXPECT_EQ(far("{\n\"classname\" \"worldspawn\"\n\"_farplanedist\" \"2048\"\n}\n"), 2048);
  EXPECT_EQ(far("{ \"fogclip\" \"12.5\" }"), 12.5);
  EXPECT_EQ(far("{ \"distancecull\" \"7\" \"_farplanedist\" \"9\" }"), 9) << "the first of the keys, not of the text";
  EXPECT_EQ(far("{ \"_farplanedist\" \"\" \"fogclip\" \"3\" }"), 3) << "an empty value is none";
  EXPECT_EQ(far("{ \"message\" \"a {brace} and _farplanedist\" \"_farplanedist\" \"5\" }"), 5);
  EXPECT_EQ(far("{ \"_FarPlaneDist\" \"6\" }"), 6);
  EXPECT_EQ(far("{ \"fogclip\" \"6\" \"FogClip\" \"8\" }"), 8) << "the last of two";
  // What says nothing: no number above zero, another entity than the first, broken text.
  for (const char* text :
       {"", "{", "}", "{ \"_farplanedist\" }", "{ \"_farplanedist\" \"5", "{ \"_farplanedist\" \"-4\" }",
        "{ \"_farplanedist\" \"nan\" }", "{ \"_farplanedist\" \"inf\" }", "{ \"_farplanedist\" \"1e999\" }",
        "{ \"_farplanedist\" \"far\" }", "{ \"classname\" \"x\" } { \"_farplanedist\" \"5\" }",
        "{ \"classname\" worldspawn \"_farplanedist\" \"5\" }", "\"_farplanedist\" \"5\""})
    EXPECT_EQ(far(text), 0) << text;
  EXPECT_EQ(far(std::string("{ \"_farplanedist\" \"5\" }\n") + '\0'), 5) << "texts in files end so";
}

TEST(Level, ListsWhatWasShipped) {
  auto made = two_rooms();
  auto level = parsed(made);
  const auto scene = scene::scene_of_level(level);
  const auto faces = [&](std::uint32_t cluster) {
    std::set<std::uint32_t> found;
    for (const auto t : scene::shipped_set(level, scene, cluster)) found.insert(scene.scene.mesh.face_of[t]);
    return found;
  };
  EXPECT_EQ(faces(0), (std::set<std::uint32_t>{0, 2, 6}));
  EXPECT_EQ(faces(1), (std::set<std::uint32_t>{0, 1, 2, 3, 6}));
  made.lumps[visibility_lump].clear();
  level = parsed(made);
  EXPECT_EQ(level.visibility.clusters, 2U);
  EXPECT_EQ(faces(0), (std::set<std::uint32_t>{0, 1, 2, 3, 6})) << "without visibility all is visible";
}

struct BadLevel {
  const char* name;
  std::function<void(MadeLevel&)> spoil;
  ErrorCode code;
  const char* mentions;
};
void PrintTo(const BadLevel& level, std::ostream* out) { *out << level.name; }

class BadLevelTest : public testing::TestWithParam<BadLevel> {};

TEST_P(BadLevelTest, IsRefused) {
  auto level = two_rooms();
  GetParam().spoil(level);
  const auto thrown = thrown_by([&] { scene::scene_of_level(parsed(level)); });
  EXPECT_EQ(thrown.code, GetParam().code) << thrown.text;
  EXPECT_THAT(thrown.text, HasSubstr(GetParam().mentions));
  EXPECT_THAT(thrown.text, testing::StartsWith("made.bsp: "));
}

constexpr auto out_of_range = ErrorCode::index_out_of_range;
constexpr auto malformed = ErrorCode::malformed;
constexpr std::uint32_t nan_bits = 0x7FC00000;

INSTANTIATE_TEST_SUITE_P(
    All, BadLevelTest,
    testing::Values(
        BadLevel{"Version", [](MadeLevel& l) { l.version = 47; }, ErrorCode::unsupported, "version 47"},
        BadLevel{"HalfARecord", [](MadeLevel& l) { l.lumps[planes_lump] += "1234"; }, malformed, "no multiple of 16"},
        BadLevel{"ShaderOfFace", [](MadeLevel& l) { l.put_word(faces_lump, 0, 4); }, out_of_range,
                 "face 0: the shader 4"},
        BadLevel{"KindOfFace", [](MadeLevel& l) { l.put_word(faces_lump, 2, 5); }, malformed, "its type is 5"},
        BadLevel{"VerticesOfFace", [](MadeLevel& l) { l.put_word(faces_lump, 4, 4000); }, out_of_range,
                 "face 0: vertices"},
        BadLevel{"NegativeCount", [](MadeLevel& l) { l.put_word(faces_lump, 4, 0x80000000); }, out_of_range,
                 "face 0: vertices"},
        BadLevel{"CornerOfFace", [](MadeLevel& l) { l.put_word(corners_lump, 1, 4); }, out_of_range,
                 "face 0: vertex 4"},
        BadLevel{"CornersOfFace", [](MadeLevel& l) { l.put_word(faces_lump, 6, 5); }, malformed, "no multiple of 3"},
        BadLevel{"EvenPatch", [](MadeLevel& l) { l.put_word(faces_lump, 3 * 26 + 24, 4); }, malformed,
                 "4 x 3 control points"},
        BadLevel{"PlaneOfNode", [](MadeLevel& l) { l.put_word(nodes_lump, 0, 1000); }, out_of_range,
                 "node 0: the plane 1000"},
        BadLevel{"LeafOfNode", [](MadeLevel& l) { l.put_word(nodes_lump, 1, 0xFFFFFF00); }, out_of_range, "leaf 255"},
        BadLevel{"Cycle", [](MadeLevel& l) { l.put_word(nodes_lump, 1, 0); }, malformed,
                 "node 0: the BSP tree reaches it twice"},
        BadLevel{"LeafTwice", [](MadeLevel& l) { l.put_word(nodes_lump, 1, 0xFFFFFFFF); }, malformed,
                 "leaf 0: the BSP tree reaches it twice"},
        BadLevel{"FaceOfLeaf", [](MadeLevel& l) { l.put_word(leaf_faces_lump, 2, 8); }, out_of_range,
                 "leaf face 2: the face 8"},
        BadLevel{"FacesOfLeaf", [](MadeLevel& l) { l.put_word(leaves_lump, 9, 8); }, out_of_range,
                 "leaf 0: leaf faces"},
        BadLevel{"ClusterOfLeaf", [](MadeLevel& l) { l.put_word(leaves_lump, 0, 2); }, malformed, "cluster 2"},
        BadLevel{"ClusterBelow", [](MadeLevel& l) { l.put_word(leaves_lump, 0, 0xFFFFFFFE); }, malformed,
                 "its cluster is -2"},
        BadLevel{"PlaneOfSide", [](MadeLevel& l) { l.put_word(sides_lump, 0, 99); }, out_of_range, "brush side 0"},
        BadLevel{"SidesOfBrush", [](MadeLevel& l) { l.put_word(brushes_lump, 1, 99); }, out_of_range, "brush 0"},
        BadLevel{"BrushesOfModel", [](MadeLevel& l) { l.put_word(models_lump, 9, 99); }, out_of_range, "model 0"},
        BadLevel{"ZeroNormal", [](MadeLevel& l) { l.put_float(planes_lump, 0, 0); }, malformed,
                 "plane 0: the normal is zero"},
        BadLevel{"NanPlane", [](MadeLevel& l) { l.put_word(planes_lump, 3, nan_bits); }, ErrorCode::non_finite,
                 "plane 0"},
        BadLevel{"NanVertex", [](MadeLevel& l) { l.put_word(vertices_lump, 11, nan_bits); }, ErrorCode::non_finite,
                 "vertex 1"},
        BadLevel{"InfiniteBound", [](MadeLevel& l) { l.put_word(models_lump, 0, 0x7F800000); }, ErrorCode::non_finite,
                 "model 0"},
        BadLevel{"NoModel", [](MadeLevel& l) { l.lumps[models_lump].clear(); }, malformed, "no model"},
        BadLevel{"NoTree", [](MadeLevel& l) { l.lumps[nodes_lump].clear(); }, malformed, "no BSP tree"},
        BadLevel{"ShortVisibility", [](MadeLevel& l) { l.lumps[visibility_lump].resize(12); }, malformed, "visibility"},
        BadLevel{"HugeVisibility", [](MadeLevel& l) { l.put_word(visibility_lump, 0, 0xFFFFFFFF); }, malformed,
                 "visibility"},
        BadLevel{"NarrowVisibility",
                 [](MadeLevel& l) {
                   l.put_word(visibility_lump, 0, 64);
                   l.put_word(visibility_lump, 1, 4);
                   l.lumps[visibility_lump].resize(8 + 256);
                 },
                 malformed, "4 bytes for 64"},
        BadLevel{"NothingDrawn", [](MadeLevel& l) { l.put_word(models_lump, 7, 0); }, malformed, "no triangles"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Level, OfOverlappingLumpsIsRefused) {
  std::string bytes = two_rooms().bytes();
  bytes[8 + 8 * 2] = static_cast<char>(bytes[8 + 8 * 2] - 8);  // the planes begin within the shaders
  EXPECT_THAT(thrown_by([&] { scene::parse_bsp(bytes, "x"); }).text, HasSubstr("overlap"));
}

// Cut anywhere, a level is refused: its last lump is cut, at least.
TEST(Level, CutShortIsRefused) {
  const std::string bytes = two_rooms().bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      scene::parse_bsp(std::string_view(bytes).substr(0, size), "x");
      FAIL() << size;
    } catch (const scene::Error& error) {
      ASSERT_EQ(error.code(), malformed) << size << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace clues::tests
