// Refined maps of the conformance suite: everything that is proved visible stays, nothing comes that is not visible to first order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "validate/vectors/reader.h"
#include "validate/verdicts/precision.h"

namespace clues::test {
namespace {

const std::filesystem::path kSuite = std::filesystem::path(CLUES_SOURCE_DIR) / "vectors";

void expect_between(const std::vector<validate::VectorCase>& cases, validate::Refinement refinement, int depth) {
  std::uint64_t hidden_after_all = 0;
  for (const auto& c : cases) {
    SCOPED_TRACE(c.id);
    reference::Options options;
    if (c.mode == validate::CaseMode::solid) options.mode = reference::Mode::solid;
    reference::Bounds bounds(c.mesh, exact::ConvexCell::from_doubles(c.cell), options);
    validate::refine(bounds, refinement, {depth, 0});
    const auto visible = bounds.refined_map("subdivided").visible;
    for (const auto& v : c.expect->must_be_visible)
      EXPECT_TRUE(std::binary_search(visible.begin(), visible.end(), v.triangle)) << "triangle " << v.triangle;
    const auto& first = c.expect->first_order_visible;
    EXPECT_TRUE(std::includes(first.begin(), first.end(), visible.begin(), visible.end()));
    hidden_after_all += first.size() - visible.size();
  }
  std::cout << cases.size() << " cases; " << hidden_after_all << " triangles hidden after all\n";
}

std::vector<validate::VectorCase> cases_of(const std::vector<std::string>& topics, std::size_t most_triangles) {
  std::vector<validate::VectorCase> found;
  for (auto& c : validate::read_suite(kSuite)) {
    if (!c.is_plain() || c.mesh.triangles.size() > most_triangles) continue;
    if (topics.empty() || std::find(topics.begin(), topics.end(), c.topic) != topics.end())
      found.push_back(std::move(c));
  }
  return found;
}

TEST(RefinedSuite, Hazards) { expect_between(cases_of({"hazards"}, 16), validate::Refinement::both, 1); }

TEST(RefinedSuiteLong, AllCases) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_between(cases_of({}, 400), validate::Refinement::cells, 2);
  expect_between(cases_of({}, 64), validate::Refinement::backprojection, 2);
}

}  // namespace
}  // namespace clues::test
