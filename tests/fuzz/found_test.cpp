// Scenes in which campaigns found something, as they were shrunk; and a long campaign that is to find nothing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/oracle.h"
#include "scene/temporary_folder.h"

namespace clues::fuzz {
namespace {

// axis_boxes 2 of seed 5, 14 triangles before: "local star: a direction cannot leave its arc".
TEST(Found, TwoTrianglesAtACornerInLineWithTheCell) {
  Case scene{"found", 0, 0, {}, {}};
  scene.mesh.points = {{4, 0, 0}, {5, 1, 0}, {5, 0, 0}, {5, 0, 1}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.mesh.face_of = {0, 1};
  for (const double z : {-2, 1}) {
    for (const double y : {-1, 1}) {
      for (const double x : {2, 3}) scene.cell.push_back({x, y, z});
    }
  }
  const auto subject = make_subject("reference");
  const Outcome outcome = judge_case(scene, *subject, oracles_named({}));
  for (const Finding& f : outcome.findings) ADD_FAILURE() << f.signature() << ": " << f.explanation;
  for (const auto& text : outcome.contradictions) ADD_FAILURE() << text;
}

TEST(ReferenceCampaignLong, FindsNothing) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  const scene::TemporaryFolder folder;
  CampaignOptions options;
  options.seed = 20261121;
  options.cases = 320;
  options.jobs = 2;
  options.out = folder.path();
  const auto subject = make_subject("reference");
  const CampaignSummary summary = run_campaign(options, *subject);
  std::cout << to_text(summary, options.out);
  EXPECT_EQ(summary.exit_code(), 0);
}

}  // namespace
}  // namespace clues::fuzz
