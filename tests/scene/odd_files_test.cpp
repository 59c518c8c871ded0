// Files as users have them and as strangers make them: what each reader makes of it, and what it says to have left out.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/formats/file_bytes.h"
#include "scene/messages/warning.h"
#include "scene/result.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::ErrorCode;
using testing::ElementsAre;
using testing::HasSubstr;

using Triangles = std::vector<scene::Triangle>;

// Everything that is said while it lives.
class Warnings {
 public:
  Warnings() {
    scene::warning_listener() = [this](const std::string& text) { said_.push_back(text); };
  }
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  ~Warnings() { scene::warning_listener() = nullptr; }

  std::string all() const {
    std::string text;
    for (const auto& line : said_) text += line + "\n";
    return text;
  }

 private:
  std::vector<std::string> said_;
};

struct OddScene {
  const char* name;
  const char* file;
  std::string bytes;
  Triangles triangles;
  const char* warning;  // "": none
};

void PrintTo(const OddScene& scene, std::ostream* out) { *out << scene.name; }

class OddSceneTest : public testing::TestWithParam<OddScene> {};

TEST_P(OddSceneTest, IsReadAsItIsMeant) {
  const SceneFolder folder;
  const auto path = folder.write(GetParam().file, GetParam().bytes);
  const Warnings warnings;
  const auto mesh = scene::read_mesh(path);
  EXPECT_EQ(mesh.triangles, GetParam().triangles);
  EXPECT_EQ(mesh.face_of.size(), mesh.triangles.size());
  if (*GetParam().warning == 0) {
    EXPECT_EQ(warnings.all(), "");
  } else {
    const auto said = warnings.all();
    EXPECT_THAT(said, testing::AllOf(HasSubstr(path), HasSubstr(GetParam().warning)));
    EXPECT_EQ(said.find('\n'), said.size() - 1) << "one line";
  }
}

std::string name_of(const testing::TestParamInfo<OddScene>& test) { return test.param.name; }

const Triangles one{{0, 1, 2}};
const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string xyz = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

INSTANTIATE_TEST_SUITE_P(
    Obj, OddSceneTest,
    testing::Values(
        OddScene{"CornersWithASlash", "a.obj", obj + "f 1/ 2/ 3/\n", one, ""},
        OddScene{"CornersWithTwoSlashes", "a.obj", obj + "f 1// 2// 3//\n", one, ""},
        OddScene{"FacesByTheirOldName", "a.obj", obj + "fo 1 2 3\nf 1 2 4\n", {{0, 1, 2}, {0, 1, 3}}, ""},
        OddScene{"AFaceWithTwoCorners", "a.obj", obj + "f 1 2\nf 1 2 3\n", one, ":5: a face with 2 corners"},
        OddScene{"ManyFacesWithTooFewCorners", "a.obj", obj + "f 1 2 3\nf 1 2\nf 1\nf 2/1 3/1\n", one, "and 2 more"},
        OddScene{"CtrlZAtTheEnd", "a.obj", obj + "f 1 2 3\n\x1a", one, ""},
        OddScene{"CtrlZAfterTheLastFace", "a.obj", obj + "f 1 2 3\x1a", one, ""}),
    name_of);

const std::string off = "OFF\n4 1 0\n" + xyz;

template <class Value>
std::string bytes_of(std::endian order, std::initializer_list<Value> values) {
  std::string bytes;
  for (const Value value : values) append(bytes, value, order);
  return bytes;
}

// Three vertices, one triangle, `colours` numbers after it and `extras` after each vertex.
std::string binary_off(const std::string& keyword, std::size_t extras, std::int32_t colours) {
  constexpr auto big = std::endian::big;
  std::string bytes = keyword + " BINARY\n" + bytes_of<std::int32_t>(big, {3, 1, 0});
  for (int corner = 0; corner < 3; ++corner) {
    bytes += bytes_of<float>(big, {corner == 1 ? 1.F : 0.F, corner == 2 ? 1.F : 0.F, 0.F});
    for (std::size_t i = 0; i < extras; ++i) append(bytes, 0.5F, big);
  }
  bytes += bytes_of<std::int32_t>(big, {3, 0, 1, 2, colours});
  for (std::int32_t i = 0; i < colours; ++i) append(bytes, 1.F, big);
  return bytes;
}

INSTANTIATE_TEST_SUITE_P(
    Off, OddSceneTest,
    testing::Values(
        OddScene{"AllInOneLine", "a.off", "OFF 4 1 0 0 0 0 1 0 0 0 1 0 0 0 1 3 0 1 2", one, ""},
        OddScene{"AWordALine", "a.off", "OFF\n3\n1\n0\n0\n0\n0\n1\n0\n0\n0\n1\n0\n3\n0\n1\n2\n", one, ""},
        OddScene{"TwoVerticesALine",
                 "a.off",
                 "OFF\n4 2 0\n0 0 0 1 0 0\n0 1 0 0 0 1\n3 0 1 2\n3 0 1 3\n",
                 {{0, 1, 2}, {0, 1, 3}},
                 ""},
        OddScene{"AFaceOverTwoLines", "a.off", "OFF\n4 1 0\n" + xyz + "4 0 1\n2 3\n", {{0, 1, 2}, {0, 2, 3}}, ""},
        OddScene{"WithoutTheKeyword", "a.off", "4 1 0\n" + xyz + "3 0 1 2\n", one, ""},
        OddScene{"WithoutTheKeywordInOneLine", "a.off", "3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2", one, ""},
        OddScene{"ColoursKeepTheirLines", "a.off", off + "3 0 1 2 255 0 0\n", one, ""},
        OddScene{"AnEdgeAmongTheFaces", "a.off", "OFF\n4 2 0\n" + xyz + "2 0 1\n3 0 1 2\n", one, "2 corners"},
        OddScene{"CtrlZAtTheEnd", "a.off", off + "3 0 1 2\n\x1a", one, ""},
        OddScene{"Binary", "a.off", binary_off("OFF", 0, 0), one, ""},
        OddScene{"BinaryWithColours", "a.off", binary_off("COFF", 4, 3), one, ""},
        OddScene{"BinaryWithAllThereIs", "a.off", binary_off("STCNOFF", 9, 4), one, ""},
        OddScene{"BinaryWithBytesAfterIt", "a.off", binary_off("OFF", 0, 0) + "more", one,
                 "4 bytes after the last face"}),
    name_of);

const std::string ply_vertices =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string strips =
    ply_vertices + "element tristrips 2\nproperty list int int vertex_indices\nend_header\n" + xyz;
const std::string ply = ply_vertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + xyz;

std::string binary_ply() {
  constexpr auto big = std::endian::big;
  std::string bytes = ply.substr(0, ply.size() - xyz.size());
  bytes.replace(bytes.find("ascii"), 5, "binary_big_endian");
  bytes += bytes_of<float>(big, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + '\x03';
  return bytes + bytes_of<std::int32_t>(big, {0, 1, 2});
}

INSTANTIATE_TEST_SUITE_P(
    Ply, OddSceneTest,
    testing::Values(OddScene{"Strips", "a.ply", strips + "4 0 1 2 3\n3 3 2 0\n", {{0, 1, 2}, {2, 1, 3}, {3, 2, 0}}, ""},
                    OddScene{"StripsThatBeginAnew",
                             "a.ply",
                             strips + "9 0 1 2 -1 1 2 3 0 -1\n1 0\n",
                             {{0, 1, 2}, {1, 2, 3}, {3, 2, 0}},
                             ""},
                    OddScene{"StripsWithTrianglesWithoutArea",
                             "a.ply",
                             strips + "5 0 1 1 2 3\n0\n",
                             {{0, 1, 1}, {1, 1, 2}, {1, 2, 3}},
                             ""},
                    OddScene{"BytesAfterTheEnd", "a.ply", binary_ply() + std::string("\0\0\0more", 7), one,
                             "7 bytes after the last element"},
                    OddScene{"AnEdge", "a.ply",
                             ply_vertices + "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
                                 xyz + "2 0 1\n3 0 1 2\n",
                             one, ":14: a face with 2 corners"},
                    OddScene{"CtrlZAtTheEnd", "a.ply", ply + "3 0 1 2\n\x1a", one, ""}),
    name_of);

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string binary_stl() {
  std::string bytes = std::string("solid, as many begin").append(60, ' ');
  append(bytes, std::uint32_t{1}, std::endian::little);
  return bytes + bytes_of<float>(std::endian::little, {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(2, '\0');
}

INSTANTIATE_TEST_SUITE_P(
    Stl, OddSceneTest,
    testing::Values(
        OddScene{"ByteOrderMark", "a.stl", "\xEF\xBB\xBFsolid\n" + facet + "endsolid\n", one, ""},
        OddScene{"EndSolidInTwoWords", "a.stl", "solid s\n" + facet + "end solid s\n", one, ""},
        OddScene{"EverythingEndsInTwoWords", "a.stl",
                 "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nend loop\nEND "
                 "FACET\nend solid",
                 one, ""},
        OddScene{"BytesAfterTheEnd", "a.stl", binary_stl() + "exported with love", one, "18 bytes after the last"},
        OddScene{"CtrlZAtTheEnd", "a.stl", "solid\n" + facet + "endsolid\n\x1a", one, ""},
        OddScene{"NulsAtTheEnd", "a.stl", "solid\n" + facet + "endsolid\n" + std::string(512, '\0'), one, ""}),
    name_of);

TEST(OddPvs, SeveralIdsALine) {
  EXPECT_THAT(scene::parse_pvs_list("3 1\t2 # c\n\n0\r\n1 3\x1a", "p", 4), ElementsAre(0, 1, 2, 3));
}

// ---- doors

struct BadDoor {
  const char* name;
  void (*make)(const std::string& path);
  const char* says;
};

void PrintTo(const BadDoor& door, std::ostream* out) { *out << door.name; }

void link_to(const char* target, const std::string& path) { EXPECT_EQ(symlink(target, path.c_str()), 0); }

class BadDoorTest : public testing::TestWithParam<BadDoor> {};

TEST_P(BadDoorTest, IsRefusedAtOnce) {
  if (GetParam().name == std::string("LinkToTheTerminal") && access("/dev/pts/ptmx", F_OK) != 0)
    GTEST_SKIP() << "there are no terminals in here (/dev/pts is not mounted)";
  for (const std::string name : {"a.pvs", "a.clues.json", "a.obj"}) {
    const SceneFolder folder;
    const auto path = folder.file(name);
    GetParam().make(path);
    const auto thrown =
        thrown_by([&] { name == "a.obj" ? void(scene::read_mesh(path)) : void(scene::read_pvs(path, 9)); });
    EXPECT_THAT(thrown.text, testing::AllOf(HasSubstr(path), HasSubstr(GetParam().says)));
    EXPECT_TRUE(thrown.code == ErrorCode::file_unreadable || thrown.code == ErrorCode::file_not_found);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadDoorTest,
    testing::Values(
        BadDoor{"Fifo", [](const std::string& path) { EXPECT_EQ(mkfifo(path.c_str(), 0600), 0); }, "pipe or a device"},
        BadDoor{"LinkToZero", [](const std::string& path) { link_to("/dev/zero", path); }, "pipe or a device"},
        BadDoor{"LinkToTheTerminal", [](const std::string& path) { link_to("/dev/ptmx", path); }, "pipe or a device"},
        BadDoor{"Folder", [](const std::string& path) { EXPECT_EQ(mkdir(path.c_str(), 0700), 0); }, "is a folder"},
        BadDoor{"LinkToNothing", [](const std::string& path) { link_to("nowhere", path); }, "no such file"},
        BadDoor{"LinkToItself", [](const std::string& path) { link_to(path.c_str(), path); }, "cannot open"},
        BadDoor{"ALargeHole",
                [](const std::string& path) {
                  std::ofstream(path, std::ios::binary) << 'x';
                  EXPECT_EQ(truncate(path.c_str(), off_t{1} << 40), 0);
                },
                "is longer than"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Door, TheLimitIsTheLast) {
  const SceneFolder folder;
  const auto path = folder.write("a", "12345");
  EXPECT_EQ(scene::read_file_bytes(path, 5), "12345");
  EXPECT_THAT(thrown_by([&] { scene::read_file_bytes(path, 4); }).text, HasSubstr("longer than the 4 bytes"));
  EXPECT_NE(scene::read_file_bytes("/proc/self/stat", 4096), "");  // has no size
  EXPECT_THAT(thrown_by([&] { scene::read_file_bytes("/proc/self/stat", 10); }).text, HasSubstr("longer than"));
}

}  // namespace
}  // namespace clues::tests
