// Trials (fuzz/trials): campaigns on hierarchies of surfaces, motion bounds, transitions. What is planted is found, shrunk, saved, and found again; what is ours holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fuzz/campaign/campaign.h"
#include "fuzz/shrinking/finding_folder.h"
#include "fuzz/trials/deltas_trial.h"
#include "fuzz/trials/maps_trial.h"
#include "fuzz/trials/motion_trial.h"
#include "reference/motion/mesh.h"
#include "reference/multires/hierarchy.h"
#include "scene/files/temporary_folder.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

CampaignSummary campaign(const Subject& subject, std::uint64_t cases, const std::filesystem::path& out,
                         std::vector<std::string> generators = {}) {
  CampaignOptions options;
  options.cases = cases;
  options.seed = 20261123;
  options.dials = true;  // of no use to a trial, and no harm
  options.generators = std::move(generators);
  options.jobs = 2;
  options.out = out;
  options.shrink.steps = 150;
  return run_campaign(options, subject);
}

// One weight of the first point that has two is one unit too large.
scene::Hierarchy with_a_wrong_weight(const scene::TriangleMesh& mesh, const std::vector<scene::Edge>& features,
                                     std::uint64_t base) {
  reference::HierarchyOptions options;
  options.features = features;
  options.base_triangles = base;
  scene::Hierarchy h = reference::build_hierarchy(mesh, options);
  for (auto& point : h.points) {
    if (point.image.weight[1] == 0) continue;
    ++point.image.weight[1];
    break;
  }
  return h;
}

TEST(Trials, OurHierarchiesHold) {
  const scene::TemporaryFolder folder;
  const auto summary = campaign(*make_subject("maps"), 100, folder.path());
  EXPECT_EQ(summary.exit_code(), 0) << to_text(summary, folder.path());
  EXPECT_TRUE(summary.judged);
  EXPECT_THAT(summary.never_occurred, IsEmpty());
  EXPECT_GT(summary.counters.at("remeshes judged"), 10U);
}

TEST(Trials, OurBoundsAndWalksHold) {
  const scene::TemporaryFolder folder;
  const auto summary = campaign(*make_subject("motion"), 110, folder.path());
  EXPECT_EQ(summary.exit_code(), 0) << to_text(summary, folder.path());
  EXPECT_TRUE(summary.judged);
  EXPECT_THAT(summary.never_occurred, IsEmpty());
  EXPECT_GT(summary.counters.at("bounds proved"), 100U);
  EXPECT_GT(summary.counters.at("frames checked"), 100U);
}

TEST(Trials, AWrongHierarchyIsFoundShrunkAndFoundAgain) {
  const scene::TemporaryFolder folder;
  const auto wrong = subject_of("maps", make_maps_trial(with_a_wrong_weight));
  const auto summary = campaign(*wrong, 12, folder.path());
  ASSERT_EQ(summary.exit_code(), 1) << to_text(summary, folder.path());
  ASSERT_EQ(summary.findings.size(), 1U);
  const auto& found = summary.findings.front();
  EXPECT_EQ(found.finding.signature(), "hierarchies-agree promise/broken surfaces");
  ASSERT_TRUE(found.folder);
  const auto saved = load_finding(folder.path() / *found.folder);
  EXPECT_LT(saved.finding.where.mesh.triangles.size(), saved.original.where.mesh.triangles.size());
  EXPECT_EQ(flaw_of(saved.finding, *wrong), "");
  EXPECT_NE(flaw_of(saved.finding, *make_subject("maps")), "") << "ours has no such flaw";
}

TEST(Trials, ABoundThatIsTooLargeIsFound) {
  const scene::TemporaryFolder folder;
  const auto wrong = subject_of(
      "motion", make_motion_trial([](const MotionCase& test) {
        auto bounds = reference::motion_bounds(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
        const auto& s = test.mesh.samples;
        if (bounds[0] > 0)
          bounds[0] = 1.5 * reference::facing_bound(s[0], s[1], s[2], exact::exact_viewpoint(test.viewpoint));
        return bounds;
      }));
  const auto summary = campaign(*wrong, 20, folder.path(), {"bounds_random", "bounds_wall"});
  ASSERT_EQ(summary.exit_code(), 1) << to_text(summary, folder.path());
  const auto& found = summary.findings.front();
  EXPECT_THAT(found.finding.signature(), HasSubstr("bounds-hold promise/broken bounds_"));
  EXPECT_THAT(found.finding.explanation, HasSubstr("is violated at ("));
  const auto saved = load_finding(folder.path() / found.folder.value());
  EXPECT_EQ(saved.steps, 0U) << "its name makes it, and nothing else";
  EXPECT_EQ(flaw_of(saved.finding, *wrong), "");
}

TEST(Trials, OurTransitionsHold) {
  const scene::TemporaryFolder folder;
  const auto summary = campaign(*make_subject("deltas"), 8, folder.path(), {"tetrahedra", "axis_boxes"});
  EXPECT_EQ(summary.exit_code(), 0) << to_text(summary, folder.path());
  EXPECT_GT(summary.counters.at("transitions judged"), 4U);
  EXPECT_GT(summary.counters.at("transitions that show something"), 0U);
}

// Of what is visible from both cells, one region is said to be newly visible.
reference::Delta with_a_wrong_label(const scene::TriangleMesh& mesh, const exact::ConvexCell& from,
                                    const exact::ConvexCell& to, const reference::Options& options) {
  auto delta = reference::delta_of(mesh, from, to, options);
  const auto both = std::find_if(delta.regions.begin(), delta.regions.end(),
                                 [](const auto& r) { return r.seen == reference::SeenFrom::both; });
  if (both != delta.regions.end()) both->seen = reference::SeenFrom::to;
  return delta;
}

TEST(Trials, AWrongTransitionIsFoundAndShrunk) {
  const scene::TemporaryFolder folder;
  const auto wrong = subject_of("deltas", make_deltas_trial(with_a_wrong_label));
  const auto summary = campaign(*wrong, 2, folder.path(), {"tetrahedra"});
  ASSERT_EQ(summary.exit_code(), 1) << to_text(summary, folder.path());
  const auto saved = load_finding(folder.path() / summary.findings.front().folder.value());
  EXPECT_EQ(saved.finding.oracle, "transition-judged");
  EXPECT_LE(saved.finding.where.mesh.triangles.size(), 2U);
  EXPECT_EQ(flaw_of(saved.finding, *wrong), "");
}

TEST(Trials, AKernelThatEndsInAnErrorIsAFinding) {
  const scene::TemporaryFolder folder;
  const auto wrong = subject_of("maps", make_maps_trial([](const auto&, const auto&, auto) -> scene::Hierarchy {
                                  throw scene::Error(scene::ErrorCode::internal, "the fast path is lost");
                                }));
  const auto summary = campaign(*wrong, 3, folder.path());
  ASSERT_EQ(summary.exit_code(), 1) << to_text(summary, folder.path());
  EXPECT_EQ(summary.findings.front().finding.signature(), "subject no-answer/answer surfaces");
  const auto saved = load_finding(folder.path() / summary.findings.front().folder.value());
  EXPECT_EQ(saved.steps, 0U) << "a smaller surface may be none, and rightly refused";
  EXPECT_EQ(flaw_of(saved.finding, *wrong), "");
  EXPECT_NE(flaw_of(saved.finding, *make_subject("maps")), "");
}

TEST(Trials, WhatNoOracleLooksAtIsNotMade) {
  const scene::TemporaryFolder folder;
  CampaignOptions options;
  options.cases = 8;
  options.out = folder.path();
  options.oracles = {"frames-hold"};
  options.require_coverage = true;
  const auto summary = run_campaign(options, *make_subject("motion"));
  EXPECT_EQ(summary.counters.at("cases of walks"), 8U);
  EXPECT_EQ(summary.exit_code(), 0) << to_text(summary, folder.path());
  options.generators = {"bounds_wall"};
  EXPECT_THROW(run_campaign(options, *make_subject("motion")), scene::Error);
}

TEST(Trials, TakeOnlyTheirOwnNames) {
  const scene::TemporaryFolder folder;
  EXPECT_THROW(campaign(*make_subject("maps"), 2, folder.path(), {"axis_boxes"}), scene::Error);
  CampaignOptions options;
  options.cases = 1;
  options.out = folder.path();
  options.oracles = {"sight-lines"};
  EXPECT_THROW(run_campaign(options, *make_subject("motion")), scene::Error);
  options.oracles = {};
  options.given.paths = {"vectors"};
  EXPECT_THROW(run_campaign(options, *make_subject("motion")), scene::Error);
}

}  // namespace
}  // namespace clues::fuzz
