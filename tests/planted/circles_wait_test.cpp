// Linked with a reference in which parts of edges wait for each other in a circle (plant.py, T12), as every kernel had it until 2026-11-24. It agrees with itself, whatever is compared: only
// what is seen tells.
#include <gtest/gtest.h>

#include <iostream>

#include "../fuzz/found_and_shrunk.h"
#include "../validate/first_unsound_case.h"

namespace clues::test {
namespace {

TEST(CirclesWait, IsUnsoundInThePublishedSuite) {
  const std::string found = validate::first_unsound_case(CLUES_SOURCE_DIR "/vectors");
  EXPECT_NE(found.find("iris"), std::string::npos) << found;
  std::cout << "unsound on " << found << "\n";
}

TEST(CirclesWait, IsFoundByACampaign) {
  fuzz::CampaignOptions options;
  options.seed = 7;
  options.cases = 200;
  options.generators = {"irises"};
  fuzz::is_found_and_shrunk(options, *fuzz::make_subject("reference"));
}

}  // namespace
}  // namespace clues::test
