// Dials of cases: a pure function of the case's name, kept with a finding, honoured when it is repeated and made smaller, and counted.
#include "fuzz/findings/dials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/oracles/oracle.h"
#include "fuzz/shrinking/finding_folder.h"
#include "scene/files/temporary_folder.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

Case made(const std::string& generator, std::uint64_t index) {
  const GivenScenes none;
  return generators_named({generator}, none).front().make(20261122, index);
}

TEST(Dials, DependOnTheNameOfTheCaseAndLeaveHalfOfThemAlone) {
  std::map<std::string, int> turned;
  int untouched = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case plain = made("axis_boxes", i), scene = with_dials(plain, true);
    EXPECT_EQ(scene.dials, with_dials(plain, true).dials);
    EXPECT_LE(scene.dials.size(), 3U);
    untouched += scene.dials.empty();
    for (const auto& [name, value] : scene.dials) ++turned[name];
    if (!scene.dials.contains("scale") && !scene.dials.contains("offset")) {
      EXPECT_EQ(scene.mesh.points, plain.mesh.points);
      EXPECT_EQ(scene.cell, plain.cell);
    }
  }
  EXPECT_GT(untouched, 150);
  EXPECT_LT(untouched, 250);
  for (const NamedDial& dial : all_dials()) EXPECT_GT(turned[dial.name], 10) << dial.name;
}

TEST(Dials, OfEnginesAreLeftAloneForPrograms) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    for (const auto& [name, value] : with_dials(made("axis_boxes", i), false).dials)
      EXPECT_TRUE(name == "scale" || name == "offset") << name;
  }
}

// Every point is where it was, but for one power of two and one offset: nothing rounds.
TEST(Dials, ScaleAndOffsetAreExact) {
  int changed = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case plain = made("cell_contacts", i), scene = with_dials(plain, false);
    if (scene.dials.empty()) continue;
    ++changed;
    const auto scale = scene.dials.find("scale");
    const double factor = scale == scene.dials.end() ? 1 : std::ldexp(1, static_cast<int>(scale->second));
    const auto difference = [](const scene::Point& a, const scene::Point& b, std::size_t k) { return a[k] - b[k]; };
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t p = 1; p < plain.mesh.points.size(); ++p) {
        EXPECT_EQ(difference(scene.mesh.points[p], scene.mesh.points[0], k),
                  factor * difference(plain.mesh.points[p], plain.mesh.points[0], k));
      }
    }
  }
  EXPECT_GT(changed, 20);
}

TEST(Dials, ReachTheEngines) {
  const CaseDials dials{{"generation_limit", 1}, {"csv_limit", 5},     {"longest_walk", 2},
                        {"first_guess", 2},      {"sight_rays", 7},    {"batch", 1},
                        {"threads", 3},          {"traversal", 1},     {"depth", 4},
                        {"flat_trees", 1},       {"unsure_doubles", 1}};
  const exact::Dials map = map_dials(dials);
  EXPECT_EQ(map.generation_limit, 1);
  EXPECT_EQ(map.csv_limit, 5U);
  EXPECT_EQ(map.longest_walk, 2);
  EXPECT_EQ(map.first_guess, exact::Dials::FirstGuess::everything);
  EXPECT_EQ(map.sight_rays, 7);
  EXPECT_EQ(map.batch, 1U);
  EXPECT_EQ(map.threads, 3);
  EXPECT_TRUE(by_traversal(dials));
  EXPECT_EQ(refinement_depth(dials, 2), 4);
  EXPECT_EQ(refinement_depth({}, 2), 2);
  const exact::ProcessDials process = process_dials(dials);
  EXPECT_TRUE(process.flat_trees && process.unsure_doubles);
  EXPECT_FALSE(process.unsure_intervals);
  EXPECT_TRUE(is_limited(dials));
  EXPECT_FALSE(is_limited({{"batch", 1}, {"scale", 5}}));
  EXPECT_EQ(map_dials({}).csv_limit, exact::Dials{}.csv_limit);
}

// A subject that is wrong where a dial is turned, and only there.
class WrongWhereADialIsTurned : public Subject {
 public:
  Answer answer(const Case& scene) const override {
    Answer out;  // all triangles, or none
    for (std::uint32_t t = 0; t < scene.mesh.triangles.size() && !scene.dials.contains("batch"); ++t)
      out.pvs.push_back(t);
    return out;
  }
  std::string name() const override { return "wrong-where-a-dial-is-turned"; }
  bool takes_dials() const override { return true; }
};

CampaignOptions options_for(const std::filesystem::path& out, std::uint64_t cases) {
  CampaignOptions options;
  options.seed = 20261122;
  options.cases = cases;
  options.generators = {"points_at_cell"};
  options.oracles = {"sight-lines"};
  options.out = out;
  options.errors = 1;
  options.shrink.steps = 40;
  options.shrink.time = std::chrono::seconds(600);  // the steps end it
  return options;
}

TEST(Dials, AreKeptWithTheFindingAndUsedAgain) {
  const scene::TemporaryFolder folder;
  CampaignOptions options = options_for(folder.path() / "with", 40);
  options.dials = true;
  const WrongWhereADialIsTurned subject;
  const CampaignSummary summary = run_campaign(options, subject);
  ASSERT_EQ(summary.findings.size(), 1U);
  EXPECT_TRUE(summary.contradictions.empty());
  EXPECT_GT(summary.counters.at("dial batch"), 0U);
  const SavedFinding saved = load_finding(options.out / summary.findings[0].folder.value());
  // Of the dials of the engine one is left: the one that it takes.
  std::set<std::string> of_engine;
  for (const NamedDial& dial : all_dials()) {
    if (dial.of == NamedDial::Of::engine && saved.finding.where.dials.contains(dial.name)) of_engine.insert(dial.name);
  }
  EXPECT_EQ(of_engine, std::set<std::string>{"batch"});
  EXPECT_EQ(flaw_of(saved.finding, subject), "");
  Finding without = saved.finding;
  without.where.dials.clear();
  EXPECT_NE(flaw_of(without, subject), "");
  // The original is made again by its name.
  const Case again = with_dials(made("points_at_cell", saved.original.where.index), true);
  EXPECT_EQ(again.dials, saved.original.where.dials);
  EXPECT_EQ(again.mesh.points, saved.original.where.mesh.points);
  EXPECT_EQ(finding_from_json_text(to_json_text(saved.finding)).where.dials, saved.finding.where.dials);

  const CampaignOptions usual = options_for(folder.path() / "without", 6);
  EXPECT_TRUE(run_campaign(usual, subject).findings.empty());
  // A campaign with dials is another campaign.
  CampaignOptions other = usual;
  other.dials = true;
  EXPECT_THROW(run_campaign(other, subject), scene::Error);
}

// With limits the lists may differ, but not in what either knows (D17b).
TEST(Dials, WhatIsLimitedIsComparedAsFarAsItIsKnown) {
  Case scene = made("axis_boxes", 1);
  const auto fast = make_subject("fast");
  EXPECT_TRUE(fast->takes_dials());
  const auto agreement = oracles_named({"agreement"});
  EXPECT_EQ(judge_case(scene, *fast, agreement).counters.count("answers compared with the reference"), 1U);
  scene.dials["batch"] = 1;
  const Outcome turned = judge_case(scene, *fast, agreement);
  EXPECT_EQ(turned.counters.count("answers compared with the reference"), 1U);
  EXPECT_EQ(turned.counters.at("dial batch"), 1U);
  EXPECT_TRUE(turned.findings.empty());
  scene.dials["csv_limit"] = 0;
  const Outcome limited = judge_case(scene, *fast, agreement);
  EXPECT_EQ(limited.counters.at("answers compared with the reference"), 1U);
  EXPECT_TRUE(limited.findings.empty());
}

}  // namespace
}  // namespace clues::fuzz
