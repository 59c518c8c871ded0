// The bins against a list that is looked through as a whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fastpath/motion/bounds/calendar.h"
#include "fuzz/generators/random.h"

namespace clues::tests {
namespace {

using fastpath::motion::Calendar;

TEST(Calendar, GivesWhatIsDueAndNothingElse) {
  fuzz::Random random(6);
  for (const double width : {1.0, 0.3, 1e-9}) {
    Calendar calendar(width);
    std::vector<double> keys;
    std::vector<std::uint32_t> waiting;
    double odometer = 0;
    for (int frame = 0; frame < 400; ++frame) {
      for (int k = 0; k < 20; ++k) {
        // Some at once, some in a few bins, some after rounds of the ring, some never.
        const double far = random.one_in(10) ? 0 : std::ldexp(width, random.between(-3, 14)) * random.between(1, 9);
        keys.push_back(random.one_in(30) ? std::numeric_limits<double>::infinity() : odometer + far);
        waiting.push_back(static_cast<std::uint32_t>(keys.size() - 1));
        calendar.put({keys.back(), waiting.back(), 0});
      }
      // Short ways, ways of up to two rounds of the ring, and ways past all of it.
      if (!random.one_in(7)) {
        odometer += random.one_in(40)   ? 5000 * width
                    : random.one_in(12) ? width * random.between(1, 2048)
                                        : width * random.between(1, 30) / 4;
      }
      std::vector<Calendar::Entry> due;
      calendar.take_due(odometer, due);
      std::vector<std::uint32_t> got, expected;
      for (const auto& entry : due) got.push_back(entry.item);
      for (const std::uint32_t item : waiting) {
        if (keys[item] <= odometer) expected.push_back(item);
      }
      std::sort(got.begin(), got.end());
      ASSERT_EQ(got, expected) << frame;
      std::erase_if(waiting, [&](std::uint32_t item) { return keys[item] <= odometer; });
    }
  }
}

// What nobody wants any more goes, from the ring and from outside of it, and nothing else does; and a calendar that was cleared is a new one.
TEST(Calendar, KeepsWhatIsWantedAndForgetsAll) {
  Calendar calendar(1);
  for (const bool again : {false, true}) {
    SCOPED_TRACE(again);
    for (std::uint32_t i = 0; i < 3000; ++i) calendar.put({i + 0.5, i, i % 3});
    EXPECT_EQ(calendar.keep([](const Calendar::Entry& e) { return e.stamp == 1; }), 1000U);
    std::vector<Calendar::Entry> due;
    calendar.take_due(2000, due);
    EXPECT_EQ(due.size(), 667U);
    for (const auto& entry : due) EXPECT_EQ(entry.stamp, 1U);
    EXPECT_EQ(calendar.keep([](const Calendar::Entry&) { return true; }), 333U);
    calendar.clear();
    EXPECT_EQ(calendar.keep([](const Calendar::Entry&) { return true; }), 0U);
  }
}

// What is outside of the ring may be due before half of the ring has gone by and it is looked through: after a step that is longer than that half.
TEST(Calendar, GivesWhatIsDueOutsideOfTheRingAfterALongStep) {
  Calendar calendar(1);
  calendar.put({1100, 7, 0});
  std::vector<Calendar::Entry> due;
  calendar.take_due(500, due);
  EXPECT_EQ(due.size(), 0U);
  calendar.take_due(1150, due);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due.front().item, 7U);
}

}  // namespace
}  // namespace clues::tests
