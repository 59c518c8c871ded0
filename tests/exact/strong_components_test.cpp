// Strong components of graphs whose arcs lead to ranges of nodes are those of the same graphs with every arc written out.
#include "exact/strong_components.h"

#include <gtest/gtest.h>

#include "fuzz/generators/random.h"

namespace clues::tests {
namespace {

using Arcs = std::vector<std::vector<std::uint32_t>>;
using Ranges = std::vector<std::vector<exact::NodeRange>>;

TEST(StrongComponents, KnownCircles) {
  EXPECT_EQ(exact::circles_of(Arcs{{1}, {2}, {0}, {0}}), (Arcs{{0, 1, 2}}));
  EXPECT_EQ(exact::circles_of(Ranges{{{1, 3}}, {}, {{3, 4}}, {{0, 1}}}), (Arcs{{0, 2, 3}}));
  EXPECT_EQ(exact::circles_of(Ranges{}), Arcs{});
  EXPECT_EQ(exact::circles_of(Ranges{{{0, 0}}}), Arcs{}) << "a range may be empty";
}

TEST(StrongComponents, OfRangesAreThoseOfArcs) {
  fuzz::Random random(20261125);
  std::size_t circles = 0, without = 0, inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::uint32_t n = 1 + static_cast<std::uint32_t>(random.next() % 40);
    Ranges ranges(n);
    Arcs arcs(n);
    const std::uint64_t count = random.next() % (2 + n / 2);
    for (std::uint64_t k = 0; k < count; ++k) {
      const auto from = static_cast<std::uint32_t>(random.next() % n),
                 begin = static_cast<std::uint32_t>(random.next() % n);
      const std::uint32_t end = begin + static_cast<std::uint32_t>(random.next() % (n - begin + 1));
      ranges[from].push_back({begin, end});
      for (std::uint32_t to = begin; to < end; ++to) arcs[from].push_back(to);
    }
    const Arcs found = exact::circles_of(ranges);
    EXPECT_EQ(found, exact::circles_of(arcs)) << "graph " << i;
    circles += found.size();
    without += found.empty() ? 1 : 0;
    for (const auto& circle : found) inside += circle.size() < n ? 1 : 0;
  }
  EXPECT_GT(circles, 500);
  EXPECT_GT(without, 200);
  EXPECT_GT(inside, 200);
}

}  // namespace
}  // namespace clues::tests
