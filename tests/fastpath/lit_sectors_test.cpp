// Which sectors exist: LitSectors remembers what it has found, and asks in intervals first. Neither may change an answer.
#include "fastpath/visibility/wedges/lit_sectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/dials.h"
#include "fastpath/visibility/wedges/contour.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/generators/parts.h"

namespace clues::tests {
namespace {

using fastpath::Probe;
using Sectors = std::vector<std::uint32_t>;

// A mesh vertex with what may light it: sight lines to all parts of V that it sees, and along its contour edges.
struct Vertex {
  fastpath::Apex apex;
  std::vector<fastpath::ExactPoint> views;
  std::vector<const fastpath::Plane*> planes;
  std::vector<Probe> probes;
};

Sectors asked_anew(const fastpath::LocalScene& scene, const Vertex& vertex, const std::vector<Probe>& probes) {
  return fastpath::LitSectors(scene, vertex.apex, vertex.planes).existing(probes);
}

struct Judged {
  std::size_t sets = 0, sectors = 0, left_out = 0, reached = 0;
  std::uint64_t in_whole_numbers = 0;  // of what was asked anew of all probes of a vertex
};

void judge(const fuzz::Case& c, Judged& judged) {
  const fastpath::RoundedUp rounded_up;
  const fastpath::LocalScene scene(c.mesh, exact::ConvexCell::from_doubles(c.cell));
  fastpath::Workers workers(scene);
  fastpath::Pool pool;
  const auto contours = fastpath::contour_edges(scene, workers);
  for (std::uint32_t v = 0; v < scene.points.size(); ++v) {
    if (scene.point_pieces[v].empty()) continue;
    Vertex vertex{fastpath::Apex(scene, pool, false, v, &scene.points[v]), {}, {}, {}};
    if (vertex.apex.sectors().empty()) continue;
    const std::vector<double> equal(scene.cell.vertices.size(), 1);
    vertex.views = vertex.apex.views_of_cell(scene.cell.combination({equal.begin(), equal.end()}));
    for (const auto& p : vertex.views)
      vertex.probes.push_back({Probe::Kind::sight, &p, {}, nullptr, 0, nullptr, false});
    for (const auto& contour : contours) {
      const auto& edge = scene.edges[contour.edge];
      if (contour.holds_cell || (edge.a != v && edge.b != v)) continue;
      const std::uint32_t to = edge.a == v ? edge.b : edge.a;
      vertex.planes.push_back(contour.plane);
      vertex.probes.push_back({Probe::Kind::contour,
                               &scene.points[to],
                               {fastpath::SpotName::Kind::vertex, to},
                               contour.plane,
                               0,
                               nullptr,
                               vertex.probes.size() % 3 == 2});
    }
    fastpath::LitSectors growing(scene, vertex.apex, vertex.planes);
    std::vector<Probe> probes;
    for (const Probe& probe : vertex.probes) {
      probes.push_back(probe);
      const Sectors now = growing.existing(probes);
      ASSERT_EQ(now, asked_anew(scene, vertex, probes)) << c.generator << " " << c.index << ", vertex " << v;
      ++judged.sets;
      judged.sectors += now.size();
      judged.left_out += vertex.apex.sectors().size() - now.size();
      // Where nothing is left out, for which any direction of a sector may stand, whole numbers say the same.
      std::vector<Probe> doubtful = probes;
      for (Probe& p : doubtful) p.doubtful = true;
      const Sectors by_intervals = asked_anew(scene, vertex, doubtful);
      {
        const exact::TurnedProcessDials turned({.unsure_intervals = true});
        ASSERT_EQ(by_intervals, asked_anew(scene, vertex, doubtful))
            << c.generator << " " << c.index << ", vertex " << v;
      }
      judged.reached += by_intervals.size();
      std::reverse(probes.begin(), probes.end());
      ASSERT_EQ(now, growing.existing(probes));
      ASSERT_EQ(now, asked_anew(scene, vertex, probes));
      std::reverse(probes.begin(), probes.end());
    }
    const std::uint64_t before = fastpath::exact_decisions();
    asked_anew(scene, vertex, vertex.probes);
    judged.in_whole_numbers += fastpath::exact_decisions() - before;
    // What was asked of more probes does not spoil the answer for few.
    for (const Probe& probe : vertex.probes) ASSERT_EQ(growing.existing({probe}), asked_anew(scene, vertex, {probe}));
  }
}

TEST(LitSectors, AreTheSameWhateverWasAskedBeforeAndInWholeNumbers) {
  const fuzz::GivenScenes none;
  Judged judged;
  for (const auto& generator : fuzz::generators_named({}, none)) {
    const fuzz::Case c = generator.make(20261127, 0);
    if (c.mesh.triangles.size() <= 60) judge(c, judged);
  }
  EXPECT_GT(judged.sets, 500U);
  EXPECT_GT(judged.sectors, 500U);
  EXPECT_GT(judged.left_out, 500U);
  EXPECT_GT(judged.reached, judged.sectors);
}

// Boxes that stand askew: a side's two triangles are in one plane but for roundings, and intervals do not tell on which side of the one the other is.
fuzz::Case askew_boxes() {
  fuzz::Case c;
  c.generator = "askew boxes";
  c.cell = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  for (const double turn : {0.3, 0.7, 1.1, 1.3}) {
    const scene::TriangleMesh box =
        fuzz::closed_box({3 + 4 * turn, -1 - turn, -0.5}, {4.1 + 4 * turn, 1.2, 1.7 + turn});
    const auto first = static_cast<std::uint32_t>(c.mesh.points.size());
    for (const scene::Point& p : box.points) {
      const double x = p[0] * std::cos(turn) - p[1] * std::sin(turn), y = p[0] * std::sin(turn) + p[1] * std::cos(turn);
      c.mesh.points.push_back({x, y * std::cos(0.2) - p[2] * std::sin(0.2), y * std::sin(0.2) + p[2] * std::cos(0.2)});
    }
    for (const scene::Triangle& t : box.triangles)
      c.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return c;
}

TEST(LitSectors, OfAskewBoxesAreNotAskedForEachSignInWholeNumbers) {
  Judged judged;
  const fuzz::Case c = askew_boxes();
  judge(c, judged);
  EXPECT_GT(judged.sectors, 50U);
  EXPECT_GT(judged.left_out, 50U);
  EXPECT_LT(judged.in_whole_numbers, 4 * judged.sets);  // 3.6; they were 5 where each sign was asked for
}

}  // namespace
}  // namespace clues::tests
