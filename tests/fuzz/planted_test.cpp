// Each planted defect that hides something visible is found and shrunk: wrong implementations (those of the conformance runner's tests) and planted bugs of the
// reference. The short ones here, by a campaign of a few cases; all of them, by all generators, within a minute of one core, in the long tests.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <iostream>
#include <set>

#include "../conform/planted/answers.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/generators/random_scenes.h"
#include "fuzz/oracles/oracle.h"
#include "fuzz/shrinking/finding_folder.h"
#include "planted_subjects.h"
#include "scene/files/temporary_folder.h"

namespace clues::fuzz {
namespace {

double cpu_seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

// The campaign ends at the first finding.
void is_found_and_shrunk(CampaignOptions options, const Subject& subject) {
  const scene::TemporaryFolder folder;
  options.out = folder.path() / "out";
  options.errors = 1;
  options.shrink.time = std::chrono::seconds(600);  // the steps end it
  options.shrink.steps = 150;
  const double before = cpu_seconds_of_children();
  double found_after = 0;
  options.progress = [&](const std::string& stage, std::uint64_t, std::uint64_t) {
    if (stage == "findings shrunk" && found_after == 0) found_after = cpu_seconds_of_children() - before;
  };
  const CampaignSummary summary = run_campaign(options, subject);
  EXPECT_EQ(summary.exit_code(), 1);
  EXPECT_TRUE(summary.contradictions.empty()) << summary.contradictions.front();
  ASSERT_FALSE(summary.findings.empty()) << subject.name();
  EXPECT_LE(found_after, 60);
  for (const auto& f : summary.findings) {
    ASSERT_TRUE(f.folder.has_value());
    const SavedFinding saved = load_finding(options.out / *f.folder);
    EXPECT_EQ(flaw_of(saved.finding, subject), "");
    EXPECT_EQ(saved.finding.signature(), f.finding.signature());
    EXPECT_LE(saved.finding.where.mesh.triangles.size(), 12U);
    std::cout << subject.name() << ": case " << f.case_number << " after " << found_after << " s, "
              << f.finding.signature() << ", " << saved.original.where.mesh.triangles.size() << " -> "
              << saved.finding.where.mesh.triangles.size() << " triangles in " << saved.steps << " steps\n";
  }
}

void is_found_soon(const Subject& subject, std::uint64_t within) {
  CampaignOptions options;
  options.seed = 7;
  options.cases = within;
  for (const Kind kind : all_kinds) options.generators.emplace_back(name_of(kind));
  is_found_and_shrunk(options, subject);
}

TEST(PlantedSubject, EverythingHiddenIsFound) { is_found_soon(EverythingHidden(), 2); }
TEST(PlantedSubject, OneHiddenTriangleIsFound) { is_found_soon(HidesOneTriangle(), 12); }
TEST(PlantedSubject, FromTheCentreIsFound) { is_found_soon(FromTheCentre(), 12); }
TEST(PlantedSubject, WrongWedgeSideIsFound) { is_found_soon(*make_subject("reference:wrong_wedge_side"), 48); }
TEST(PlantedSubject, RetestedCsvIsFound) { is_found_soon(*make_subject("reference:retested_csv"), 48); }
TEST(PlantedSubject, MissingRule3IsFound) { is_found_soon(*make_subject("reference:no_rule_3"), 48); }
TEST(PlantedSubject, RoundedComparisonIsFound) { is_found_soon(*make_subject("reference:rounded_comparison"), 48); }

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
  const std::string name = GetParam();
  CampaignOptions options;
  options.seed = 1;
  options.cases = 400;
  is_found_and_shrunk(options, name.starts_with("reference:") ? *make_subject(name) : *planted_method(name));
}

INSTANTIATE_TEST_SUITE_P(All, PlantedLong,
                         testing::Values("everything-hidden", "hides-one", "from-centre", "random-rays", "no-rule-3",
                                         "float32", "cell-shrunk", "drops-small", "reference:wrong_wedge_side",
                                         "reference:retested_csv", "reference:no_rule_3",
                                         "reference:rounded_comparison"));

}  // namespace
}  // namespace clues::fuzz
