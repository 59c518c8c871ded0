#include "tests/delta/identities.h"

#include <gtest/gtest.h>

#include <iostream>

#include "fuzz/trials/deltas_trial.h"
#include "reference/delta/delta.h"
#include "reference/visibility/first_order.h"
#include "validate/stream/judge_delta.h"

namespace clues::test {

validate::DeltaRecord expect_identities(const scene::TriangleMesh& mesh, const exact::ConvexCell& a,
                                        const exact::ConvexCell& b, const reference::Options& options,
                                        TransitionSums& sums) {
  const auto map_a = fuzz::map_file_of(reference::first_order_visibility(mesh, a, options)),
             map_b = fuzz::map_file_of(reference::first_order_visibility(mesh, b, options));
  const auto there = validate::record_of(reference::delta_of(mesh, a, b, options), true),
             back = validate::record_of(reference::delta_of(mesh, b, a, options), true);
  const auto verdict = validate::judge_delta(mesh, there, map_a, map_b);
  for (const auto& f : verdict.findings) ADD_FAILURE() << "there: " << f.what;
  const auto verdict_back = validate::judge_delta(mesh, back, map_b, map_a);
  for (const auto& f : verdict_back.findings) ADD_FAILURE() << "back: " << f.what;
  for (const auto& f : validate::judge_reverse(there, back)) ADD_FAILURE() << f.what;
  EXPECT_EQ(verdict.exposed, verdict_back.occluded);
  ++sums.transitions;
  sums.sides += verdict.sides;
  sums.exposed += sgn(verdict.exposed) != 0 ? 1U : 0U;
  sums.occluded += sgn(verdict.occluded) != 0 ? 1U : 0U;
  sums.packets += there.plus.empty() && there.minus.empty() ? 0U : 1U;
  return there;
}

void expect_identities_of_halves(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                 const reference::Options& options, TransitionSums& sums) {
  const auto halves = fuzz::halves_of(cell);
  if (halves.empty()) return;
  expect_identities(mesh, halves[0], halves[1], options, sums);
  if (sums.transitions % 4 == 0) expect_identities(mesh, cell, halves[0], options, sums);
}

void expect_seen_something(const TransitionSums& sums) {
  std::cout << sums.transitions << " transitions, " << sums.sides << " sides; " << sums.exposed
            << " with newly visible parts, " << sums.occluded << " with newly hidden ones, " << sums.packets
            << " with packets\n";
  EXPECT_GT(sums.exposed, 0U);
  EXPECT_GT(sums.occluded, 0U);
  EXPECT_GT(sums.packets, 0U);
}

}  // namespace clues::test
