// The topic `see-through` of the suite is sharp: who takes panes for walls, leaves them out, or drops what does not count, is found out.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include "fastpath/visibility/see_through.h"
#include "reference/visibility/first_order.h"
#include "validate/conform/grade.h"
#include "validate/see_through/layers.h"
#include "validate/vectors/reader.h"

namespace clues::tests {
namespace {

using Ids = std::vector<std::uint32_t>;
using validate::VectorCase;

Ids first_order(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) {
  return reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell), {}).visible;
}

// How many of the cases end with each outcome.
std::map<validate::Outcome, int> outcomes(const std::function<Ids(const VectorCase&)>& list) {
  std::map<validate::Outcome, int> count;
  for (const auto& c : validate::read_suite(std::filesystem::path(CLUES_SOURCE_DIR) / "vectors")) {
    if (c.is_plain()) continue;
    validate::Answer answer;
    answer.visible = list(c);
    ++count[validate::grade(c, answer).outcome];
  }
  return count;
}

TEST(SeeThroughSuite, BothKernelsAreSound) {
  auto exactly = outcomes([](const VectorCase& c) {
    return validate::visible_in_layers(c.flagged(),
                                       [&](const scene::TriangleMesh& mesh) { return first_order(mesh, c.cell); });
  });
  auto fast = outcomes([](const VectorCase& c) {
    return fastpath::visible_through(fastpath::SeeThroughScene(c.flagged()), c.cell, {}).counting(c.flagged());
  });
  EXPECT_GE(exactly[validate::Outcome::tight], 12);
  EXPECT_EQ(exactly[validate::Outcome::unsound], 0);
  EXPECT_EQ(fast[validate::Outcome::unsound], 0);
}

TEST(SeeThroughSuite, PanesTakenForWallsAreFound) {
  auto walls = outcomes([](const VectorCase& c) { return first_order(c.mesh, c.cell); });
  EXPECT_GE(walls[validate::Outcome::unsound], 7);
}

TEST(SeeThroughSuite, PanesLeftOutAreFound) {
  auto without = outcomes([](const VectorCase& c) {
    const auto ids = scene::blocking_ids(c.flagged());
    Ids visible;
    if (ids.empty()) return visible;
    for (const auto t : first_order(scene::part_of(c.mesh, ids), c.cell)) visible.push_back(ids[t]);
    return visible;
  });
  EXPECT_GE(without[validate::Outcome::unsound], 8);
}

TEST(SeeThroughSuite, HullsLeftOutAreFound) {
  auto without = outcomes([](const VectorCase& c) {
    auto scene = c.flagged();
    Ids ids;
    for (std::uint32_t t = 0; t < c.mesh.triangles.size(); ++t) {
      if (scene.counting(t)) ids.push_back(t);
    }
    Ids visible;
    for (const auto t :
         fastpath::visible_through(fastpath::SeeThroughScene(scene::part_of(scene, ids)), c.cell, {}).all())
      visible.push_back(ids[t]);
    return visible;
  });
  EXPECT_GE(without[validate::Outcome::conservative], 1) << "too much is seen where the hull is gone";
}

}  // namespace
}  // namespace clues::tests
