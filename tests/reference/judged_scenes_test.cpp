#include "judged_scenes.h"

#include <gtest/gtest.h>

namespace clues::test {
namespace {

TEST(Judges, FindNothingWhereNothingIsWrong) { EXPECT_EQ(contradictions_in_random_scenes(2), 0U); }

}  // namespace
}  // namespace clues::test
