// clues check --all-cells: holes are found with their sight lines, and only holes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gmpxx.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/bakes/bake_store.h"
#include "tests/app/program.h"
#include "tests/levels/made_level.h"

namespace clues::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

// What a level was shipped with: room 0 without the floor of room 1, which is seen through the glass.
TEST(CheckCells, JudgesWhatALevelWasShippedWith) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  const auto ran = run_clues({"check", "made.bsp", "--all-cells"}, folder.path());
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("the longest free sight lines"));
  EXPECT_THAT(ran.out, HasSubstr("(face "));
  const auto json = nlohmann::json::parse(run_clues({"check", "made.bsp", "--all-cells", "--json"}, folder.path()).out);
  EXPECT_EQ(json["lists"], "shipped");
  EXPECT_GT(json["holes"], 0);
  for (const auto& cell : json["cells"]) {
    for (const auto& hole : cell["holes"]) EXPECT_EQ(hole["p"].size(), 3U);
  }
  // As a page: a row for each cell, with the sight lines of its holes.
  std::filesystem::create_directory(folder.path() / "results");
  folder.write("results/made.json", json.dump());
  ASSERT_EQ(run_clues({"report", "results"}, folder.path()).exit_code, 0);
  const std::string page = read_all(folder.path() / "results/report.html");
  EXPECT_THAT(page, HasSubstr("<td>holes</td><td>cell 0, cluster 0</td>"));
  EXPECT_THAT(page, HasSubstr("<td>sound</td><td>cell 1, cluster 1</td>"));
  EXPECT_THAT(page, HasSubstr("side: free sight line"));
  EXPECT_THAT(page, HasSubstr("2 cells: on average"));
  auto broken = json;
  broken["cells"][0].erase("listed");
  folder.write("results/made.json", broken.dump());
  EXPECT_EQ(run_clues({"report", "results"}, folder.path()).exit_code, 2);
}

TEST(CheckCells, FindsNoHoleInABakeAndEveryOneThatIsMade) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  folder.write("scene.off", screen_scene);
  struct Of {
    const char *scene, *cells;
  };
  for (const auto& [scene_name, cells] :
       {Of{"made.bsp", "leaves"}, Of{"scene.off", "grid:2x2x1:box:-0.3,-0.25,-0.25,0.3,0.25,0"}}) {
    SCOPED_TRACE(scene_name);
    const std::string bake = std::string(scene_name) + ".bake";
    ASSERT_EQ(run_clues({"bake", scene_name, "--cells", cells, "-o", bake}, folder.path()).exit_code, 0);
    const auto sound = run_clues({"check", scene_name, "--all-cells", "--bake", bake}, folder.path());
    EXPECT_EQ(sound.exit_code, 0) << sound.out << sound.err;
    // A store of the same bake, with one triangle fewer in each cell's list, by turns.
    const scene::FinishedBake whole(folder.path() / bake);
    const std::string spoiled = std::string("spoiled-") + bake;
    std::uint64_t taken = 0;
    {
      scene::BakeStore store(folder.path() / spoiled, whole.plan());
      for (std::uint32_t c = 0; c < whole.plan().cells.size(); ++c) {
        auto place = whole.cell(c);
        ASSERT_FALSE(place.list.empty());
        place.list.erase(place.list.begin() + c % static_cast<std::uint32_t>(place.list.size()));
        ++taken;
        store.commit({{scene::PlaceKind::cell, c, place}});
      }
      store.finish();
    }
    const auto ran = run_clues({"check", scene_name, "--all-cells", "--bake", spoiled, "--json"}, folder.path());
    EXPECT_EQ(ran.exit_code, 1) << ran.err;
    const auto json = nlohmann::json::parse(ran.out);
    EXPECT_EQ(json["holes"].get<std::uint64_t>() + json["undecided"].get<std::uint64_t>(), taken);
    EXPECT_GE(json["holes"].get<std::uint64_t>(), taken - 1) << "what is seen at all is seen from much of these cells";
  }
}

// Without the kernel: a hole has a sight line as ever, and where none was found nothing is proved.
TEST(CheckCells, LooksForHolesBySightLinesAlone) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  const auto holes_of = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"check", "made.bsp", "--all-cells", "--json"});
    const auto ran = run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 1) << ran.err;
    std::map<std::string, std::set<std::uint32_t>> holes;
    const auto json = nlohmann::json::parse(ran.out);
    for (const auto& cell : json["cells"]) {
      for (const auto& hole : cell["holes"]) holes[cell["cell"]].insert(hole["triangle"].get<std::uint32_t>());
    }
    return holes;
  };
  const auto found = holes_of({"--sight-lines-only"});
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(found, holes_of({})) << "so little is hard to find in two rooms";

  ASSERT_EQ(run_clues({"bake", "made.bsp", "--cells", "leaves", "-o", "made.bake"}, folder.path()).exit_code, 0);
  std::filesystem::create_directory(folder.path() / "results");
  const auto fine = run_clues(
      {"check", "made.bsp", "--all-cells", "--bake", "made.bake", "--sight-lines-only", "--json=results/made.json"},
      folder.path());
  EXPECT_EQ(fine.exit_code, 3) << fine.err;
  EXPECT_THAT(fine.out, HasSubstr("where they found no hole, nothing is proved"));
  const auto json = nlohmann::json::parse(read_all(folder.path() / "results/made.json"));
  for (const auto& cell : json["cells"]) {
    EXPECT_TRUE(cell["may_be_seen"].is_null());
    EXPECT_LE(cell["witnessed"], cell["listed"]);
    EXPECT_GT(cell["witnessed"], 0);
  }
  ASSERT_EQ(run_clues({"report", "results"}, folder.path()).exit_code, 0);
  const std::string page = read_all(folder.path() / "results/report.html");
  EXPECT_THAT(page, HasSubstr("<td>nothing found</td><td>cell 0, cluster 0</td>"));
  EXPECT_THAT(page, HasSubstr("nothing is proved"));
  EXPECT_THAT(page, Not(HasSubstr("<td>sound</td>")));
}

// A level that says how far it is seen, and one of which --far-plane says so.
TEST(CheckCells, SightLinesLongerThanTheFarPlaneAccuseNobody) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  using Missing = std::set<std::pair<std::string, std::uint32_t>>;
  struct Judged {
    int exit_code;
    nlohmann::json json;
    Missing holes, others;
    std::vector<mpq_class> squares;  // of the lengths of lines to holes
  };
  const auto judged = [&](const char* file, std::vector<std::string> words) {
    words.insert(words.begin(), {"check", file, "--all-cells", "--json"});
    const auto ran = run_clues(words, folder.path());
    Judged out{ran.exit_code, nlohmann::json::parse(ran.out), {}, {}, {}};
    for (const auto& cell : out.json["cells"]) {
      for (const auto& hole : cell["holes"]) {
        out.holes.emplace(cell["cell"], hole["triangle"].get<std::uint32_t>());
        mpq_class square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const mpq_class d = mpq_class(hole["v"][i].get<std::string>()) - mpq_class(hole["p"][i].get<std::string>());
          square += d * d;
        }
        out.squares.push_back(square);
      }
      for (const char* kind : {"beyond", "undecided"}) {
        for (const auto& t : cell[kind]) out.others.emplace(cell["cell"], t.get<std::uint32_t>());
      }
    }
    return out;
  };
  const Judged everything = judged("made.bsp", {});
  ASSERT_FALSE(everything.holes.empty());
  EXPECT_TRUE(everything.json["far_plane"].is_null());
  EXPECT_EQ(everything.json["beyond"], 0);
  mpq_class longest = 0;
  for (const auto& square : everything.squares) longest = std::max(longest, square);
  const double half_way = std::sqrt(longest.get_d()) / 2;
  for (const double far : {0x1p-10, half_way, 0x1p40}) {
    SCOPED_TRACE(far);
    MadeLevel level = two_rooms();
    level.lumps[entities_lump] = fmt::format("{{\n\"classname\" \"worldspawn\"\n\"_farplanedist\" \"{}\"\n}}\n", far);
    folder.write("far.bsp", level.bytes());
    for (const bool alone : {false, true}) {
      std::vector<std::string> words;
      if (alone) words.emplace_back("--sight-lines-only");
      const Judged said = judged("far.bsp", words);
      EXPECT_EQ(said.json["far_plane"], far);
      for (const auto& square : said.squares) EXPECT_TRUE(square <= mpq_class(far) * mpq_class(far));
      Missing all = said.holes;
      all.insert(said.others.begin(), said.others.end());
      EXPECT_EQ(all, everything.holes);
      words.insert(words.end(), {"--far-plane", fmt::format("{}", far)});
      const Judged told = judged("made.bsp", words);
      EXPECT_EQ(told.json["cells"], said.json["cells"]);
      if (far == 0x1p40) {
        EXPECT_EQ(said.holes, everything.holes);
        EXPECT_EQ(said.exit_code, 1);
      }
      if (far == 0x1p-10) {
        EXPECT_TRUE(said.holes.empty());
        EXPECT_EQ(said.json["beyond"], everything.holes.size());
        EXPECT_EQ(said.exit_code, 3);
        EXPECT_THAT(run_clues({"check", "far.bsp", "--all-cells"}, folder.path()).out, HasSubstr("not called holes"));
        // Nor does the page call it sound.
        std::filesystem::create_directory(folder.path() / "results");
        folder.write("results/far.json", said.json.dump());
        ASSERT_EQ(run_clues({"report", "results"}, folder.path()).exit_code, 0);
        const std::string page = read_all(folder.path() / "results/report.html");
        EXPECT_THAT(page, HasSubstr("<td>beyond</td><td>cell 0, cluster 0</td>"));
        EXPECT_THAT(page, HasSubstr("missing and beyond the far plane"));
      }
    }
    EXPECT_EQ(judged("far.bsp", {"--far-plane", "0"}).holes, everything.holes);
  }
  bool some_of_each = false;
  for (int part = 1; part < 16 && !some_of_each; ++part) {
    const Judged told = judged("made.bsp", {"--far-plane", fmt::format("{}", half_way * part / 8)});
    some_of_each = !told.holes.empty() && told.json["beyond"] > 0;
    EXPECT_EQ(told.exit_code, told.holes.empty() ? 3 : 1);
  }
  EXPECT_TRUE(some_of_each);
}

TEST(CheckCells, SaysWhatItNeeds) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  folder.write("made.bsp", two_rooms().bytes());
  const auto refused = [&](std::vector<std::string> words, const char* why) {
    words.insert(words.begin(), "check");
    const auto ran = run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr(why));
  };
  refused({"scene.off", "--all-cells"}, "no lists were shipped");
  refused({"scene.off"}, "give --cell and --pvs, or --all-cells");
  refused({"scene.off", "--bake", "x"}, "needs --all-cells");
  refused({"scene.off", "--cell", "box:0,0,0,1,1,1", "--pvs", "x", "--sight-lines-only"}, "needs --all-cells");
  refused({"scene.off", "--cell", "box:0,0,0,1,1,1", "--pvs", "x", "--far-plane", "-9"},
          "give a distance, or 0 for none");
  for (const char* distance : {"nan", "-1", "inf"})
    refused({"made.bsp", "--all-cells", "--far-plane", distance}, "give a distance, or 0 for none");
  refused({"scene.off", "--all-cells", "--cell", "box:0,0,0,1,1,1"}, "leave out --cell and --pvs");
  refused({"scene.off", "--all-cells", "--bake", "missing.bake"}, "missing.bake: no such file");
  ASSERT_EQ(run_clues({"bake", "made.bsp", "--cells", "leaves", "-o", "l.bake"}, folder.path()).exit_code, 0);
  refused({"scene.off", "--all-cells", "--bake", "l.bake"}, "is of another scene");
}

}  // namespace
}  // namespace clues::tests
