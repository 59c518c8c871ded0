// Linked with a reference in which parts of edges wait for each other in a circle (plant.py, T12): `clues check` believed it, as what is hidden was hidden by the word of
// the map that was judged. The judge looks for itself (light_search.h).
#include <gtest/gtest.h>

#include <algorithm>

#include "fuzz/oracles/oracle.h"
#include "fuzz/subjects/subject.h"
#include "reference/visibility/first_order.h"
#include "validate/vectors/reader.h"
#include "validate/verdicts/judge.h"

namespace clues::test {
namespace {

TEST(CirclesWait, IsContradictedByTheJudge) {
  std::size_t irises = 0, missed = 0;
  for (const auto& c : validate::read_suite(CLUES_SOURCE_DIR "/vectors")) {
    if (c.id.find("iris") == c.id.npos) continue;
    SCOPED_TRACE(c.id);
    ++irises;
    const auto map = reference::first_order_visibility(c.mesh, exact::ConvexCell::from_doubles(c.cell), {});
    for (const auto& seen : c.expect->must_be_visible) {
      if (std::binary_search(map.visible.begin(), map.visible.end(), seen.triangle)) continue;
      ++missed;
      const auto judgement = validate::judge_pvs(c.mesh, map, map.visible);
      EXPECT_EQ(judgement.verdict, validate::Verdict::unsound);
      EXPECT_TRUE(std::any_of(judgement.contradictions.begin(), judgement.contradictions.end(),
                              [&](const auto& w) { return w.triangle == seen.triangle; }));
    }
  }
  EXPECT_GE(irises, 5U);
  EXPECT_GE(missed, 5U);
}

// And a vertex more on an edge, which the parts of that edge do not wait beyond, changes its list.
TEST(CirclesWait, IsNoticedByVerticesMore) {
  std::size_t noticed = 0;
  for (const auto& c : validate::read_suite(CLUES_SOURCE_DIR "/vectors")) {
    if (c.id.find("iris") == c.id.npos) continue;
    for (std::uint64_t i = 0; i < 40; ++i) {
      const auto outcome = fuzz::judge_case({"irises", 7, i, c.mesh, c.cell, false}, *fuzz::make_subject("reference"),
                                            fuzz::oracles_named({"metamorphic"}));
      for (const auto& f : outcome.findings) {
        if (f.verdict == "answer/other-answer" && f.explanation.find("vertices more") != f.explanation.npos) ++noticed;
      }
    }
  }
  EXPECT_GT(noticed, 0U);
}

}  // namespace
}  // namespace clues::test
