// FIGS. 48A, 48B, 50B: lower bounds of arrival against movers that are as fast as can be; streams over slow and broken
// links, which stall and never have a hole; and packets that are dropped, soundly on every route or not (hazard A-24).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "reference/link/link_simulator.h"
#include "reference/link/penetration.h"
#include "reference/streams/worth.h"
#include "scene/stream/route.h"
#include "tests/delta/town.h"
#include "tests/reference/support.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::FT;
using reference::Agility;
using reference::Link;

// sqrt(2 d / a) for d <= v^2 / (2 a), else d / v + v / (2 a), from rest; and the bound is not above it, nor far below.
TEST(Penetration, IsTheFormulaFromRest) {
  for (const double d : {0.0, 0.25, 1.0, 8.0, 100.0}) {
    for (const double v : {0.5, 2.0, 10.0}) {
      for (const double a : {0.125, 1.0, 50.0}) {
        const Agility agility{FT(v), FT(a)};
        const double t = CGAL::to_double(reference::penetration_time(FT(d) * FT(d), FT(0), agility));
        const double expected = d <= v * v / (2 * a) ? std::sqrt(2 * d / a) : d / v + v / (2 * a);
        EXPECT_LE(t, expected * (1 + 1e-12));
        EXPECT_GE(t, expected - 2e-6);
      }
    }
  }
}

TEST(Penetration, IsALowerBoundExactly) {
  std::mt19937_64 random(kSeed);
  const auto number = [&](int most) { return FT(static_cast<int>(random() % static_cast<unsigned>(most)) + 1) / 16; };
  for (int i = 0; i < 200; ++i) {
    const Agility agility{number(400), number(400)};
    const FT speed = agility.speed_limit * number(16);  // 1/16 to 1 of it
    const FT square = number(4000);
    const FT t = reference::penetration_time(square, speed, agility), tick = FT(1) / FT(1 << 20);
    const FT far = reference::farthest_in(t, speed, agility), next = reference::farthest_in(t + tick, speed, agility);
    EXPECT_LE(far * far, square);
    EXPECT_GT(next * next, square);
    const FT slow = reference::speed_in_time(square, t, agility.speed_limit);
    EXPECT_LE(slow * t * slow * t, square);
    EXPECT_LE(slow, agility.speed_limit);
  }
}

TEST(Penetration, DistancesAreLowerBounds) {
  const auto cell = box_cell(0, 0, 0, 1, 1, 1);
  EXPECT_EQ(reference::squared_distance_bound({0.5, 0.5, 0.5}, cell), FT(0));
  EXPECT_EQ(reference::squared_distance_bound({1, 1, 1}, cell), FT(0));
  EXPECT_EQ(reference::squared_distance_bound({3, 0.5, 0.5}, cell), FT(4));  // the distance
  EXPECT_EQ(reference::squared_distance_bound({3, 4, 0.5}, cell), FT(9));    // less than it, which is 13
}

TEST(Lateness, TakesTheFirstDetailThatComesInTime) {
  bool late = false;
  const std::vector<std::uint64_t> sizes{100000, 20000, 1000};
  EXPECT_EQ(reference::detail_in_time(sizes, 0, 100000, FT(1) / 10, FT(2), late), 0U);
  EXPECT_EQ(reference::detail_in_time(sizes, 0, 100000, FT(1) / 10, FT(1), late), 1U);
  EXPECT_FALSE(late);
  EXPECT_EQ(reference::detail_in_time(sizes, 100000, 100000, FT(1) / 10, FT(1), late), 2U);
  EXPECT_TRUE(late);
}

// A viewer who enters another cell each second.
std::vector<reference::TimedStep> steps_of(const std::vector<std::uint32_t>& route) {
  std::vector<reference::TimedStep> steps;
  for (const std::uint32_t cell : route) steps.push_back({1000000 * (1 + steps.size()), cell});
  return steps;
}
std::string text_of(const std::vector<scene::StreamMessage>& messages) {
  std::string text;
  for (const auto& m : messages) text += scene::to_line(m);
  return text;
}

TEST(LinkSimulator, AFastLinkStallsForItsLatencyAndAskingAheadHidesIt) {
  const auto route = scene::random_route(town().neighbours(), 20, kSeed);
  Link link;
  link.bytes_per_second = 1000000000;
  link.latency_us = 30000;
  const auto late = reference::walk_over(town().store(1), steps_of(route), link, 0);
  EXPECT_EQ(late.stalls, route.size());
  EXPECT_GE(late.longest_us, 60000U);
  EXPECT_LE(late.longest_us, 60100U);
  const auto ahead = reference::walk_over(town().store(1), steps_of(route), link, 100000);
  EXPECT_EQ(ahead.stalls, 0U);
  EXPECT_EQ(text_of(ahead.messages), text_of(town().stream(route, 1)));
}

TEST(LinkSimulator, ASlowAndBrokenLinkStallsAndLeavesNoHole) {
  const auto route = scene::random_route(town().neighbours(), 20, kSeed);
  for (const int horizon : {0, 1}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Link link{20000, 50000, 300000, 700000, seed};
      const auto report = reference::walk_over(town().store(horizon), steps_of(route), link, 0);
      EXPECT_GT(report.losses, 0U);
      EXPECT_GE(report.longest_us, 700000U);
      EXPECT_EQ(text_of(report.messages), text_of(town().stream(route, horizon)));
      EXPECT_TRUE(town().judge(report.messages).findings.empty());
      const auto again = reference::walk_over(town().store(horizon), steps_of(route), link, 0);
      EXPECT_EQ(again.stalled_us, report.stalled_us);
      EXPECT_EQ(again.bytes, report.bytes);
    }
  }
}

// FIG. 48B. The link loses nothing: he stands still before the first cell only, and is where he would be had he stood.
TEST(LinkSimulator, WhoIsRegulatedGoesSlowerAndStandsNoMore) {
  const auto route = scene::random_route(town().neighbours(), 20, kSeed);
  constexpr std::uint64_t ahead_us = 500000;
  Link link{4000, 20000, 0, 0, 1};
  std::uint64_t slowed = 0;
  for (const std::uint64_t rate : {200U, 2000U, 4000U, 100000000U}) {
    link.bytes_per_second = rate;
    const auto steady = reference::walk_over(town().store(1), steps_of(route), link, ahead_us);
    const auto regulated = reference::walk_over(town().store(1), steps_of(route), link, ahead_us,
                                                reference::NodeChoice::coarsest, reference::Pace::regulated);
    EXPECT_EQ(text_of(regulated.messages), text_of(steady.messages));
    EXPECT_EQ(regulated.stalls, 0U) << rate;
    EXPECT_EQ(regulated.slowed, steady.stalls);
    EXPECT_GE(regulated.slowed_us, steady.stalled_us);
    EXPECT_EQ(regulated.least_speed<1, regulated.slowed> 0);
    slowed += regulated.slowed;
  }
  EXPECT_GT(slowed, 1U);
  // Packets that are lost are not foreseen, and who hears of it at the face has no way left.
  link = {2000, 20000, 300000, 700000, 7};
  const auto lossy = reference::walk_over(town().store(1), steps_of(route), link, ahead_us,
                                          reference::NodeChoice::coarsest, reference::Pace::regulated);
  EXPECT_GT(lossy.stalls, 0U);
  EXPECT_TRUE(town().judge(lossy.messages).findings.empty());
  link = {2000, 600000, 0, 0, 1};
  const auto far = reference::walk_over(town().store(1), steps_of(route), link, ahead_us,
                                        reference::NodeChoice::coarsest, reference::Pace::regulated);
  EXPECT_EQ(far.slowed, 0U);
  EXPECT_GT(far.stalls, 0U);
}

using Lists = std::vector<std::vector<std::uint32_t>>;

TEST(Worth, DroppingIsAFixpointAndSoundOnEveryRoute) {
  for (const std::size_t most : {0U, 1U, 2U, 100U}) {
    const auto dropped = reference::without_poor_packets(town().lists(), town().neighbours(),
                                                         [most](const auto& plus) { return plus.size() <= most; });
    for (std::uint32_t a = 0; a < dropped.lists.size(); ++a) {
      EXPECT_TRUE(std::includes(dropped.lists[a].begin(), dropped.lists[a].end(), town().lists()[a].begin(),
                                town().lists()[a].end()));
      for (const std::uint32_t b : town().neighbours()[a]) {
        std::vector<std::uint32_t> plus;
        std::set_difference(dropped.lists[b].begin(), dropped.lists[b].end(), dropped.lists[a].begin(),
                            dropped.lists[a].end(), std::back_inserter(plus));
        EXPECT_TRUE(plus.empty() || plus.size() > most);
      }
    }
    const reference::StreamStore store(town().mesh(), dropped.lists, town().neighbours(), 0);
    for (std::uint32_t a = 0; a < dropped.lists.size(); ++a) {
      for (const std::uint32_t b : town().neighbours()[a]) {
        reference::StreamServer server(store);
        std::vector<scene::StreamMessage> all;
        for (const std::uint32_t cell : {a, b}) {
          for (auto& m : server.enter(cell)) all.push_back(std::move(m));
        }
        EXPECT_TRUE(town().judge(all).findings.empty());
      }
    }
    EXPECT_EQ(dropped.given_up == 0, most == 0);
    EXPECT_EQ(dropped.packets_after == 0, most == 100);
  }
}

// Literally (FIG. 33 C, D): the packet of one transition is left out, because the cell before is said to have it, and it
// is added there for this one way only.
TEST(PlantedWorth, HazardA24APacketThatIsDroppedOnOneRouteOnly) {
  std::uint64_t caught = 0;
  for (std::uint32_t a = 0; a < town().lists().size(); ++a) {
    for (const std::uint32_t b : town().neighbours()[a]) {
      auto all = town().stream({a, b}, 0);
      const auto plus = std::find_if(all.begin() + 1, all.end(),
                                     [](const auto& m) { return m.kind == scene::StreamMessage::Kind::plus; });
      if (plus == all.end()) continue;
      all.erase(plus);
      EXPECT_FALSE(town().judge(all).findings.empty());
      ++caught;
    }
  }
  EXPECT_GT(caught, 0U);
}

}  // namespace
}  // namespace clues::test
