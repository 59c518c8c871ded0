// Each wrong copy of a part of the fast path makes a hierarchy that is not the reference's, or one that cannot be made at all.
#include <gtest/gtest.h>

#include <cmath>

#include "fastpath/multires/build.h"
#include "fuzz/generators/random.h"
#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy_file.h"

namespace clues {
namespace {

bool is_other(const scene::TriangleMesh& mesh) {
  reference::HierarchyOptions options;
  options.base_triangles = 0;
  fastpath::multires::BuildOptions fast;
  fast.base_triangles = 0;
  return scene::to_text(reference::build_hierarchy(mesh, options)) !=
         scene::to_text(fastpath::multires::build_hierarchy(mesh, fast));
}

// Flat fans whose rings lie on a circle, which their layouts then do but for the rounding to the grid.
scene::TriangleMesh round_fan(fuzz::Random& random) {
  auto mesh = fuzz::fan(random.between(4, 9), true);
  double angle = 0;
  for (std::size_t v = 1; v < mesh.points.size(); ++v) {
    angle += 0.01 + static_cast<double>(random.next() >> 11) * 0x1p-53 / 2;
    mesh.points[v] = {std::cos(angle), std::sin(angle), 0};
  }
  return mesh;
}

TEST(WrongFastMap, IsAnotherThanTheReferences) {
  std::uint64_t others = 0;
  for (const auto& mesh : {fuzz::ball(1), fuzz::ball(3), fuzz::frame(1, 2), fuzz::sheet(5)})
    others += is_other(mesh) ? 1U : 0U;
  fuzz::Random random(5);
  for (int k = 0; k < 3000 && others == 0; ++k) others += is_other(round_fan(random)) ? 1U : 0U;
  for (std::uint64_t k = 0; k < 300 && others == 0; ++k) others += is_other(fuzz::surface_case(1, k).mesh) ? 1U : 0U;
  EXPECT_GT(others, 0U);
}

}  // namespace
}  // namespace clues
