// The other ways in: shared libraries, result files, and the adapters that people copy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "scene/mesh_io.h"
#include "scene/result.h"
#include "support.h"
#include "validate/vectors/reader.h"

namespace clues::tests {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Pair;

constexpr const char* solid_case = "box-shows-its-front-to-a-small-cell";

// ---- adapters

TEST(Adapters, AreSoundAsTheyStand) {
  const auto usual = conform({"--impl", planted("everything-visible")});
  for (const std::string command :
       {"'" PYTHON "' '" CLUES_SOURCE_DIR "/validate/adapters/python/clues_adapter.py'", "'" ADAPTER_CPP "'"}) {
    const auto done = conform({"--impl", command});
    EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out << done.ran.err;
    EXPECT_EQ(done.outcomes, usual.outcomes);
    EXPECT_THAT(done.ran.out, HasSubstr("implementation: my implementation 0.1"));
  }
  auto without_solid = usual.outcomes;
  without_solid[solid_case] = "unsupported";
  EXPECT_EQ(conform({"--impl", ADAPTER_C}).outcomes, without_solid);
}

TEST(Adapters, AreShort) {
  for (const std::string file : {"python/clues_adapter.py", "cpp/clues_adapter.cpp", "c/clues_adapter.c"}) {
    const auto text = read_all(CLUES_SOURCE_DIR "/validate/adapters/" + file);
    const auto lines = std::count(text.begin(), text.end(), '\n');
    EXPECT_GT(lines, 10);
    EXPECT_LT(lines, 150) << file;
    EXPECT_THAT(text, HasSubstr("SPDX-License-Identifier: MIT"));
  }
}

// ---- shared libraries

class LibraryTest : public testing::Test {
 protected:
  static Conformed run(const std::string& mode, const std::vector<std::string>& more = {}) {
    setenv("CLUES_PLANTED", mode.c_str(), 1);
    std::vector<std::string> arguments{"--impl", PLANTED_LIBRARY};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto done = conform(arguments);
    unsetenv("CLUES_PLANTED");
    done.outcomes.erase(solid_case);
    return done;
  }
};

TEST_F(LibraryTest, ListsEverything) {
  const auto done = run("");
  EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out << done.ran.err;
  EXPECT_EQ(done.report["total"]["outcomes"]["unsound"], 0);
  EXPECT_EQ(done.report["implementation"]["name"], "libclues_planted_library.so");
}

TEST_F(LibraryTest, MayPrint) { EXPECT_EQ(run("prints").outcomes, run("").outcomes); }

struct Planted {
  const char* mode;
  const char* outcome;
  int exit_code;
};
void PrintTo(const Planted& planted, std::ostream* out) { *out << planted.mode; }

class BadLibraryTest : public LibraryTest, public testing::WithParamInterface<Planted> {};

TEST_P(BadLibraryTest, IsContained) {
  const auto done = run(GetParam().mode);
  EXPECT_EQ(done.ran.exit_code, GetParam().exit_code) << done.ran.out << done.ran.err;
  EXPECT_THAT(done.outcomes, Each(Pair(testing::_, GetParam().outcome)));
}

INSTANTIATE_TEST_SUITE_P(Planted, BadLibraryTest,
                         testing::Values(Planted{"crashes", "crash", 1}, Planted{"exits", "crash", 1},
                                         Planted{"hides", "unsound", 1}, Planted{"writes-255", "malformed_output", 1},
                                         Planted{"forgets-the-last", "malformed_output", 1},
                                         Planted{"errs", "errored", 3}, Planted{"skips", "skipped", 3},
                                         Planted{"rejects", "rejected_input", 3}),
                         [](const auto& test) {
                           std::string name;
                           for (const char* c = test.param.mode; *c != 0; ++c)
                             name += *c == '-' ? "_" : std::string(1, *c);
                           return name;
                         });

TEST_F(LibraryTest, MayHang) {
  const auto done = run("hangs", {"--case", "gap-of-zero", "--time-limit", "0.2"});
  EXPECT_EQ(done.outcomes, (std::map<std::string, std::string>{{"gap-of-zero", "timeout"}}));
}

// ---- result files

TEST(ResultFiles, ExportedCasesKeepEveryBit) {
  const TestFolder folder;
  const auto ran = run_clues({"conform", "--suite", small_suite, "--export", folder.file("cases")}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto list = nlohmann::json::parse(read_all(folder.file("cases/cases.json")));
  const auto suite = validate::read_suite(small_suite);
  ASSERT_EQ(list["cases"].size(), suite.size());
  for (std::size_t i = 0; i < suite.size(); ++i) {
    EXPECT_EQ(list["cases"][i]["id"], suite[i].id);
    EXPECT_EQ(list["cases"][i]["mode"], suite[i].id == solid_case ? "solid" : "sheet");
    const auto mesh = scene::read_mesh(folder.file("cases/" + list["cases"][i]["scene"].get<std::string>()));
    EXPECT_EQ(mesh.points, suite[i].mesh.points);
    EXPECT_EQ(mesh.triangles, suite[i].mesh.triangles);
    const auto cell = read_all(folder.file("cases/" + list["cases"][i]["cell"].get<std::string>()));
    EXPECT_THAT(cell, testing::StartsWith("OFF\n" + std::to_string(suite[i].cell.size()) + " 0 0\n"));
  }
}

// The exported files are what `clues map` reads: export, map, and hand the results in.
TEST(ResultFiles, OfCluesMapItselfAreTight) {
  const TestFolder folder;
  ASSERT_EQ(run_clues({"conform", "--suite", small_suite, "--export", folder.file("cases")}, folder.path()).exit_code,
            0);
  std::filesystem::create_directory(folder.file("out"));
  const auto list = nlohmann::json::parse(read_all(folder.file("cases/cases.json")));
  const char* const endings[] = {".clues.json", ".pvs", ".txt"};
  std::size_t i = 0;
  for (const auto& test : list["cases"]) {
    const auto out = "out/" + test["id"].get<std::string>() + endings[i++ % 3];
    const auto ran = run_clues({"map", "cases/" + test["scene"].get<std::string>(), "--cell",
                                "cases/" + test["cell"].get<std::string>(), "--mode", test["mode"], "-o", out},
                               folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
  }
  const auto done = conform({"--results", folder.file("out")});
  EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out;
  EXPECT_THAT(done.outcomes, Each(Pair(testing::_, "tight")));
}

TEST(ResultFiles, EachKindOfFaultIsItsOwn) {
  const TestFolder folder;
  folder.write("wall-in-the-open.pvs", "0\n1\n");
  folder.write("screen-hides-one-triangle.pvs", "0\n1\n2\n3\n");  // 4 is missing
  folder.write("gap-of-zero.txt", "0\nfour\n");
  folder.write("gap-of-one-ulp.txt", "99\n");
  folder.write("slit-off-centre.pvs", "0\n");
  folder.write("slit-off-centre.txt", "0\n");
  const auto done = conform({"--results", folder.path().string()});
  EXPECT_EQ(done.ran.exit_code, 1);
  EXPECT_EQ(done.outcomes.at("wall-in-the-open"), "tight");
  EXPECT_EQ(done.outcomes.at("screen-hides-one-triangle"), "unsound");
  EXPECT_EQ(done.outcomes.at("gap-of-zero"), "malformed_output");
  EXPECT_EQ(done.outcomes.at("gap-of-one-ulp"), "malformed_output");
  EXPECT_EQ(done.outcomes.at("slit-off-centre"), "malformed_output");
  EXPECT_EQ(done.outcomes.at("two-crossed-slits"), "errored");
  EXPECT_THAT(done.ran.out,
              AllOf(HasSubstr("missed=1; triangle 4"), HasSubstr("no result file two-crossed-slits.clues.json"),
                    HasSubstr("--results " + folder.path().string() + " --case gap-of-zero")));
}

TEST(ResultFiles, AFileThatIsNotThereIsNoSuccess) {
  const TestFolder folder;
  EXPECT_EQ(conform({"--results", folder.path().string()}).ran.exit_code, 3);
  folder.write("wall-in-the-open.pvs", "0\n1\n");
  EXPECT_EQ(conform({"--results", folder.path().string()}).ran.exit_code, 3);
  EXPECT_EQ(conform({"--results", folder.path().string(), "--case", "wall-*"}).ran.exit_code, 0);
}

}  // namespace
}  // namespace clues::tests
