// Linked with a reference that takes one decision wrongly (plant.py). Everything that judges the reference must notice, or it is decoration.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "../fuzz/found_and_shrunk.h"
#include "../reference/judged_scenes.h"
#include "../validate/first_unsound_case.h"

namespace clues::test {
namespace {

TEST(WrongReference, IsCaughtByTheJudges) { EXPECT_GT(contradictions_in_random_scenes(8), 0U); }

TEST(WrongReference, IsUnsoundInThePublishedSuite) {
  const std::string found = validate::first_unsound_case(CLUES_SOURCE_DIR "/vectors");
  EXPECT_NE(found, "");
  std::cout << "unsound on " << found << "\n";
}

TEST(WrongReference, IsFoundByACampaign) { fuzz::is_found_soon(*fuzz::make_subject("reference"), 48); }

TEST(WrongReferenceLong, IsFoundByAllGenerators) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  fuzz::CampaignOptions options;
  options.seed = 1;
  options.cases = 400;
  fuzz::is_found_and_shrunk(options, *fuzz::make_subject("reference"));
}

}  // namespace
}  // namespace clues::test
