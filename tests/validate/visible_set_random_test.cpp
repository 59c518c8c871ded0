// The exact visible set (D6) on random scenes against everything else that knows something about them: confirmed witnesses, the
// first-order map (T1), and itself with the search in another order.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "fuzz/generators/random_scenes.h"
#include "validate/judge.h"
#include "validate/visible_set.h"

namespace clues::validate {
namespace {

struct Counters {
  std::uint64_t scenes = 0, triangles = 0, visible = 0, hidden = 0, meet_cell = 0;
  std::uint64_t in_omega_but_hidden = 0, found_by_edge = 0, edge_first_found_by_edge = 0;
  std::uint64_t windows = 0, questions = 0;
  double seconds = 0, worst = 0;
  std::string slowest;
};

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void examine(const fuzz::GeneratedScene& scene, bool both_orders, Counters& total) {
  SCOPED_TRACE(scene.name);
  const auto cell = exact::ConvexCell::from_doubles(scene.cell);
  VisibleSetOptions options;
  options.trust_map = false;
  const double begin = seconds();
  const VisibleSet set = exact_visible_set(scene.mesh, cell, options);
  const double used = seconds() - begin;
  total.seconds += used;
  if (used > total.worst) {
    total.worst = used;
    total.slowest = scene.name + " (" + std::to_string(scene.mesh.triangles.size()) + " triangles)";
  }
  const auto map = reference::first_order_visibility(scene.mesh, cell, {});
  std::vector<std::uint32_t> all(scene.mesh.triangles.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  const Judgement judged = judge_pvs(scene.mesh, map, all);
  ASSERT_TRUE(judged.contradictions.empty());
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    const TriangleSight& answer = set.triangles[t];
    const bool in_omega = std::binary_search(map.visible.begin(), map.visible.end(), t);
    const bool witnessed = judged.triangles[t] == TriangleVerdict::exact;
    ASSERT_TRUE(answer.sight == Sight::visible || answer.sight == Sight::hidden) << t;
    EXPECT_TRUE(!witnessed || answer.sight == Sight::visible) << t;
    EXPECT_TRUE(in_omega || answer.sight == Sight::hidden) << t;
    EXPECT_EQ(answer.sight == Sight::visible, answer.meets_cell || answer.witness.has_value()) << t;
    total.visible += answer.sight == Sight::visible ? 1 : 0;
    total.hidden += answer.sight == Sight::hidden ? 1 : 0;
    total.meet_cell += answer.meets_cell ? 1 : 0;
    total.in_omega_but_hidden += answer.sight == Sight::hidden && in_omega ? 1 : 0;
  }
  total.found_by_edge += set.statistics.found_by_edge;
  total.windows += set.statistics.windows;
  total.questions += set.statistics.point_questions;
  ++total.scenes;
  total.triangles += all.size();
  if (!both_orders) return;
  options.points_first = false;
  const VisibleSet again = exact_visible_set(scene.mesh, cell, options);
  total.edge_first_found_by_edge += again.statistics.found_by_edge;
  for (std::uint32_t t = 0; t < all.size(); ++t) EXPECT_EQ(again.triangles[t].sight, set.triangles[t].sight) << t;
}

void print(const char* name, const Counters& c) {
  std::cout << name << ": " << c.scenes << " scenes, " << c.triangles << " triangles: " << c.visible << " visible ("
            << c.meet_cell << " meet the cell), " << c.hidden << " hidden of which " << c.in_omega_but_hidden
            << " in Omega; found by edges: " << c.found_by_edge << " after the points, " << c.edge_first_found_by_edge
            << " before them; " << c.windows << " windows, " << c.questions << " points; " << c.seconds
            << " s, slowest " << c.worst << " s: " << c.slowest << "\n";
}

Counters examine_kind(fuzz::Kind kind, std::uint64_t seed, int count, std::size_t most_triangles, bool both_orders) {
  Counters total;
  for (std::uint64_t i = 0; total.scenes < static_cast<std::uint64_t>(count); ++i) {
    const auto scene = fuzz::generate(kind, seed, i);
    if (scene.mesh.triangles.size() > most_triangles) continue;
    examine(scene, both_orders, total);
    if (testing::Test::HasFailure()) break;
  }
  print(fuzz::name_of(kind), total);
  return total;
}

class VisibleSetRandom : public testing::TestWithParam<fuzz::Kind> {};

TEST_P(VisibleSetRandom, AgreesWithWitnessesAndTheMap) {
  const char* seed = std::getenv("CLUES_SEED");
  const char* count = std::getenv("CLUES_COUNT");
  const char* most = std::getenv("CLUES_MOST");
  examine_kind(GetParam(), seed ? std::strtoull(seed, nullptr, 10) : 20261121, count ? std::atoi(count) : 3,
               most ? std::strtoull(most, nullptr, 10) : 24, true);
}

INSTANTIATE_TEST_SUITE_P(Kinds, VisibleSetRandom, testing::ValuesIn(fuzz::all_kinds),
                         [](const auto& kind) { return fuzz::name_of(kind.param); });

}  // namespace
}  // namespace clues::validate
