// The exact visible set (D6) on random scenes against everything else that knows something about them: confirmed witnesses, the
// first-order map (T1), and itself with the search in another order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>

#include "exact/sight/witness.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "validate/verdicts/judge.h"
#include "validate/visible_set/visible_set.h"

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

// Random sight lines that prove the triangle visible after all.
std::uint64_t free_lines(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, std::uint32_t t, int tries) {
  fuzz::Random random(t);
  const auto corner = [&](std::size_t i) { return exact::to_exact(mesh.points[mesh.triangles[t][i]]); };
  std::uint64_t found = 0;
  for (int i = 0; i < tries; ++i) {
    std::vector<int> weights;
    for (std::size_t k = 0; k < cell.vertices().size(); ++k) weights.push_back(random.between(1, 100));
    const auto weight = [&] { return exact::FT(random.between(1, 100)); };
    const auto p = exact::collapsed(CGAL::barycenter(corner(0), weight(), corner(1), weight(), corner(2), weight()));
    const auto v = exact::collapsed(cell.interior_point(weights));
    for (const bool front : {true, false}) found += exact::check_witness(mesh, cell, t, front, v, p).valid ? 1 : 0;
  }
  return found;
}

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
  std::vector<std::uint32_t> all(scene.mesh.triangles.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  std::vector<std::uint32_t> in_omega = all;
  Judgement judged;
  if (cell.dimension() > 0) {  // the map finds no sight lines in general position from every single point
    const auto map = reference::first_order_visibility(scene.mesh, cell, {});
    in_omega = map.visible;
    JudgeOptions judge_options;
    judge_options.points_per_region = 4;
    judged = judge_pvs(scene.mesh, map, all, judge_options);
    ASSERT_TRUE(judged.contradictions.empty());
  }
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    const TriangleSight& answer = set.triangles[t];
    const bool omega = std::binary_search(in_omega.begin(), in_omega.end(), t);
    const bool witnessed = !judged.triangles.empty() && judged.triangles[t] == TriangleVerdict::exact;
    ASSERT_TRUE(answer.sight == Sight::visible || answer.sight == Sight::hidden) << t;
    EXPECT_TRUE(!witnessed || answer.sight == Sight::visible) << t;
    EXPECT_TRUE(omega || answer.sight == Sight::hidden) << t;
    EXPECT_EQ(answer.sight == Sight::visible, answer.meets_cell || answer.witness.has_value()) << t;
    total.visible += answer.sight == Sight::visible ? 1 : 0;
    total.meet_cell += answer.meets_cell ? 1 : 0;
    if (answer.sight != Sight::hidden) continue;
    ++total.hidden;
    total.in_omega_but_hidden += omega && cell.dimension() > 0 ? 1 : 0;
    EXPECT_EQ(free_lines(scene.mesh, cell, t, 8), 0U) << t;
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

// What the cell is made to be: as generated, fewer of its corners, or moved among the triangles (D3).
enum class CellKind { generated, polygon, segment, point, amid };

fuzz::GeneratedScene with_cell(fuzz::GeneratedScene scene, CellKind kind) {
  auto& c = scene.cell;
  if (kind == CellKind::polygon) c.resize(3);
  if (kind == CellKind::segment) c = {c.front(), c.back()};
  if (kind == CellKind::point) c.resize(1);
  if (kind == CellKind::amid) {
    for (auto& corner : c) corner[0] += 4;
  }
  return scene;
}

Counters examine_kind(fuzz::Kind kind, CellKind cell, std::uint64_t seed, int count, std::size_t most_triangles,
                      bool both_orders) {
  Counters total;
  for (std::uint64_t i = 0; total.scenes < static_cast<std::uint64_t>(count); ++i) {
    const auto scene = with_cell(fuzz::generate(kind, seed, i), cell);
    if (scene.mesh.triangles.size() > most_triangles) continue;
    examine(scene, both_orders, total);
    if (testing::Test::HasFailure()) break;
  }
  print(fuzz::name_of(kind), total);
  return total;
}

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// Together the kinds must have shown every way to an answer, or the test shows nothing.
void run(CellKind cell, int count, std::size_t most_triangles, bool both_orders, bool demand_all) {
  const std::uint64_t seed = number_from("CLUES_SEED", 20261121);
  std::cout << "seed " << seed << " (CLUES_SEED)\n";
  Counters all;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    const Counters c = examine_kind(kind, cell, seed, count, most_triangles, both_orders);
    if (testing::Test::HasFailure()) return;
    all.visible += c.visible;
    all.hidden += c.hidden;
    all.meet_cell += c.meet_cell;
    all.in_omega_but_hidden += c.in_omega_but_hidden;
    all.found_by_edge += c.found_by_edge;
  }
  EXPECT_GT(all.visible, all.meet_cell);
  EXPECT_GT(all.hidden, 0U);
  EXPECT_TRUE(cell != CellKind::amid || all.meet_cell > 0);
  if (!demand_all) return;
  // Triangles in Omega that are hidden all the same are rare here: see the keyhole, and the cases of the suite.
  EXPECT_GT(all.found_by_edge, 0U);
}

// CLUES_COUNT: so many scenes of each kind instead.
void run_long(CellKind cell, int count, bool demand_all) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  run(cell, static_cast<int>(number_from("CLUES_COUNT", static_cast<std::uint64_t>(count))), 60, true, demand_all);
}

TEST(VisibleSetRandom, AgreesWithWitnessesAndTheMap) { run(CellKind::generated, 2, 22, true, true); }
TEST(VisibleSetRandom, CellAmidTheTriangles) { run(CellKind::amid, 1, 22, true, false); }
TEST(VisibleSetRandom, FlatCell) { run(CellKind::polygon, 1, 22, true, false); }
TEST(VisibleSetRandom, SegmentAsCell) { run(CellKind::segment, 1, 22, true, false); }
TEST(VisibleSetRandom, PointAsCell) { run(CellKind::point, 1, 22, true, false); }

TEST(VisibleSetRandomLong, AgreesWithWitnessesAndTheMap) { run_long(CellKind::generated, 40, true); }
TEST(VisibleSetRandomLong, CellAmidTheTriangles) { run_long(CellKind::amid, 20, true); }
TEST(VisibleSetRandomLong, FlatCell) { run_long(CellKind::polygon, 20, true); }
TEST(VisibleSetRandomLong, SegmentAsCell) { run_long(CellKind::segment, 20, true); }
TEST(VisibleSetRandomLong, PointAsCell) { run_long(CellKind::point, 20, false); }

// Figures for docs/visible-set.md: processor time without the map, scenes by their number of triangles.
TEST(VisibleSetFiguresLong, TimePerScene) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (const std::size_t size : {10, 20, 40, 60}) {
      double total = 0, worst = 0;
      std::uint64_t scenes = 0;
      for (std::uint64_t i = 0; i < 400 && scenes < 8; ++i) {
        const auto scene = fuzz::generate(kind, 1, i);
        const std::size_t n = scene.mesh.triangles.size();
        if (n + size / 8 < size || n > size + size / 8) continue;
        VisibleSetOptions options;
        options.trust_map = false;
        const double begin = seconds();
        exact_visible_set(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
        const double used = seconds() - begin;
        total += used;
        worst = std::max(worst, used);
        ++scenes;
      }
      if (scenes == 0) continue;  // the generator makes none of this size
      std::cout << fuzz::name_of(kind) << ", about " << size << " triangles: " << scenes << " scenes, mean "
                << total / static_cast<double>(scenes) << " s, worst " << worst << " s\n";
    }
  }
}

}  // namespace
}  // namespace clues::validate
