// Each wrong copy makes remeshes that the judge of them refuses.
#include <gtest/gtest.h>

#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/smoothing.h"
#include "validate/multires/check_remesh.h"

namespace clues {
namespace {

TEST(WrongRemesh, IsRefused) {
  std::uint64_t refused = 0;
  for (const auto& mesh : {fuzz::ball(5), fuzz::frame(1, 2)}) {
    reference::HierarchyOptions options;
    options.base_triangles = 40;
    const auto h = reference::build_hierarchy(mesh, options);
    reference::RemeshOptions how;
    how.level = 1;
    auto remesh = reference::remeshed(h, how);
    reference::smooth(remesh, h, {});
    validate::HierarchyReport report;
    validate::check_remesh(h, remesh.mesh, remesh.proof, false, report);
    refused += report.sound() ? 0U : 1U;
  }
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace clues
