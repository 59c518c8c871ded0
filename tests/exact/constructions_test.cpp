// What exact/kernel.h makes in rationals is what lazy numbers make, and laying flat has a way back.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exact/complex/complex_internal.h"
#include "exact/kernel.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;

class Rationals {
 public:
  FT number() { return FT(static_cast<int>(random_() % 2001) - 1000) / FT(1 + static_cast<int>(random_() % 40)); }
  Point3 point() { return {number(), number(), number()}; }

 private:
  std::mt19937_64 random_{kSeed};
};

TEST(Constructions, CrossingsAreThoseOfLazyNumbers) {
  Rationals random;
  for (int i = 0; i < 500; ++i) {
    const Plane3 h(random.point(), random.point(), random.point());
    const Point3 a = random.point(), b = random.point();
    const FT at_a = exact::value_at(h, a), at_b = exact::value_at(h, b);
    if (at_a == at_b) continue;
    const Point3 expected = a + (at_a / (at_a - at_b)) * (b - a), made = exact::crossing(h, a, b);
    EXPECT_EQ(made, expected);
    EXPECT_EQ(exact::zero_on_line(a, b, at_a, at_b), expected);
    EXPECT_TRUE(h.has_on(made));
    // The interval is that of the number, not of how it was made.
    EXPECT_LE(made.x().approx().sup() - made.x().approx().inf(), std::ldexp(std::abs(CGAL::to_double(made.x())), -51));
  }
}

TEST(Constructions, WhatIsLaidFlatIsLiftedBack) {
  Rationals random;
  for (int i = 0; i < 500; ++i) {
    const Point3 a = random.point(), b = random.point(), c = random.point();
    const Plane3 h(a, b, c);
    if (h.is_degenerate()) continue;
    const int axis = exact::dominant_axis(h.orthogonal_vector());
    for (const double unit : {1.0, 0x1p200, 0x1p-300}) {
      const Point3 p = CGAL::barycenter(a, random.number(), b, random.number(), c, FT(3001));
      EXPECT_EQ(exact::lift_axis(h, exact::drop_axis(p, axis, unit), axis, unit), p) << axis << ' ' << unit;
    }
  }
}

}  // namespace
}  // namespace clues::test
