// What the search for a local map is told (D4, D17), and what it counts.
#pragma once

#include <algorithm>
#include <cstdint>

#include "exact/dials.h"

namespace clues::fastpath {

enum class SideMode : std::uint8_t { sheet, solid };  // D4

// What making a map throws that would take more effort than it was given.
struct EffortSpent {};

struct LocalMapOptions {
  SideMode mode = SideMode::sheet;  // solid: only fronts count. That the mesh is closed is for the caller to know.
  exact::Dials dials;               // the limits of D17, and what else only tests turn
  // How much effort a map may take for each of its triangles, which count as kLeastTriangles if they are fewer; beyond that EffortSpent is thrown. 0: without end.
  // A wedge piece of generation g that was not there in the round before takes (1 + g)^2 when light makes it, and again when the pieces of the round are joined, as the numbers that decide about it grow with g. If
  // it comes of what counts as visible for want of a proof, that is kInDoubt or kInMuchDoubt times as much, as this light seldom has an end. Most maps take 5 to 50. What is built again from round to round is free.
  // No time is taken, so it is the same in every run. Only lists honour it (visible_through): regions need a map that was made to its end.
  std::uint64_t effort = 0;
  static constexpr std::uint64_t kLeastTriangles = 512, kInDoubt = 4, kInMuchDoubt = 32;
  // Effort bounds the CSVs, too, and where some are left out light may come from all around them: where this is set the limit of D17 is so many times as large. What is in doubt then costs
  // kInMuchDoubt, as hardly any CSV that was left out makes it so.
  bool csvs_by_effort = false;
  static constexpr std::size_t kCsvsByEffort = 8;
};

// What is given up is made again, most often of another part (closure.h, engine_part.cpp). In most levels that succeeds, with lists a few hundredths longer; so little is spent before. The next
// try succeeds with a third of the effort, or, with few exceptions, not at all. PartStage::least has all of it.
inline constexpr double kFirstTry = 1.0 / 16, kNextTry = 2.0 / 5;
inline std::uint64_t part_of_effort(std::uint64_t effort, double part) {
  return effort == 0 ? 0 : std::max<std::uint64_t>(1, static_cast<std::uint64_t>(static_cast<double>(effort) * part));
}
inline std::uint64_t effort_of_first_try(std::uint64_t effort) { return part_of_effort(effort, kFirstTry); }
inline std::uint64_t effort_of_next_try(std::uint64_t effort) { return part_of_effort(effort, kNextTry); }

// The same for a part of the scene that has grown out of a first one. Where it has grown to much more than that, light leaks into most of the scene,
// and hardly any such map comes to an end: a part gets effort for its triangles, but for no more than kGrowth times those of the first. (Not one that began with all that counts: little leaks from that.)
inline constexpr std::uint64_t kGrowth = 3;
inline std::uint64_t effort_of_part(std::uint64_t effort, std::uint64_t triangles, std::uint64_t first) {
  const std::uint64_t most = kGrowth * std::max(first, LocalMapOptions::kLeastTriangles);
  return effort == 0 || triangles <= most ? effort : std::max<std::uint64_t>(1, effort * most / triangles);
}

struct LocalMapCounts {
  std::uint64_t pieces = 0, refined_triangles = 0;    // of the complex (D16)
  std::uint64_t sources = 0, apexes = 0, wedges = 0;  // contour edge parts, contour vertices looked at, envelopes made
  std::uint64_t csv = 0, rounds = 0, walks = 0;       // D12, D17a, D14
  std::uint64_t exact_decisions = 0;                  // made in rationals
  std::uint64_t conservative_fallbacks = 0;           // answered visible without a proof
};

}  // namespace clues::fastpath
