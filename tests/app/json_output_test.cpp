// --json [FILE]: printed, or written as a whole; never over what the command reads, and no other word is taken for FILE.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;
using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// A scene, what the commands need besides, and a suite of one topic.
class JsonOutput : public testing::Test {
 protected:
  JsonOutput() {
    folder.write("scene.off", screen_scene);
    folder.write("pvs.txt", "0\n1\n2\n4\n");
    folder.write("points.txt", "0 0 3\n");
    std::filesystem::create_directory(folder.path() / "suite");
    std::filesystem::copy_file(std::string(CLUES_SOURCE_DIR) + "/vectors/needles.json",
                               folder.file("suite/needles.json"));
    EXPECT_EQ(run({"lint", "suite", "--write", "--case", "-"}).exit_code,
              2);  // no case is proved, the index is written
  }
  Ran run(const Words& words) const { return run_clues(words, folder.path()); }

  const TestFolder folder;
  const std::vector<std::pair<Words, std::string>> commands{
      {{"map", "scene.off", "--cell", screen_cell}, "clues-result/1"},
      {{"precision", "scene.off", "--cell", screen_cell, "--max-depth", "0"}, "clues-precision/1"},
      {{"check", "scene.off", "--cell", screen_cell, "--pvs", "pvs.txt"}, "clues-judgement/1"},
      {{"query", "scene.off", "--cell", screen_cell, "--points", "points.txt"}, "clues-query/1"},
      {{"lint", "suite", "--case", "needle-*"}, "clues-lint/1"},
      {{"conform", "--impl", "'" CLUES_PROGRAM "' iut --kernel fast", "--suite", "suite"}, "clues-conformance/1"}};
};

TEST_F(JsonOutput, IsPrintedOrWritten) {
  for (const auto& [command, format] : commands) {
    const Ran text = run(command);
    const Ran printed = run(command + Words{"--json"});
    ASSERT_EQ(printed.exit_code, text.exit_code) << printed.err;
    EXPECT_EQ(json::parse(printed.out)["format"], format);
    const Ran dash = run(command + Words{"--json", "-"});
    EXPECT_EQ(dash.out, printed.out);
    const auto before = folder.names();
    for (const Words& named : {Words{"--json", "out.json"}, {"--json=out.json"}, {"--json=out.txt"}}) {
      const Ran written = run(command + named);
      EXPECT_EQ(written.exit_code, text.exit_code) << written.err;
      EXPECT_EQ(written.out, text.out);
      const std::string file = folder.file(named.back().substr(named.back().find('=') + 1));
      EXPECT_EQ(read_all(file), printed.out) << command[0];
      std::filesystem::remove(file);
    }
    EXPECT_EQ(folder.names(), before);
  }
}

TEST_F(JsonOutput, BeforeTheOtherWords) {
  const Ran after = run({"map", "scene.off", "--cell", screen_cell, "--json"});
  for (const Words& words : {Words{"map", "--json", "scene.off", "--cell", screen_cell},
                             {"map", "--json", "--cell", screen_cell, "scene.off"},
                             {"map", "--json", "-", "scene.off", "--cell", screen_cell},
                             {"map", "--cell", screen_cell, "--json", "--", "scene.off"}}) {
    EXPECT_EQ(run(words).out, after.out);
  }
  EXPECT_EQ(run({"map", "--json", "out.json", "scene.off", "--cell", screen_cell}).exit_code, 0);
  EXPECT_EQ(read_all(folder.file("out.json")), after.out);
  EXPECT_EQ(read_all(folder.file("scene.off")), screen_scene);
  EXPECT_EQ(run({"lint", "--json", "suite", "--case", "needle-*"}).out,
            run({"lint", "suite", "--case", "needle-*", "--json"}).out);
}

TEST_F(JsonOutput, OfConformLeavesTheTableOnStandardError) {
  const Words command = commands.back().first;
  const Ran table = run(command);
  EXPECT_EQ(run(command + Words{"--json"}).err, table.out);
  // There is no other word that it could be.
  EXPECT_EQ(run(command + Words{"--json", "report.out"}).out, table.out);
  EXPECT_THAT(read_all(folder.file("report.out")), HasSubstr("clues-conformance/1"));
}

TEST_F(JsonOutput, OfMapBesidesItsFile) {
  const Words command{"map", "scene.off", "--cell", screen_cell, "-o", "out.pvs"};
  const Ran both = run(command + Words{"--json"});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(json::parse(both.out)["visible"], json({0, 1, 2, 4}));
  EXPECT_THAT(both.err, HasSubstr("wholly"));
  EXPECT_THAT(read_all(folder.file("out.pvs")), HasSubstr("0\n1\n2\n4\n"));
  const Ran cells = run({"map", "scene.off", "--cells", "grid:2x1x1:box:-1,-1,-1,1,1,0", "--json=cells.json"});
  EXPECT_EQ(cells.exit_code, 0) << cells.err;
  EXPECT_EQ(json::parse(read_all(folder.file("cells.json"))).size(), 2U);
}

TEST_F(JsonOutput, NeverGoesOverAnInput) {
  folder.write("adapter.py", "print()\n");
  std::filesystem::create_hard_link(folder.file("pvs.txt"), folder.file("link.json"));
  std::filesystem::create_directory(folder.path() / "answers");
  folder.write("answers/needle.clues.json", "an answer");
  const auto before = folder.names();
  const Words check{"check", "scene.off", "--cell", screen_cell, "--pvs", "pvs.txt"};
  for (const auto& [words, says] : std::vector<std::pair<Words, std::string>>{
           {check + Words{"--json=scene.off"}, "scene.off: is read by this command too"},
           {check + Words{"--json=pvs.txt"}, "pvs.txt: is read by this command too"},
           {check + Words{"--json", "link.json"}, "link.json: is read by this command too"},
           {check + Words{"--json", "nowhere/out.json"}, "nowhere: no such folder"},
           {check + Words{"--json="}, "--json=: names no file"},
           {check + Words{"--json", "out.txt"}, "--json=FILE"},
           {check + Words{"--json", "a.json", "--json", "b.json"}, "--json"},
           {{"map", "scene.off", "--cell", screen_cell, "-o", "o.json", "--json", "o.json"}, "two outputs"},
           {{"map", "scene.off", "--cells", "grid:1x1x1:box:0,0,0,1,1,1", "-o", "cells", "--json"}, "leave out one"},
           {{"query", "scene.off", "--cell", screen_cell, "--points", "points.txt", "--json=points.txt"}, "is read by"},
           {{"precision", "scene.off", "--cell", screen_cell, "--json=scene.off"}, "is read by"},
           {{"lint", "suite", "--json", "suite/needles.json"}, "lies in suite"},
           {{"lint", "suite", "--json", "suite/report.json"}, "lies in suite"},
           {{"conform", "--impl", "python3 ./adapter.py", "--suite", "suite", "--json", "adapter.py"}, "is read by"},
           {{"conform", "--impl", "true", "--suite", "suite", "--json", "suite/index.json"}, "lies in suite"},
           {{"conform", "--results", "answers", "--suite", "suite", "--json", "answers/needle.clues.json"},
            "lies in answers"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, 2) << says;
    EXPECT_THAT(ran.err, testing::AllOf(StartsWith("clues: error: "), HasSubstr(says)));
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(folder.names(), before) << says;
  }
  EXPECT_EQ(read_all(folder.file("scene.off")), screen_scene);
  EXPECT_EQ(read_all(folder.file("adapter.py")), "print()\n");
  EXPECT_EQ(read_all(folder.file("answers/needle.clues.json")), "an answer");
}

}  // namespace
}  // namespace clues::tests
