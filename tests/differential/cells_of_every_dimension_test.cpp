// D3, D6, D10, D12, D17 with view cells of every dimension, in small scenes whose geometry meets the cell: what both kernels call hidden is seen from nowhere, with
// any dials. As many scenes as one has time for, from any:
//   CLUES_LONG=1 CLUES_SCENES=50000 CLUES_FROM=0 clues_differential_tests --gtest_filter='CellsOfEveryDimensionLong.NothingHiddenIsSeen'
// CLUES_SEED takes other scenes, with CLUES_NO_FALLBACKS=1 a fallback is a flaw; series.h has the other variables. About one scene in a thousand is too much for the
// plain reference. With CLUES_LIMITED=1 all kernels have short walks and few CSVs, with CLUES_ONLY_FAST=1 the fast path is asked alone, as it is.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "tests/differential/touching_series.h"

namespace clues::tests {
namespace {

const std::map<std::string, std::uint64_t> none;

// Without a fallback, where that is asked: about one scene in twenty still has one. The other formulation of the
// reference, which is the slowest of the kernels, is asked in one scene of eight where the series is long.
void nothing_hidden_is_seen(std::uint64_t from, std::uint64_t scenes, bool no_fallbacks) {
  const bool only_fast = number_from("CLUES_ONLY_FAST", 0) != 0;
  const auto scene = [limited = number_from("CLUES_LIMITED", 0) != 0](std::uint64_t seed, std::uint64_t n) {
    fuzz::Case made = touching_scene(seed, n);
    if (limited) made.dials = {{"longest_walk", 4}, {"csv_limit", 20}, {"generation_limit", 1}};
    return made;
  };
  const Series series{number_from("CLUES_SEED", kTouchingSeed), scene, [=](std::uint64_t n) {
                        JudgeSettings settings;
                        settings.visible_set = n % 10 == 0;
                        settings.no_fallbacks = no_fallbacks;
                        if (scenes > 100 && n % 8 != n / 8 % 8) settings.kernels = {"plain reference", "fast path"};
                        if (only_fast) settings.kernels = {"fast path"};
                        return settings;
                      }};
  const Totals totals = judge_series(series, from, scenes);
  EXPECT_EQ(totals.flaws, none);
  if (scenes < 100) return;
  for (const char* what : {"hidden points put to the oracle", "sight lines to hidden points",
                           "sight lines to triangles that are not listed", "scenes whose areas were compared",
                           "scenes decided completely"})
    EXPECT_EQ(totals.counts.count(what), 1U) << what;
}

void limits_hide_nothing(std::uint64_t from, std::uint64_t scenes) {
  const Totals totals = judge_series(limited_series(), from, scenes);
  EXPECT_EQ(totals.flaws, none);
  if (scenes < 100) return;
  for (const char* kernel : {"plain reference", "traversal", "fast path"})
    EXPECT_EQ(totals.counts.count(std::string("scenes with fallbacks of ") + kernel), 1U) << kernel;
}

TEST(CellsOfEveryDimension, NothingHiddenIsSeen) { nothing_hidden_is_seen(0, 56, false); }
TEST(CellsOfEveryDimension, LimitsHideNothing) { limits_hide_nothing(0, 28); }

TEST(CellsOfEveryDimensionLong, NothingHiddenIsSeen) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  nothing_hidden_is_seen(number_from("CLUES_FROM", 0), number_from("CLUES_SCENES", 5000),
                         number_from("CLUES_NO_FALLBACKS", 0) != 0);
}

TEST(CellsOfEveryDimensionLong, LimitsHideNothing) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  limits_hide_nothing(number_from("CLUES_FROM", 0), number_from("CLUES_SCENES", 2000));
}

}  // namespace
}  // namespace clues::tests
