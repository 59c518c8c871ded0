// Linked with a copy of a source of fastpath/solids/ that takes edges of sections for such of one line that are not, or estimates of their corners for better than they are (plant.py): rationals tell.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/solids/worlds.h"

namespace clues::tests {
namespace {

TEST(WrongRims, DifferFromThoseOfRationals) {
  const Rims rims = compare_rims(1, 60);
  EXPECT_NE(rims.differs, "");
  std::cout << rims.differs << "\n";
}

}  // namespace
}  // namespace clues::tests
