// Linked with a copy of one source of fastpath/solids/ that takes a decision wrongly (plant.py): sight lines tell.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/solids/worlds.h"

namespace clues::tests {
namespace {

TEST(WrongSolids, HideWhatIsSeen) {
  const Looked looked = look_for_what_is_hidden(1, 400, 200);
  EXPECT_NE(looked.seen, "");
  std::cout << looked.seen << "\n";
}

}  // namespace
}  // namespace clues::tests
