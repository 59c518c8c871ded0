// A bound that is too large by 2^-40 of itself: the exact comparison notices.
#include <gtest/gtest.h>

#include "exact/motion/compare_bounds.h"
#include "fastpath/motion/bounds/bounds.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

TEST(BoundRoundedUp, IsFoundByTheExactComparison) {
  fuzz::Random random(10);
  int above = 0;
  for (int k = 0; k < 200; ++k) {
    std::array<DepthSample, 3> s;
    for (DepthSample& p : s) p.at = direction(random);
    const auto row = [&](std::size_t i) { return fastpath::motion::row_of(s[i], {0, 0, 0}); };
    const double d = fastpath::motion::facing_bound(row(0), row(1), row(2));
    if (!(d > 0)) continue;
    const auto square = mpq_class(d) * mpq_class(d);
    above += exact::compare_facing_bound(s[0], s[1], s[2], exact::exact_viewpoint({0, 0, 0}), square) < 0 ? 1 : 0;
  }
  EXPECT_GT(above, 0);
}

}  // namespace
}  // namespace clues::tests
