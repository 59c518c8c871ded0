// What a sight line meets of one piece is what it is said to meet among all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "exact/sight/scene_query.h"
#include "tests/differential/touching_series.h"
#include "tests/seed.h"

namespace clues::tests {
namespace {

using exact::FT;
using exact::Point3;

TEST(SceneQuery, MeetsOfEachPieceWhatCrossingsSayOfIt) {
  std::mt19937_64 random(kSeed);
  std::uint64_t hits = 0, misses = 0, degenerate = 0;
  for (std::uint64_t n = 0; n < 112; ++n) {
    const fuzz::Case scene = touching_scene(kTouchingSeed, n);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    const exact::Complex complex = exact::build_complex(scene.mesh, &cell);
    const exact::SceneQuery query(complex, cell);
    if (complex.pieces.empty()) continue;
    // Every occluder: what no box excludes.
    const auto occluders = query.candidates([](const CGAL::Bbox_3&) { return true; });
    for (int i = 0; i < 30; ++i) {
      std::vector<int> weights;
      for (std::size_t k = 0; k < cell.vertices().size(); ++k) weights.push_back(1 + static_cast<int>(random() % 9));
      const Point3 v = cell.interior_point(weights);
      // Short weights, so that lines go through corners and edges, too.
      const auto& c = complex.pieces[random() % complex.pieces.size()].corners;
      const int a = static_cast<int>(random() % 3), b = static_cast<int>(random() % 3);
      const Point3 p = CGAL::barycenter(complex.points[c[0]], FT(a), complex.points[c[1]], FT(b), complex.points[c[2]],
                                        FT(a + b == 0 ? 1 : static_cast<int>(random() % 3)));
      if (p == v) continue;
      const exact::SegmentAnswer answer = query.crossings(v, p);
      if (answer.degenerate && answer.at) {
        EXPECT_TRUE(query.meets(v, p, *answer.at));
        ++degenerate;
      }
      if (answer.degenerate) continue;
      for (const std::uint32_t t : occluders) {
        const bool is_hit =
            std::any_of(answer.hits.begin(), answer.hits.end(), [&](const auto& h) { return h.piece == t; });
        EXPECT_EQ(query.meets(v, p, t), is_hit) << "scene " << n << ", piece " << t;
        ++(is_hit ? hits : misses);
      }
    }
  }
  EXPECT_GT(hits, 200U);
  EXPECT_GT(misses, 1000U);
  EXPECT_GT(degenerate, 100U);
}

}  // namespace
}  // namespace clues::tests
