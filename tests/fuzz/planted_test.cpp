// Each planted defect that hides something visible is found and shrunk: wrong implementations, those of the conformance runner's tests. Some by a campaign of a few
// cases; all of them, by all generators, within a minute of one core, in the long tests. Wrong references are in tests/planted.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "../conform/planted/answers.h"
#include "found_and_shrunk.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/generators/random_scenes.h"
#include "fuzz/oracles/oracle.h"
#include "fuzz/shrinking/finding_folder.h"
#include "planted_subjects.h"
#include "scene/files/temporary_folder.h"

namespace clues::fuzz {
namespace {

TEST(PlantedSubject, EverythingHiddenIsFound) { is_found_soon(EverythingHidden(), 2); }
TEST(PlantedSubject, OneHiddenTriangleIsFound) { is_found_soon(HidesOneTriangle(), 12); }
TEST(PlantedSubject, FromTheCentreIsFound) { is_found_soon(FromTheCentre(), 12); }

// The verdicts of the oracle `agreement` in the first cases of a subject that promises Omega.
std::set<std::string> disagreements(const Subject& subject) {
  std::set<std::string> verdicts;
  const GivenScenes none;
  const auto generators = generators_named({"loose_triangles", "axis_boxes"}, none);
  for (const auto& g : generators) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      const Outcome outcome = judge_case(g.make(7, i), subject, oracles_named({"agreement"}));
      EXPECT_TRUE(outcome.contradictions.empty());
      EXPECT_EQ(outcome.counters.at("answers compared with the reference"), 1U);
      for (const Finding& f : outcome.findings) verdicts.insert(f.verdict);
    }
  }
  return verdicts;
}

TEST(Agreement, FindsATriangleTooFewAndTrianglesTooMany) {
  EXPECT_EQ(disagreements(ClaimsOmega(false)), std::set<std::string>{"hidden/first-order-visible"});
  EXPECT_EQ(disagreements(ClaimsOmega(true)), std::set<std::string>{"visible/first-order-hidden"});
  EXPECT_EQ(disagreements(*make_subject("fast")), std::set<std::string>{});
}

// What the oracle `metamorphic` says of a scene by one of its relations, in the first cases that have it.
std::set<std::string> changed_by(const char* relation, const Subject& subject, const Case& scene) {
  std::set<std::string> verdicts;
  int cases = 0;
  for (std::uint64_t i = 0; i < 200 && cases < 4; ++i) {
    Case numbered = scene;
    numbered.index = i;
    const Outcome outcome = judge_case(numbered, subject, oracles_named({"metamorphic"}));
    EXPECT_TRUE(outcome.contradictions.empty());
    if (!outcome.counters.contains(std::string("relations: ") + relation)) continue;
    ++cases;
    for (const Finding& f : outcome.findings) verdicts.insert(f.verdict);
  }
  EXPECT_EQ(cases, 4) << relation;
  return verdicts;
}

TEST(Metamorphic, AVertexMoreOnAnEdgeChangesNoList) {
  const GivenScenes none;
  const Case scene = generators_named({"irises"}, none).front().make(7, 0);
  const LosesOneOfFew subject(scene.mesh.triangles.size());
  EXPECT_EQ(changed_by("vertices more", subject, scene), std::set<std::string>{"answer/other-answer"});
  for (const char* kernel : {"reference", "fast"})
    EXPECT_EQ(changed_by("vertices more", *make_subject(kernel), scene), std::set<std::string>{}) << kernel;
}

// The verdicts of the oracle `see-through` in the first cases of two generators, and how many had flags.
std::set<std::string> seen_through(const Subject& subject, std::uint64_t& scenes) {
  std::set<std::string> verdicts;
  const GivenScenes none;
  for (const auto& g : generators_named({"loose_triangles", "axis_boxes"}, none)) {
    for (std::uint64_t i = 0; i < 8; ++i) {
      const Outcome outcome = judge_case(g.make(7, i), subject, oracles_named({"see-through"}));
      EXPECT_TRUE(outcome.contradictions.empty());
      if (outcome.counters.contains("scenes with flags")) ++scenes;
      for (const Finding& f : outcome.findings) verdicts.insert(f.verdict);
    }
  }
  return verdicts;
}

TEST(SeeThroughOracle, FindsWhatIsHiddenPastWhatDoesNotBlock) {
  std::uint64_t scenes = 0;
  EXPECT_EQ(seen_through(HidesOneTriangle(), scenes), std::set<std::string>{"hidden/seen-through"});
  EXPECT_GE(scenes, 3U);
  EXPECT_EQ(seen_through(*make_subject("fast"), scenes), std::set<std::string>{});
}

TEST(PlantedSubject, NothingIsFoundInASoundAnswer) {
  const scene::TemporaryFolder folder;
  CampaignOptions options;
  options.seed = 7;
  options.cases = 6;
  options.out = folder.path() / "out";
  for (const Kind kind : all_kinds) options.generators.emplace_back(name_of(kind));
  const auto subject = make_subject("reference");
  const CampaignSummary summary = run_campaign(options, *subject);
  EXPECT_TRUE(summary.findings.empty());
  EXPECT_TRUE(summary.contradictions.empty());
}

// What the conformance runner is tested with, as a function.
std::unique_ptr<Subject> planted_method(const std::string& mode) {
  return subject_of(mode, [mode](const Case& scene) {
    validate::Request request;
    request.mesh = scene.mesh;
    request.cell = scene.cell;
    request.mode = scene.solid ? validate::CaseMode::solid : validate::CaseMode::sheet;
    return planted::answer(mode, request);
  });
}

class PlantedLong : public testing::TestWithParam<const char*> {};

TEST_P(PlantedLong, IsFoundByAllGenerators) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  CampaignOptions options;
  options.seed = 1;
  options.cases = 400;
  is_found_and_shrunk(options, *planted_method(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(All, PlantedLong,
                         testing::Values("everything-hidden", "hides-one", "from-centre", "random-rays", "float32",
                                         "cell-shrunk", "drops-small"));

}  // namespace
}  // namespace clues::fuzz
