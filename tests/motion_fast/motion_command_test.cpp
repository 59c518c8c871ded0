// `clues motion` as a user meets it: files out, errors in, and what the checker of walks says to its meshes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/mesh_io.h"
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
  refuses(with({"--sigma", "-1"}), "sigma");
  refuses(with({"--ply", "3:last.ply"}), "the last frame is 2");
  refuses(with({"--ply", "last.ply"}), "FRAME:FILE");
  refuses(with({"--every", "0"}), "--every");
  refuses(with({"--svg", "nowhere/a.svg"}), "nowhere");
  refuses(with({"--svg", "room.off"}), "room.off");
}

}  // namespace
}  // namespace clues::tests
