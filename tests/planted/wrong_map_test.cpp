// Each wrong copy makes hierarchies that the judge of them refuses.
#include <gtest/gtest.h>

#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "validate/multires/check_hierarchy.h"

namespace clues {
namespace {

TEST(WrongMap, IsRefused) {
  std::uint64_t refused = 0;
  for (const auto& mesh : {fuzz::ball(1), fuzz::ball(3), fuzz::frame(1, 2), fuzz::sheet(5)}) {
    reference::HierarchyOptions options;
    options.base_triangles = mesh.triangles.size() - 2;  // one level
    auto report = validate::check_hierarchy(reference::build_hierarchy(mesh, options));
    refused += report.sound() ? 0U : 1U;
  }
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace clues
