// Who works on what, without a cluster: every task is given once, nobody has more than its places, and the bounds hold that are known of such orders.
#include "validate/processes/dispatcher.h"

#include <gmock/gmock.h>

#include <functional>
#include <queue>
#include <random>

namespace clues::validate {
namespace {

TEST(Dispatcher, GivesToWhoeverHasMostPlacesFree) {
  Dispatcher d;
  EXPECT_FALSE(d.idle());
  d.join(0, 1);
  d.join(2, 3);
  std::vector<std::size_t> to;
  while (d.idle()) to.push_back(d.give());
  EXPECT_THAT(to, testing::ElementsAre(2, 2, 0, 2));
  EXPECT_FALSE(d.empty());
  d.done(0);
  EXPECT_EQ(d.give(), 0U);
  d.join(1, 1);
  EXPECT_EQ(d.give(), 1U);
  for (const std::size_t worker : {0U, 1U, 2U, 2U, 2U}) d.done(worker);
  EXPECT_TRUE(d.empty());
  EXPECT_EQ(d.give(), 2U);
}

TEST(Dispatcher, LongestFirstKeepsTheOrderOfEqualOnes) {
  EXPECT_THAT(longest_first({1, 3, 1, 3, 2}), testing::ElementsAre(1, 3, 4, 0, 2));
}

// Of m workers who are never idle while there is work the last is done by sum / m + longest.
TEST(Dispatcher, TheEndIsWithinTheBoundsOfListScheduling) {
  std::mt19937 random(20261123);
  for (int round = 0; round < 200; ++round) {
    const std::size_t workers = 1 + random() % 9;
    std::vector<double> seconds(1 + random() % 60);
    double sum = 0, longest = 0;
    for (double& s : seconds) {
      s = 1 + static_cast<double>(random() % 1000);
      sum += s;
      longest = std::max(longest, s);
    }
    Dispatcher d;
    for (std::size_t w = 0; w < workers; ++w) d.join(w, 1);
    using Done = std::pair<double, std::size_t>;
    std::priority_queue<Done, std::vector<Done>, std::greater<>> running;
    double now = 0;
    std::vector<int> given(seconds.size());
    const auto order = longest_first(seconds);
    for (std::size_t next = 0; next < order.size() || !running.empty();) {
      while (d.idle() && next < order.size()) {
        ++given[order[next]];
        running.emplace(now + seconds[order[next++]], d.give());
      }
      now = running.top().first;
      d.done(running.top().second);
      running.pop();
    }
    EXPECT_THAT(given, testing::Each(1));
    EXPECT_TRUE(d.empty());
    EXPECT_LE(now, sum / static_cast<double>(workers) + longest);
    if (seconds.size() <= workers) {
      EXPECT_EQ(now, longest);
    }
  }
}

}  // namespace
}  // namespace clues::validate
