// A box is skipped only where the segment certainly misses it, whatever the rounding was when the test was made.
#include "exact/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/seed.h"

namespace clues::exact {
namespace {

// From far away to beside the origin, and a point of it that is as near to that end: its box is a few units in the last place wide.
TEST(SegmentBoxTest, KeepsTheBoxOfAPointOfTheSegment) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto exponent = [&] { return -static_cast<int>(random() % 90); };
  int lost = 0;
  for (int i = 0; i < 200000; ++i) {
    const double small = std::ldexp(1.0, exponent());
    const Point3 a(9 * number(random), 9 * number(random), 9 * number(random)),
        b(small * number(random), small * number(random), small * number(random));
    const FT share = 1 - FT(std::ldexp(1.0 + static_cast<double>(random() % 7), exponent() - 3));
    const Point3 x = a + share * (b - a);
    x.exact();
    lost += BoxTree(std::vector{x.bbox()}).candidates(SegmentBoxTest(a, b)).empty() ? 1 : 0;
  }
  EXPECT_EQ(lost, 0);
}

}  // namespace
}  // namespace clues::exact
