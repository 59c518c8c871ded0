// Bad input: exit code 2, one line that says what is wrong and where, and no output file, not even a part of one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* cell = "box:0,0,0,1,1,1";
constexpr const char* triangle_off = "OFF\n3 1 0\n0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n";

struct BadScene {
  const char* name;  // of the test
  const char* file;  // its extension chooses the reader
  std::string bytes;
  const char* mentions;  // besides the file name
};

std::string truncated_binary_ply() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double "
      "z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  return bytes + std::string(40, '\0');
}

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, ExitsWithTwoAndWritesNothing) {
  const TestFolder folder;
  const auto scene = folder.write(GetParam().file, GetParam().bytes);
  const auto ran = run_clues({"map", scene, "--cell", cell, "-o", folder.file("out.clues.json")}, folder.path());
  EXPECT_EQ(ran.exit_code, 2) << ran.err;
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr(GetParam().file), HasSubstr(GetParam().mentions)));
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{GetParam().file});
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, BadSceneTest,
    testing::Values(BadScene{"EmptyFile", "empty.off", "", ""}, BadScene{"EmptyObj", "empty.obj", "", "empty"},
                    BadScene{"TruncatedBinaryPly", "cut.ply", truncated_binary_ply(), "truncated"},
                    BadScene{"NotANumber", "nan.off", "OFF\n3 1 0\n0 0 5\nnan 0 5\n0 1 5\n3 0 1 2\n", "finite"},
                    BadScene{"Infinite", "inf.obj", "v 0 0 5\nv inf 0 5\nv 0 1 5\nf 1 2 3\n", "finite"},
                    BadScene{"IndexOutOfRange", "index.off", "OFF\n3 1 0\n0 0 5\n1 0 5\n0 1 5\n3 0 1 3\n", "3"},
                    BadScene{"UnknownExtension", "scene.xyz", "0 0 0\n", ".obj"}),
    [](const auto& test) { return test.param.name; });

struct BadCommand {
  const char* name;
  std::vector<std::string> arguments;  // after "map scene.off -o out.clues.json"
  const char* mentions;
};

void PrintTo(const BadCommand& command, std::ostream* out) { *out << command.name; }

class BadCommandTest : public testing::TestWithParam<BadCommand> {};

TEST_P(BadCommandTest, ExitsWithTwoAndWritesNothing) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  folder.write("nothing.off", "OFF\n0 0 0\n");
  folder.write("nan-cell.off", "OFF\n1 0 0\n0 nan 0\n");
  const auto before = folder.names();
  std::vector<std::string> arguments{"map", "scene.off", "-o", "out.clues.json"};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const auto ran = run_clues(arguments, folder.path());
  EXPECT_EQ(ran.exit_code, 2) << ran.err;
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr(GetParam().mentions)));
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Commands, BadCommandTest,
    testing::Values(
        BadCommand{"NoCell", {}, "--cell"}, BadCommand{"BothCells", {"--cell", cell, "--cells", cell}, "--cell"},
        BadCommand{"CellFileWithoutPoint", {"--cell", "nothing.off"}, "nothing.off"},
        BadCommand{"CellFileWithNan", {"--cell", "nan-cell.off"}, "finite"},
        BadCommand{"CellFileMissing", {"--cell", "not-there.off"}, "not-there.off"},
        BadCommand{"InvertedBox", {"--cell", "box:1,0,0,0,1,1"}, "box"},
        BadCommand{"BoxWithFiveNumbers", {"--cell", "box:1,0,0,0,1"}, "box"},
        BadCommand{"BoxWithNan", {"--cell", "box:0,0,0,nan,1,1"}, "nan"},
        BadCommand{"EmptyGrid", {"--cells", "grid:0x1x1:box:0,0,0,1,1,1"}, "grid"},
        BadCommand{"SolidModeOnOpenMesh", {"--cell", cell, "--mode", "solid"}, "solid"},
        BadCommand{"UnknownMode", {"--cell", cell, "--mode", "fluid"}, "fluid"},
        BadCommand{"UnknownKernel", {"--cell", cell, "--kernel", "quick"}, "quick"},
        BadCommand{"UnknownRefinement", {"--cell", cell, "--refine", "guess"}, "guess"},
        BadCommand{"NegativeDepth", {"--cell", cell, "--refine", "cell", "--max-depth", "-1"}, "--max-depth"},
        BadCommand{"RetractWithoutBackprojection", {"--cell", cell, "--refine", "cell", "--retract"}, "--retract"},
        BadCommand{"NegativeDepthFast",
                   {"--cell", cell, "--kernel", "fast", "--method", "subdivided", "--max-depth", "-1"},
                   "--max-depth"},
        BadCommand{"StatesOfAFastRefinement",
                   {"--cell", cell, "--kernel", "fast", "--method", "backprojected", "--map", "--render-states"},
                   "--kernel exact"},
        BadCommand{"RetractOfAFastRefinement",
                   {"--cell", cell, "--kernel", "fast", "--refine", "backprojection", "--retract"},
                   "--retract"},
        BadCommand{"IntersectPlanesNan", {"--cell", cell, "--intersect-planes", "nan"}, "--intersect-planes"},
        BadCommand{
            "IntersectPlanesRefined", {"--cell", cell, "--intersect-planes", "10", "--refine", "cell"}, "--refine"},
        BadCommand{"ToleranceWithoutNumber", {"--cell", cell, "--tolerance-area", "nan"}, "--tolerance-area"},
        BadCommand{"NegativeMinOcclusion", {"--cell", cell, "--min-occlusion", "-1"}, "--min-occlusion"},
        BadCommand{"MinOcclusionNan", {"--cell", cell, "--min-occlusion", "nan"}, "--min-occlusion"},
        BadCommand{"MinOcclusionInfinite", {"--cell", cell, "--min-occlusion", "inf"}, "--min-occlusion"},
        BadCommand{"MinOcclusionNoNumber", {"--cell", cell, "--min-occlusion", "some"}, "--min-occlusion"},
        BadCommand{"NegativeLoss", {"--cell", cell, "--simplify-boundaries", "-0.5"}, "--simplify-boundaries"},
        BadCommand{"LossAboveAll", {"--cell", cell, "--simplify-boundaries", "1.5"}, "--simplify-boundaries"},
        BadCommand{"LossNan", {"--cell", cell, "--simplify-boundaries", "nan"}, "--simplify-boundaries"},
        BadCommand{"UnknownMethod", {"--cell", cell, "--method", "guess"}, "guess"},
        BadCommand{"NegativeThreads", {"--cell", cell, "--threads", "-1"}, "threads"},
        BadCommand{"UnknownOption", {"--cell", cell, "--frobnicate"}, "--frobnicate"}),
    [](const auto& test) { return test.param.name; });

TEST(BadInput, MissingSceneIsNamed) {
  const TestFolder folder;
  const auto ran = run_clues({"map", "not-there.off", "--cell", cell, "-o", "out.clues.json"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr("not-there.off")));
  EXPECT_TRUE(folder.names().empty());
}

TEST(BadInput, NoCommandIsAUsageError) {
  const TestFolder folder;
  const auto alone = run_clues({}, folder.path());
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_EQ(alone.out, "");
  // A line for each command, and at the end what is wrong.
  for (const char* command : {"map", "precision", "check", "query", "level", "verify", "conform", "iut", "lint", "fuzz",
                              "replay", "shrink", "report", "demo"}) {
    EXPECT_THAT(alone.err, testing::ContainsRegex("\n  " + std::string(command) + " +[A-Z][^\n]*\n"));
  }
  EXPECT_THAT(alone.err, testing::EndsWith("\nclues: error: no command; give one of these\n"));
  EXPECT_EQ(run_clues({"mop"}, folder.path()).exit_code, 2);
}

TEST(BadInput, OutputIntoAMissingFolder) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  const auto ran = run_clues({"map", "scene.off", "--cell", cell, "-o", "nowhere/out.clues.json"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr("nowhere")));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.off"});
}

TEST(BadInput, OutputIsAFolder) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  const auto ran = run_clues({"map", "scene.off", "--cell", cell, "-o", folder.path().string()}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, StartsWith("clues: error: "));
}

TEST(BadInput, UnwritableFolder) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  // /proc takes no new files from anyone, root included.
  for (const std::string out : {"/proc/out.clues.json", "/proc/self/out.clues.json"}) {
    const auto ran = run_clues({"map", "scene.off", "--cell", cell, "-o", out}, folder.path());
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr("/proc")));
  }
}

TEST(BadInput, FullStandardOutput) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  const auto command = std::string(CLUES_PROGRAM) + " map " + folder.file("scene.off") + " --cell " + cell +
                       " --json >/dev/full 2>" + folder.file("err");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_THAT(read_all(folder.file("err")), StartsWith("clues: error: "));
}

// A file system of 64 kB that is full, and one more with an old result on it that must survive.
TEST(BadInput, FullDisk) {
  const TestFolder folder;
  const auto scene = folder.write("scene.off", triangle_off);
  const auto disk = folder.file("disk");
  std::filesystem::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "may not mount a file system here";
  std::ofstream(disk + "/out.clues.json") << "old";
  std::ofstream(disk + "/ballast") << std::string(200000, 'x');
  for (const std::string name : {"out.clues.json", "new.clues.json"}) {
    const auto ran = run_clues({"map", scene, "--cell", cell, "--map", "-o", disk + "/" + name}, folder.path());
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr(name)));
  }
  const auto many =
      run_clues({"map", scene, "--cells", "grid:2x1x1:box:0,0,0,1,1,1", "-o", disk + "/cells"}, folder.path());
  EXPECT_EQ(many.exit_code, 2);
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(disk)) left.push_back(entry.path().filename().string());
  EXPECT_THAT(left, testing::UnorderedElementsAre("out.clues.json", "ballast"));
  EXPECT_EQ(read_all(disk + "/out.clues.json"), "old");
  umount(disk.c_str());
}

TEST(BadInput, PvsWithAnIdBeyondTheScene) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  folder.write("pvs.txt", "0\n1\n");
  const auto ran = run_clues({"check", "scene.off", "--cell", cell, "--pvs", "pvs.txt"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr("pvs.txt")));
}

TEST(BadInput, PvsThatIsNoList) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  folder.write("pvs.txt", "0\nzero\n");
  const auto ran = run_clues({"check", "scene.off", "--cell", cell, "--pvs", "pvs.txt"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr("pvs.txt"), HasSubstr("2")));
}

// CLI11 takes -1 for the largest number of 64 digits: a seed that nobody gave, or a limit that is none.
TEST(BadNumbers, BelowZeroAreRefused) {
  const TestFolder folder;
  folder.write("scene.off", triangle_off);
  const std::vector<std::vector<std::string>> commands{
      {"fuzz", "--cases", "1", "--seed"},
      {"fuzz", "--cases", "1", "--first"},
      {"fuzz", "--cases", "1", "--errors"},
      {"shrink", "finding", "--max-steps"},
      {"walk", "scene.off", "--cells", "grid:2x1x1:box:0,0,0,2,1,1", "--steps", "2", "--seed"},
      {"walk", "scene.off", "--cells", "grid:2x1x1:box:0,0,0,2,1,1", "--steps", "2", "--drop"},
      {"serve", "scene.off", "--cells", "grid:2x1x1:box:0,0,0,2,1,1", "--drop"}};
  for (auto command : commands) {
    const std::string option = command.back();
    command.emplace_back("-1");
    const auto ran = run_clues(command, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << command[0] << " " << option;
    EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr(option + ": -1 is below 0"))) << command[0];
    EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.off"}) << command[0] << " " << option;
  }
}

}  // namespace
}  // namespace clues::tests
