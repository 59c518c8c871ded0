// A judgement without `undecided`: in the cases of the suite in which something is in Omega and yet hidden, the exhaustive search says so of every triangle.
#include "validate/visible_set/settle.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <set>

#include "reference/visibility/first_order.h"
#include "validate/vectors/reader.h"
#include "validate/verdicts/measures.h"

namespace clues::validate {
namespace {

TEST(Settle, NothingStaysUndecidedInTheSuite) {
  std::size_t cases = 0, settled = 0;
  for (const VectorCase& c : read_suite(std::filesystem::path(CLUES_SOURCE_DIR) / "vectors")) {
    if (!c.is_plain()) continue;
    std::set<std::uint32_t> hidden_in_omega;
    for (const Umbra& u : c.expect->umbra) {
      if (u.proof == UmbraProof::exhaustive) hidden_in_omega.insert(u.triangle);
    }
    if (hidden_in_omega.empty()) continue;
    SCOPED_TRACE(c.id);
    ++cases;
    reference::Options options;
    options.mode = c.mode == CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet;
    const auto cell = exact::ConvexCell::from_doubles(c.cell);
    const auto map = reference::first_order_visibility(c.mesh, cell, options);

    // A PVS without them is undecided by the map alone, and sound.
    std::vector<std::uint32_t> all(c.mesh.triangles.size()), tight;
    std::iota(all.begin(), all.end(), 0U);
    for (const std::uint32_t t : all) {
      if (!hidden_in_omega.contains(t)) tight.push_back(t);
    }
    Judgement judged = judge_pvs(c.mesh, map, tight);
    EXPECT_EQ(judged.verdict, Verdict::undecided);
    settle(judged, c.mesh, cell, options.mode);
    EXPECT_EQ(judged.verdict, Verdict::sound);
    EXPECT_EQ(std::set<std::uint32_t>(judged.proved_hidden.begin(), judged.proved_hidden.end()), hidden_in_omega);

    // Listed they are no more in doubt either, and count as too much.
    judged = judge_pvs(c.mesh, map, all);
    settle(judged, c.mesh, cell, options.mode);
    EXPECT_EQ(judged.first_order, judged.proved_hidden.size());
    const Weights weights = count_weights(judged);
    EXPECT_EQ(weights.undecided_listed, 0);
    EXPECT_EQ(weights.hidden_listed, static_cast<double>(judged.loose + judged.proved_hidden.size()));
    settled += judged.proved_hidden.size();
  }
  EXPECT_GE(cases, 5U);
  EXPECT_GE(settled, 15U);
}

}  // namespace
}  // namespace clues::validate
