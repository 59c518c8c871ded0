// `clues motion` as a user meets it: files out, errors in, and what the checker of walks says to its meshes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/mesh_io.h"
#include "scene/motion/motion_files.h"
#include "tests/app/program.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

class MotionCommand : public ::testing::Test {
 protected:
  MotionCommand() { folder.write("room.off", scene::to_off_text(room())); }
  Ran run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "motion");
    return run_clues(arguments, folder.path());
  }
  // Ends with 2, says this, and leaves nothing.
  void refuses(std::vector<std::string> arguments, const std::string& message) {
    const auto names = folder.names();
    arguments.insert(arguments.end(), {"--csv", "out.csv"});
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit_code, 2) << ran.err;
    EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    EXPECT_EQ(folder.names(), names);
  }
  TestFolder folder;
};

TEST_F(MotionCommand, WritesTheSameFilesEachTimeAndTheCheckerAgrees) {
  for (const std::string name : {"a", "b"}) {
    const Ran ran = run({"room.off",
                         "--path",
                         "orbit:0,0,0,0.5,0.1",
                         "--frames",
                         "8",
                         "--samples",
                         "200",
                         "--delaunay",
                         "--csv",
                         name + ".csv",
                         "--svg",
                         name + ".svg",
                         "--ply",
                         "0:" + name + "0.ply",
                         "--ply",
                         "8:" + name + "8.ply",
                         "--walk-out",
                         name + ".jsonl",
                         "--mesh-out",
                         name + ".mesh.json",
                         "--bounds-out",
                         name + ".bounds.json",
                         "--json",
                         name + ".json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.out.find("720 triangles, 200 samples, 8 frames"), std::string::npos) << ran.out;
  }
  for (const char* end : {".csv", ".svg", "0.ply", "8.ply", ".jsonl", ".mesh.json", ".bounds.json", ".json"}) {
    EXPECT_EQ(read_all(folder.path() / (std::string("a") + end)), read_all(folder.path() / (std::string("b") + end)))
        << end;
  }
  EXPECT_EQ(run({"verify", "a.jsonl"}).exit_code, 0);
}

TEST_F(MotionCommand, BadPathsAreRefused) {
  folder.write("nan.txt", "0 0 0\n0 nan 0\n");
  folder.write("short.txt", "0 0 0\n# a comment\n0 1\n");
  folder.write("word.txt", "0 0 zero\n");
  folder.write("none.txt", "# nothing\n");
  folder.write("two.txt", "0 0 0\n0.5 0 0\n");
  refuses({"room.off", "--path", "nan.txt"}, "nan.txt:2");
  refuses({"room.off", "--path", "short.txt"}, "short.txt:3: a viewpoint is three numbers");
  refuses({"room.off", "--path", "word.txt"}, "word.txt:1");
  refuses({"room.off", "--path", "none.txt"}, "no viewpoint");
  refuses({"room.off", "--path", "missing.txt"}, "missing.txt");
  refuses({"room.off", "--path", "two.txt", "--frames", "2"}, "--frames 2");
  refuses({"room.off", "--path", "orbit:0,0,0"}, "expected orbit");
  refuses({"room.off", "--path", "orbit:0,0,0,-1"}, "above 0");
  refuses({"room.off", "--path", "orbit:0,0,0,inf"}, "not finite");
  refuses({"room.off", "--path", "walk:0,0,0"}, "two corners");
  refuses({"room.off", "--path", "walk:0,0,0:1,x,0"}, "no number");
  refuses({"room.off", "--path", "walk:0,0,0:1e300,0,0"}, "2^90");
  folder.write("far.txt", "0 0 0\n0 1e300 0\n");
  refuses({"room.off", "--path", "far.txt"}, "far.txt:2: the viewpoint is further than 2^90");
  folder.write("overflow.txt", "0 0 1e400\n");
  refuses({"room.off", "--path", "overflow.txt"}, "overflow.txt:1");
  refuses({"room.off", "--path", "."}, "is a folder");
}

// Ways that nobody planned for: each walk ends well, and the checker finds every frame valid.
TEST_F(MotionCommand, WaysThatJumpStandStillReturnGoThroughWallsAndOntoSamples) {
  folder.write("jumps.txt", "0 0 0\n0.01 0 0\n-4 -3 1\n4 3 1\n4.01 3 1\n0 0 0\n");
  folder.write("still.txt", "0 0 0\n0 0 0\n0 0 0\n");
  folder.write("returns.txt", "0 0 0\n0.1 0 0\n0.2 0 0\n0.1 0 0\n0 0 0\n");
  folder.write("walls.txt", "4.8 0.1 0\n4.9 0.1 0\n5 0.1 0\n5.1 0.1 0\n8 0.1 0\n5 4 2\n1 1 0.5\n");
  ASSERT_EQ(run({"room.off", "--path", "still.txt", "--samples", "300", "--mesh-out", "mesh.json"}).exit_code, 0);
  std::string onto = "0 0 0\n";
  int seen = 0;
  for (const auto& sample : scene::read_depth_mesh(folder.path() / "mesh.json").samples) {
    if (sample.is_direction || seen++ % 50 != 0) continue;
    for (const double t : {0.5, 0.999, 1.0, 1.0})
      onto += fmt::format("{} {} {}\n", t * sample.at[0], t * sample.at[1], t * sample.at[2]);
  }
  folder.write("samples.txt", onto);
  for (const std::string way : {"jumps", "still", "returns", "walls", "samples"}) {
    for (const std::string samples : {"0", "1", "3", "300"}) {
      for (const bool delaunay : {false, true}) {
        SCOPED_TRACE(fmt::format("{} {} {}", way, samples, delaunay));
        std::vector<std::string> words{"room.off", "--path",     way + ".txt", "--samples",
                                       samples,    "--walk-out", "walk.jsonl"};
        if (delaunay) words.emplace_back("--delaunay");
        EXPECT_EQ(run(words).exit_code, 0);
        EXPECT_EQ(run({"verify", "walk.jsonl"}).exit_code, 0);
      }
    }
  }
}

// Two samples in one place have no triangle: the judge says so, and proves a bound of 0 only.
TEST_F(MotionCommand, TwoEqualSamplesAndAViewpointOnASampleAreJudged) {
  folder.write("equal.json", R"({"format": "clues-depth-mesh/1", "samples": [[1,1,1], [1,1,1], [-1,1,-1], [1,-1,-1]],
    "triangles": [[0,2,1], [0,1,3], [0,3,2], [1,2,3]]})");
  folder.write("four.json", R"({"format": "clues-depth-mesh/1", "samples": [[1,1,1], [-1,-1,1], [-1,1,-1], [1,-1,-1]],
    "triangles": [[0,2,1], [0,1,3], [0,3,2], [1,2,3]]})");
  const auto bounds = [&](const char* name, double bound) {
    folder.write(name,
                 fmt::format(R"({{"format": "clues-motion-bounds/1", "thresholds": {{"kappa": 2000, "sigma": 4e-14,
      "delaunay": true}}, "bounds": [{0}, {0}, {0}, {0}]}})",
                             bound));
  };
  bounds("tenth.json", 0.1);
  bounds("zero.json", 0);
  EXPECT_EQ(run({"check", "equal.json", "--bounds", "tenth.json", "--viewpoint", "0,0,0"}).exit_code, 1);
  EXPECT_EQ(run({"check", "equal.json", "--bounds", "zero.json", "--viewpoint", "0,0,0"}).exit_code, 0);
  EXPECT_EQ(run({"check", "four.json", "--bounds", "tenth.json", "--viewpoint", "0,0,0"}).exit_code, 0);
  EXPECT_EQ(run({"check", "four.json", "--bounds", "tenth.json", "--viewpoint", "1,1,1"}).exit_code, 1);
  EXPECT_EQ(run({"check", "four.json", "--bounds", "zero.json", "--viewpoint", "1,1,1"}).exit_code, 0);
}

// What stands before a subcommand is not for it, and would be passed over.
TEST_F(MotionCommand, ASceneBeforeASubcommandIsRefused) {
  folder.write("four.json", R"({"format": "clues-depth-mesh/1", "samples": [[1,1,1], [-1,-1,1], [-1,1,-1], [1,-1,-1]],
    "triangles": [[0,2,1], [0,1,3], [0,3,2], [1,2,3]]})");
  folder.write("zero.json", R"({"format": "clues-motion-bounds/1", "bounds": [0, 0, 0, 0], "viewpoint": [0, 0, 0],
    "thresholds": {"kappa": 2000, "sigma": 4e-14, "delaunay": true}})");
  const std::vector<std::string> check{"check", "four.json", "--bounds", "zero.json"};
  EXPECT_EQ(run(check).exit_code, 0);
  for (const auto& [before, name] : {std::pair(std::vector<std::string>{"room.off"}, "SCENE"),
                                     {std::vector<std::string>{"--kappa", "20"}, "--kappa"}}) {
    auto words = before;
    words.insert(words.end(), check.begin(), check.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find(std::string("check excludes ") + name), std::string::npos) << ran.err;
  }
}

// A mesh of which nothing says what is across an edge has no Delaunay bounds to prove.
TEST_F(MotionCommand, DelaunayBoundsOfAMeshWithAnEdgeOfThreeTrianglesAreRefused) {
  folder.write("three.json", R"({"format": "clues-depth-mesh/1", "samples": [[1,0,3], [0,1,3], [-1,0,3], [0,-0.2,3]],
    "triangles": [[0,1,2], [0,2,3], [0,2,3]]})");
  folder.write("half.json", R"({"format": "clues-motion-bounds/1", "bounds": [0.5, 0.5, 0.5], "viewpoint": [0, 0, 0],
    "thresholds": {"kappa": 2000, "sigma": 4e-14, "delaunay": true}})");
  const Ran ran = run({"check", "three.json", "--bounds", "half.json"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("the edge 0-2 is in the triangles 0, 1, 2"), std::string::npos) << ran.err;
}

// A line of a few bytes asks for no gigabytes.
TEST_F(MotionCommand, WalksOfSizesOutOfProportionAreRefused) {
  const std::string head = "{\"format\": \"clues-motion-walk/1\"}\n",
                    rest = R"("thresholds": {"kappa": 2000, "sigma": 0, "delaunay": false}, "viewpoint": [0, 0, 0]})";
  for (const auto& [sizes, message] : {std::pair{"[60000000, 0]", "60000000 samples; 0 before, and 0 in this frame"},
                                       std::pair{"[0, 60000000]", "60000000 triangles of 0 samples"}}) {
    folder.write("walk.jsonl", fmt::format("{}{{\"sizes\": {}, {}\n", head, sizes, rest));
    const Ran ran = run({"verify", "walk.jsonl"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("walk.jsonl:2"), std::string::npos) << ran.err;
  }
}

TEST_F(MotionCommand, BadOptionsAreRefused) {
  const std::vector<std::string> usual{"room.off", "--path", "orbit:0,0,0,1", "--frames", "2", "--samples", "10"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), usual.begin(), usual.end());
    return more;
  };
  refuses({}, "SCENE is required");
  refuses({"room.off"}, "--path is required");
  refuses(with({"--bounds", "sketch"}), "sketch-unsound");
  refuses(with({"--bounds", "best"}), "expected sound");
  refuses(with({"--bounds", "sketch-unsound", "--delaunay"}), "no bound for the Delaunay");
  refuses(with({"--kappa", "0.5"}), "base mesh");
  refuses(with({"--sigma", "-1"}), "--sigma -1: sin^2");
  refuses(with({"--sigma", "nan"}), "--sigma nan");
  refuses(with({"--kappa", "nan"}), "--kappa nan");
  refuses({"room.off", "--path", "orbit:0,0,0,1", "--samples", "16777217"}, "--samples 16777217: at most 16777216");
  refuses(with({"--ply", "3:last.ply"}), "the last frame is 2");
  refuses(with({"--ply", "last.ply"}), "FRAME:FILE");
  refuses(with({"--every", "0"}), "--every");
  refuses(with({"--every", "-1"}), "--every: -1 is below 0");
  refuses(with({"--seed", "-1"}), "--seed: -1 is below 0");
  refuses({"room.off", "--path", "orbit:0,0,0,1", "--frames", "-1"}, "--frames: -1 is below 0");
  refuses(with({"--svg", "nowhere/a.svg"}), "nowhere");
  refuses(with({"--svg", "room.off"}), "room.off");
}

}  // namespace
}  // namespace clues::tests
