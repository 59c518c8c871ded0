// D3, D5: every answer of the tree against one that knows no tree and no filter.
#include "fastpath/queries/segment_queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bvh_tamperer.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random_scenes.h"
#include "oracle.h"
#include "scene/messages/error.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

// Answers that differ from the oracle's, in `segments` aimed segments. A query that finds out that it contradicted itself is wrong, too.
int wrong_answers(const scene::TriangleMesh& mesh, const Bvh& bvh, std::uint64_t seed, int segments,
                  SegmentCounts* counts = nullptr) {
  fuzz::Random random(seed);
  SegmentQueries queries(bvh);
  int wrong = 0;
  for (int i = 0; i < segments; ++i) {
    const Segment s = aimed_segment(mesh, random);
    const auto expected = oracle_all_hits(s, mesh);
    try {
      wrong += queries.all_hits(s) != expected ? 1 : 0;
      wrong += queries.any_hit(s) == expected.empty() ? 1 : 0;
      wrong += queries.first_hit(s) != oracle_first_hit(s, mesh) ? 1 : 0;
      if (!expected.empty()) {
        const std::uint32_t ignored[] = {expected.front(), expected.back()};
        auto rest = expected;
        std::erase(rest, ignored[0]);
        std::erase(rest, ignored[1]);
        wrong += queries.all_hits(s, {ignored, nullptr}) != rest ? 1 : 0;
        wrong += queries.any_hit(s, {ignored, nullptr}) == rest.empty() ? 1 : 0;
      }
    } catch (const scene::Error&) {
      ++wrong;
    }
  }
  if (counts != nullptr) *counts += queries.counts();
  return wrong;
}

TEST(SegmentQueries, RandomScenesAgreeWithTheOracle) {
  SegmentCounts counts;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t index = 0; index < 4; ++index) {
      const auto scene = fuzz::generate(kind, kSeed, index);
      const Bvh bvh(scene.mesh);
      EXPECT_EQ(wrong_answers(scene.mesh, bvh, kSeed + index, 300, &counts), 0) << scene.name;
    }
  }
  // Every stage had work to do.
  EXPECT_GT(counts.blocks, 0U);
  EXPECT_GT(counts.doubles, 1000U);
  EXPECT_GT(counts.exact, 1000U);
}

TEST(SegmentQueriesLong, ManyRandomScenesAgreeWithTheOracle) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  fuzz::Random random(kSeed);
  for (std::uint64_t index = 100; index < 160; ++index) {
    for (const fuzz::Kind kind : fuzz::all_kinds) {
      const auto scene = fuzz::generate(kind, kSeed, index);
      const double factor = random.one_in(2) ? 1 : std::ldexp(1 + random_double(random) / 2, random.between(-80, 80));
      const auto mesh = moved(scene.mesh, factor, random.one_in(2) ? 0 : factor * 1000 * random_double(random));
      ASSERT_EQ(wrong_answers(mesh, Bvh(mesh), kSeed + index, 300), 0) << scene.name;
    }
  }
}

TEST(SegmentQueries, ScaleAndOffsetDoNotMatter) {
  const auto scene = fuzz::generate(fuzz::Kind::nonconvex_solids, kSeed, 7);
  for (const int power : {-1060, -1000, -400, -60, -20, 20, 60, 400, 1000, 1015}) {
    const auto mesh = moved(scene.mesh, std::ldexp(1, power), 0);
    EXPECT_EQ(wrong_answers(mesh, Bvh(mesh), kSeed, 150), 0) << "2^" << power;
  }
  for (const double offset : {1e7, -1e7, 1e12, 1e15}) {
    const auto mesh = moved(scene.mesh, 1, offset);
    EXPECT_EQ(wrong_answers(mesh, Bvh(mesh), kSeed, 150), 0) << offset;
  }
}

TEST(SegmentQueries, EndPointsFarOutsideTheScene) {
  const auto scene = fuzz::generate(fuzz::Kind::axis_boxes, kSeed, 3);
  const Bvh bvh(scene.mesh);
  SegmentQueries queries(bvh);
  fuzz::Random random(kSeed);
  for (int i = 0; i < 400; ++i) {
    Segment s = aimed_segment(scene.mesh, random);
    const double far = std::ldexp(1, random.between(0, 1) == 0 ? random.between(1, 40) : random.between(41, 1010));
    for (std::size_t k = 0; k < 3; ++k) s.b[k] = s.a[k] + (s.b[k] - s.a[k]) * far;
    if (random.one_in(2)) std::swap(s.a, s.b);
    const auto expected = oracle_all_hits(s, scene.mesh);
    ASSERT_EQ(queries.all_hits(s), expected) << i;
    ASSERT_EQ(queries.any_hit(s), !expected.empty()) << i;
    ASSERT_EQ(queries.first_hit(s), oracle_first_hit(s, scene.mesh)) << i;
  }
}

TEST(SegmentQueries, ACityAgreesWithTheOracle) {
  const auto city = fuzz::make_city(1500, kSeed);
  const Bvh bvh(city);
  EXPECT_EQ(wrong_answers(city, bvh, kSeed, 120), 0);
}

// D3: what is inside of a solid cell does not occlude, and all does of other cells; cells of every dimension that touch,
// cut and contain geometry.
TEST(SegmentQueries, TheInsideOfTheCellDoesNotOcclude) {
  fuzz::Random random(kSeed);
  int inside = 0, partly = 0;
  for (int round = 0; round < 60; ++round) {
    const auto scene =
        fuzz::generate(fuzz::all_kinds[static_cast<std::size_t>(round) % 6], kSeed, static_cast<std::uint64_t>(round));
    const auto some_corner = [&] {
      return scene.mesh
          .points[static_cast<std::size_t>(random.between(0, static_cast<int>(scene.mesh.points.size()) - 1))];
    };
    std::vector<Point> points;
    const int n = round % 5 == 4 ? 8 : round % 5 + 1;
    for (int i = 0; i < n; ++i) points.push_back(some_corner());
    const Cell cell(points);
    const auto exact_cell = exact::ConvexCell::from_doubles(points);
    const Bvh bvh(scene.mesh);
    SegmentQueries queries(bvh);
    for (int i = 0; i < 60; ++i) {
      Segment s = aimed_segment(scene.mesh, random);
      if (i % 3 == 0) s.a = points[0];
      if (i % 3 == 1) s.a = exact::to_double_estimate(exact_cell.center());
      const auto expected = oracle_all_hits(s, scene.mesh, &exact_cell);
      ASSERT_EQ(queries.all_hits(s, {{}, &cell}), expected) << scene.name << " segment " << i;
      ASSERT_EQ(queries.any_hit(s, {{}, &cell}), !expected.empty()) << scene.name << " segment " << i;
      const auto without = queries.all_hits(s);
      inside += expected.size() < without.size() ? 1 : 0;
      partly += expected.size() < without.size() && !expected.empty() ? 1 : 0;
      ASSERT_EQ(queries.first_hit(s, {{}, &cell}), oracle_first_hit(s, scene.mesh, &exact_cell))
          << scene.name << " segment " << i;
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(partly, 20);
}

TEST(SegmentQueries, ClosedTrianglesAndOpenSegments) {
  scene::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Bvh bvh(mesh);
  SegmentQueries queries(bvh);
  EXPECT_TRUE(queries.any_hit({{0.25, 0.25, 1}, {0.25, 0.25, -1}}));
  EXPECT_TRUE(queries.any_hit({{0, 0, 1}, {0, 0, -1}}));                     // a corner
  EXPECT_TRUE(queries.any_hit({{0.5, 0, 1}, {0.5, 0, -1}}));                 // an edge
  EXPECT_FALSE(queries.any_hit({{-0x1p-1074, 0, 1}, {-0x1p-1074, 0, -1}}));  // just beside
  EXPECT_FALSE(queries.any_hit({{0.25, 0.25, 1}, {0.25, 0.25, 0}}));         // an end is not part of the segment
  EXPECT_FALSE(queries.any_hit({{0.25, 0.25, 0}, {0.25, 0.25, -1}}));
  EXPECT_TRUE(queries.any_hit({{0.25, 0.25, 0x1p-1074}, {0.25, 0.25, -0x1p-1074}}));
  EXPECT_TRUE(queries.any_hit({{-1, 0, 0}, {2, 0, 0}}));              // along an edge
  EXPECT_TRUE(queries.any_hit({{-1, 1, 0}, {1, 1, 0}}));              // in the plane, through a corner
  EXPECT_FALSE(queries.any_hit({{-1, 0, 0}, {0, 0, 0}}));             // in the plane, ends at a corner
  EXPECT_FALSE(queries.any_hit({{0.25, 0.25, 0}, {0.25, 0.25, 0}}));  // no length
  EXPECT_TRUE(queries.any_hit({{0.25, 0.25, 0}, {0.5, 0.25, 0}}));    // inside it
}

TEST(SegmentQueries, TrianglesWithoutAreaAreNoSurface) {
  scene::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0.1, 0.2, 0.3}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {3, 3, 3}};
  const Bvh bvh(mesh);
  EXPECT_EQ(bvh.degenerate(), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_FALSE(SegmentQueries(bvh).any_hit({{-1, 0, 0}, {3, 0, 0}}));
  EXPECT_FALSE(SegmentQueries(bvh).first_hit({{0.5, -1, 0}, {0.5, 1, 0}}).has_value());
}

TEST(SegmentQueries, RefusesWhatIsNotFinite) {
  scene::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Bvh bvh(mesh);
  SegmentQueries queries(bvh);
  for (const double bad : {double{NAN}, double{INFINITY}, -double{INFINITY}}) {
    EXPECT_THROW(queries.any_hit({{0, bad, 0}, {1, 1, 1}}), scene::Error);
    EXPECT_THROW(queries.any_hit({{0, 0, 0}, {1, 1, bad}}), scene::Error);
    EXPECT_THROW(Cell({{0, 0, bad}}), scene::Error);
  }
  mesh.points[1][0] = NAN;
  EXPECT_THROW(Bvh{mesh}, scene::Error);
  mesh.points[1][0] = 1;
  mesh.triangles[0][2] = 3;
  EXPECT_THROW(Bvh{mesh}, scene::Error);
}

TEST(SegmentQueries, ABatchAnswersLikeSingleQueries) {
  const auto city = fuzz::make_city(3000, kSeed);
  const Bvh bvh(city);
  fuzz::Random random(kSeed);
  std::vector<Segment> segments;
  for (int i = 0; i < 3000; ++i) segments.push_back(aimed_segment(city, random));
  SegmentCounts counts;
  const auto answers = any_hits(bvh, segments, {}, &counts);
  SegmentQueries queries(bvh);
  ASSERT_EQ(answers.size(), segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) ASSERT_EQ(answers[i] != 0, queries.any_hit(segments[i])) << i;
  EXPECT_EQ(counts, queries.counts());
  std::vector<std::uint8_t> too_few(segments.size() - 1);
  EXPECT_THROW(queries.any_hits(segments, too_few), scene::Error);
  segments[1234].b[0] = NAN;
  EXPECT_THROW(any_hits(bvh, segments), scene::Error);
}

// Planted bugs: a checker that cannot fail is a defect.
TEST(SegmentQueries, TooSmallErrorBoundsAreCaught) {
  const auto scene = fuzz::generate(fuzz::Kind::nonconvex_solids, kSeed, 2);
  const auto mesh = moved(scene.mesh, 0.1, 0.3);  // off the grid
  Bvh bvh(mesh);
  ASSERT_EQ(wrong_answers(mesh, bvh, kSeed, 300), 0);
  BvhTamperer::scale_sizes(bvh, 0x1p-8F);
  EXPECT_GT(wrong_answers(mesh, bvh, kSeed, 300), 0);
}

TEST(SegmentQueries, TooSmallBoxesAreCaught) {
  const auto scene = fuzz::generate(fuzz::Kind::nonconvex_solids, kSeed, 2);
  Bvh bvh(scene.mesh);
  ASSERT_EQ(wrong_answers(scene.mesh, bvh, kSeed, 300), 0);
  BvhTamperer::shrink_boxes(bvh, 0x1p-20F);
  EXPECT_GT(wrong_answers(scene.mesh, bvh, kSeed, 300), 0);
}

}  // namespace
}  // namespace clues::fastpath
