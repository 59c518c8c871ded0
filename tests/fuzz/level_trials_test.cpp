// Trials of bakes, streams and levels (fuzz/trials): what is ours holds; what is planted is found, shrunk, saved, and found again.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "fuzz/campaign/campaign.h"
#include "fuzz/generators/city.h"
#include "fuzz/levels/made_levels.h"
#include "fuzz/shrinking/finding_folder.h"
#include "fuzz/trials/bakes_trial.h"
#include "fuzz/trials/levels_trial.h"
#include "fuzz/trials/streams_trial.h"
#include "scene/files/temporary_folder.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

using fastpath::bakes::CellList;
using fastpath::bakes::CellLister;
using testing::HasSubstr;
using testing::IsEmpty;
using Ids = std::vector<std::uint32_t>;

CampaignOptions options_for(std::uint64_t cases, const std::filesystem::path& out) {
  CampaignOptions options;
  options.cases = cases;
  options.seed = 20261124;
  options.jobs = 2;
  options.out = out;
  options.shrink.steps = 12;
  return options;
}

// The first finding of a campaign with what is planted, shrunk; it is one of the check, it replays, and what is ours has no such flaw.
SavedFinding found_by(const Subject& wrong, CampaignOptions options, const char* check) {
  options.oracles = {check};
  const auto summary = run_campaign(options, wrong);
  EXPECT_EQ(summary.exit_code(), 1) << to_text(summary, options.out);
  if (summary.findings.empty()) throw std::runtime_error("nothing was found");
  const auto saved = load_finding(options.out / summary.findings.front().folder.value());
  EXPECT_EQ(saved.finding.oracle, check);
  EXPECT_EQ(flaw_of(saved.finding, wrong), "");
  EXPECT_NE(flaw_of(saved.finding, *make_subject(wrong.name())), "") << "ours has no such flaw";
  return saved;
}

void expect_to_hold(const char* subject, CampaignOptions options) {
  const auto summary = run_campaign(options, *make_subject(subject));
  EXPECT_EQ(summary.exit_code(), 0) << to_text(summary, options.out);
}

// Whatever a lister lists, spoilt.
class SpoiltLister : public CellLister {
 public:
  using Spoil = void (*)(CellList& list, std::span<const std::uint32_t> guess);
  SpoiltLister(std::unique_ptr<CellLister> of, Spoil spoil) : of_(std::move(of)), spoil_(spoil) {}
  CellList list(const std::vector<scene::Point>& cell, std::span<const std::uint32_t> guess) const override {
    CellList out = of_->list(cell, guess);
    spoil_(out, guess);
    return out;
  }

 private:
  std::unique_ptr<CellLister> of_;
  Spoil spoil_;
};

fastpath::bakes::ListerMaker spoilt(const fastpath::bakes::ListerMaker& maker, SpoiltLister::Spoil spoil) {
  return [maker, spoil](scene::FlaggedMesh scene) {
    return std::make_unique<SpoiltLister>(maker(std::move(scene)), spoil);
  };
}

std::unique_ptr<Subject> bakes_with(SpoiltLister::Spoil spoil) {
  auto makers = our_bake_makers();
  makers.fast = spoilt(makers.fast, spoil);
  makers.exact = makers.fast;
  return subject_of("bakes", make_bakes_trial(makers));
}

TEST(BakesTrial, OursHold) {
  const scene::TemporaryFolder folder;
  auto options = options_for(8, folder.path());
  options.generators = {"tetrahedra", "interiors", "forests", "axis_boxes"};
  expect_to_hold("bakes", options);
}

TEST(BakesTrial, AListThatLacksItsLastTriangleIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = bakes_with([](CellList& list, auto) {
    if (list.visible.size() > 1) list.visible.pop_back();
  });
  auto options = options_for(4, folder.path());
  options.generators = {"tetrahedra"};
  options.errors = 1;
  const auto saved = found_by(*wrong, options, "bake-sound");
  EXPECT_LT(saved.finding.where.mesh.triangles.size(), saved.original.where.mesh.triangles.size());
}

// A group's box that ends before its cells do.
TEST(BakesTrial, AGroupThatSeesLessThanItsCellsIsFound) {
  auto makers = our_bake_makers();
  makers.add_groups = [ours = makers.add_groups](scene::BakePlan& plan, std::size_t most) {
    ours(plan, most);
    for (auto& node : plan.nodes) {
      if (!node.points.empty()) node.points = {node.points.front()};
    }
  };
  const auto wrong = subject_of("bakes", make_bakes_trial(makers));
  for (const char* check : {"list-as-alone", "child-in-parent"}) {
    const scene::TemporaryFolder folder;
    auto options = options_for(8, folder.path());
    options.generators = {"tetrahedra", "axis_boxes"};
    options.errors = 1;
    found_by(*wrong, options, check);
  }
}

// What the neighbour lists is listed as well: longer than alone, and not for what the group's box leaves out.
TEST(BakesTrial, AListWithItsGuessInItIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = bakes_with([](CellList& list, auto guess) {
    list.visible.insert(list.visible.end(), guess.begin(), guess.end());
    std::sort(list.visible.begin(), list.visible.end());
    list.visible.erase(std::unique(list.visible.begin(), list.visible.end()), list.visible.end());
  });
  auto options = options_for(8, folder.path());
  options.generators = {"interiors", "axis_boxes"};
  options.errors = 1;
  found_by(*wrong, options, "list-as-alone");
}

// Who was there before changes what is listed.
TEST(BakesTrial, AListThatDependsOnWhatIsThereAlreadyIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = bakes_with([](CellList& list, auto) {
    static std::atomic<int> calls{0};
    list.passes += ++calls;
  });
  auto options = options_for(1, folder.path());
  options.shrink.steps = 1;
  options.oracles = {"bake-same-bytes"};
  const auto summary = run_campaign(options, *wrong);
  ASSERT_EQ(summary.exit_code(), 1) << to_text(summary, folder.path());
  EXPECT_EQ(summary.findings.front().finding.oracle, "bake-same-bytes");
}

TEST(StreamsTrial, OursHold) {
  const scene::TemporaryFolder folder;
  auto options = options_for(4, folder.path());
  options.generators = {"tetrahedra", "axis_boxes"};
  expect_to_hold("streams", options);
}

std::unique_ptr<Subject> streams_with(const std::function<void(StreamMakers&)>& spoil) {
  auto makers = our_stream_makers();
  spoil(makers);
  return subject_of("streams", make_streams_trial(makers));
}

CampaignOptions options_for_streams(const std::filesystem::path& out) {
  auto options = options_for(4, out);
  options.generators = {"tetrahedra", "axis_boxes"};
  options.shrink.steps = 3;
  options.errors = 1;
  return options;
}

TEST(StreamsTrial, ATriangleThatIsNotSentIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = streams_with([](StreamMakers& makers) {
    makers.walk = [ours = makers.walk](const auto& store, const auto& route) {
      auto said = ours(store, route);
      for (auto& step : said.messages) {
        for (auto& message : step) {
          if (!message.plus.empty()) message.plus.pop_back();
        }
      }
      return said;
    };
  });
  const auto saved = found_by(*wrong, options_for_streams(folder.path()), "stream-judged");
  EXPECT_THAT(saved.finding.explanation, HasSubstr("message "));
}

TEST(StreamsTrial, AMirrorThatIsBehindIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = streams_with([](StreamMakers& makers) {
    makers.walk = [ours = makers.walk](const auto& store, const auto& route) {
      auto said = ours(store, route);
      std::rotate(said.mirrors.begin(), said.mirrors.end() - 1, said.mirrors.end());
      return said;
    };
  });
  found_by(*wrong, options_for_streams(folder.path()), "mirrors-equal");
}

TEST(StreamsTrial, AServerThatSaysItAgainIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = streams_with([](StreamMakers& makers) {
    makers.resume = [ours = makers.resume](const auto& store, const auto& route, std::uint64_t have) {
      return ours(store, route, have > 0 ? have - 1 : 0);
    };
  });
  found_by(*wrong, options_for_streams(folder.path()), "resumed-equal");
}

// Who is asked for the rest of a route begins at its end.
TEST(StreamsTrial, AServerThatForgetsTheRestIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = streams_with([](StreamMakers& makers) {
    makers.answer = [ours = makers.answer](const auto& store, const auto& header, const std::string& asked) {
      std::string said = ours(store, header, asked);
      constexpr std::size_t most = 400;
      return said.substr(0, std::max(most, said.size() - std::min(said.size(), most)));
    };
  });
  found_by(*wrong, options_for_streams(folder.path()), "connection-cut");
}

// A city of 240 triangles, in which every fourth that counts does not block.
GivenLevel small_level() {
  GivenLevel level{"small", {make_city(240, 3), {}, {}, {}}, {}};
  for (std::uint32_t t = 0; t < level.scene.mesh.triangles.size(); ++t)
    level.scene.blocks.push_back(t % 4 == 1 ? 0 : 1);
  return level;
}

CampaignOptions options_for_levels(const std::filesystem::path& out, std::uint64_t cases) {
  auto options = options_for(cases, out);
  options.generators = {"given_boxes"};
  options.given.levels.push_back(small_level());
  options.given.paths = {"small"};
  options.errors = 1;
  options.shrink.steps = 60;
  return options;
}

TEST(LevelsTrial, OursHold) {
  const scene::TemporaryFolder folder;
  expect_to_hold("levels", options_for_levels(folder.path(), 4));
}

// What is listed but for the triangle whose number is in the middle: it is found among hundreds, and shrunk to a few.
TEST(LevelsTrial, AListThatLacksOneTriangleIsFoundAndShrunk) {
  const scene::TemporaryFolder folder;
  const auto wrong = subject_of(
      "levels", make_levels_trial(lines_of_a_level,
                                  [](const fastpath::SeeThroughScene& scene, const std::vector<scene::Point>& cell) {
                                    auto list = fastpath::visible_through(scene, cell, {}).counting(scene.scene());
                                    if (!list.empty())
                                      list.erase(list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2));
                                    return list;
                                  }));
  const auto saved = found_by(*wrong, options_for_levels(folder.path(), 2), "level-sight-lines");
  EXPECT_GT(saved.original.where.mesh.triangles.size(), 200U);
  EXPECT_LT(saved.finding.where.mesh.triangles.size(), 20U);
  EXPECT_EQ(saved.finding.where.blocks.size(), saved.finding.where.mesh.triangles.size());
  EXPECT_EQ(saved.finding.verdict, "hidden/visible");
  ASSERT_TRUE(saved.finding.triangle);
  const std::string of_the_shrunk_scene = fmt::format("triangle {} of {} is not listed", *saved.finding.triangle,
                                                      saved.finding.where.mesh.triangles.size());
  EXPECT_NE(saved.finding.explanation.find(of_the_shrunk_scene), std::string::npos) << saved.finding.explanation;
}

// Panes are taken for walls: what is behind them is missing.
TEST(LevelsTrial, PanesThatBlockAreFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = subject_of(
      "levels", make_levels_trial(lines_of_a_level,
                                  [](const fastpath::SeeThroughScene& scene, const std::vector<scene::Point>& cell) {
                                    scene::FlaggedMesh walls = scene.scene();
                                    walls.blocks.clear();
                                    const fastpath::SeeThroughScene other(walls);
                                    return fastpath::visible_through(other, cell, {}).counting(scene.scene());
                                  }));
  const auto saved = found_by(*wrong, options_for_levels(folder.path(), 12), "level-sight-lines");
  EXPECT_LT(saved.finding.where.mesh.triangles.size(), 40U);
}

TEST(LevelsTrial, TakesLevelsAndNeedsThemForSomeGenerators) {
  const scene::TemporaryFolder folder;
  auto options = options_for_levels(folder.path(), 1);
  options.given = {};
  options.generators = {"given_leaves"};
  EXPECT_THROW(run_campaign(options, *make_subject("levels")), scene::Error);
  options.generators = {"given_boxes"};
  EXPECT_THROW(run_campaign(options, *make_subject("levels")), scene::Error);
  options.given.levels.push_back(small_level());
  options.given.paths = {"small"};
  const auto summary = run_campaign(options, *make_subject("levels"));
  EXPECT_EQ(summary.counters.at("cases of given_boxes"), 1U);
  EXPECT_EQ(summary.exit_code(), 0) << to_text(summary, folder.path());
}

TEST(LevelsTrial, DecidesAsManyLinesAsAreAskedFor) {
  const scene::TemporaryFolder folder;
  const auto subject = make_subject("levels/700");
  EXPECT_EQ(subject->name(), "levels/700");
  const auto summary = run_campaign(options_for_levels(folder.path(), 1), *subject);
  std::uint64_t lines = 0;
  for (const char* aim : {"through vertices", "beside edges", "beside edges of what is listed", "to inner points"})
    lines += summary.counters.at(std::string("sight lines ") + aim);
  EXPECT_EQ(lines, 700U);
  EXPECT_EQ(summary.counters.at("sight lines decided"), lines);
  for (const char* none : {"levels/", "levels/0", "levels/07", "levels/x", "levels/4096", "levels/1000000001"})
    EXPECT_TRUE(is_program(none)) << none;
}

// Squares of their extent overflow, and floats do not hold them: cells are finite all the same, and the store can be read again.
TEST(LevelsTrial, TakesHugeScenes) {
  const scene::TemporaryFolder folder;
  auto options = options_for_levels(folder.path(), 2);
  GivenLevel huge{"huge", {{}, {}, {}, {}}, {}};
  huge.scene.mesh.points = {{0, 0, 0}, {1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}};
  huge.scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  huge.scene.mesh.face_of = {0, 1};
  options.given.levels = {huge};
  options.given.paths = {"huge"};
  run_campaign(options, *make_subject("levels"));
  EXPECT_EQ(run_campaign(options, *make_subject("levels")).counters.at("cases of given_boxes"), 2U);
}

// Each is a function of seed and number, with as many flags as triangles, and a cell with points.
TEST(LevelsTrial, MadeLevelsAreWhole) {
  for (const auto make : {rooms_of_a_level, streets_of_a_level}) {
    for (std::uint64_t index = 0; index < 4; ++index) {
      const auto made = make(7, index), again = make(7, index);
      const std::size_t triangles = made.scene.mesh.triangles.size();
      EXPECT_GT(triangles, 300U);
      EXPECT_LT(triangles, 8000U);
      EXPECT_TRUE(made.scene.blocks.empty() || made.scene.blocks.size() == triangles);
      EXPECT_EQ(made.scene.blocks, again.scene.blocks);
      EXPECT_EQ(made.scene.mesh.points, again.scene.mesh.points);
      EXPECT_EQ(made.cell, again.cell);
      EXPECT_FALSE(made.cell.empty());
    }
  }
}

// A finding keeps its flags, in the store and in its folder.
TEST(LevelsTrial, FlagsAreKept) {
  Finding f;
  f.oracle = "level-sight-lines";
  f.verdict = "hidden/meets-cell";
  f.triangle = 1;
  f.where.generator = "rooms";
  f.where.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  f.where.mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  f.where.cell = {{0, 0, 0}};
  f.where.blocks = {1, 0};
  f.where.counts = {0, 1};
  const auto again = finding_from_json_text(to_json_text(f));
  EXPECT_EQ(again.where.blocks, f.where.blocks);
  EXPECT_EQ(again.where.counts, f.where.counts);
  const scene::TemporaryFolder folder;
  save_finding({f, f, "levels", {}, 0}, folder.path() / "found");
  const auto saved = load_finding(folder.path() / "found");
  EXPECT_EQ(saved.finding.where.blocks, f.where.blocks);
  EXPECT_EQ(saved.original.where.counts, f.where.counts);
  f.where.blocks = {1};
  EXPECT_THROW(finding_from_json_text(to_json_text(f)), scene::Error);
}

}  // namespace
}  // namespace clues::fuzz
