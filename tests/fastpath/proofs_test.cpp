// What comments beside the code prove, tried: a limit and boxes that begin at it, the arcs that a way meets,
// a box around a rounded point, and segments that leave the box of the scene.
#include <gtest/gtest.h>

#include <cmath>

#include "exact/cell/convex_cell.h"
#include "fastpath/queries/box_lanes.h"
#include "fastpath/visibility/closure/closure.h"
#include "fastpath/visibility/map/local_map.h"
#include "fastpath/visibility/wedges/apex.h"
#include "fastpath/visibility/wedges/star.h"
#include "fuzz/generators/random.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

constexpr std::uint64_t kProofsSeed = 20261123;

double random_double(fuzz::Random& random) { return std::ldexp(static_cast<double>(random.next() >> 11), -53); }

// A float segment without error: `reach` is 0, and what remains are the roundings of the test itself.
TEST(BoxTest, LooksAtABoxThatBeginsAtTheLimit) {
  std::printf("seed %lu\n", kProofsSeed);
  fuzz::Random random(kProofsSeed);
  for (int i = 0; i < 200000; ++i) {
    LocalSegment s;
    BoxLanes node{};
    const auto limit = static_cast<float>(0.25 + 0.75 * random_double(random));
    for (std::size_t k = 0; k < 3; ++k) {
      s.start[k] = s.near_origin[k] = s.far_origin[k] = static_cast<float>(2 * random_double(random) - 1);
      s.along[k] = static_cast<float>(2 * random_double(random) - 1);
      s.inverse[k] = 1 / s.along[k];
      s.forward[k] = s.along[k] > 0;
      // The point at the limit, which doubles hold but for the last bit of a sum.
      const double at = static_cast<double>(s.start[k]) + static_cast<double>(limit) * static_cast<double>(s.along[k]);
      std::fill_n(node.side[k], BoxLanes::kWidth, rounded_down(at - 0x1p-52));
      std::fill_n(node.side[k + 3], BoxLanes::kWidth, rounded_up(at + 0x1p-52));
    }
    std::array<float, BoxLanes::kWidth> near{};
    ASSERT_EQ(BoxTest(s)(node, limit, near.data()), 255U) << "segment " << i;
    ASSERT_LE(near[0], BoxTest::widened(limit));
  }
}

TEST(AboutInside, HoldsAPointOfTheTriangleOfSubnormals) {
  fuzz::Random random(kProofsSeed);
  for (int i = 0; i < 20000; ++i) {
    Corners t;
    for (Point& p : t) {
      for (double& x : p) x = std::ldexp(random.between(-99, 99) + random_double(random), random.between(-1080, -1018));
    }
    for (const std::array<double, 3>& weight :
         {std::array{0.3125, 0.375, 0.3125}, {0.25, 0.25, 0.5}, {0.5, 0.1875, 0.3125}}) {
      const Box box = about_inside(t, weight);
      for (std::size_t k = 0; k < 3; ++k) {
        Rational exact(0);
        for (std::size_t c = 0; c < 3; ++c) exact += Rational(weight[c]) * Rational(t[c][k]);
        ASSERT_LT(Rational(box.low[k]), exact) << i;
        ASSERT_GT(Rational(box.high[k]), exact) << i;
      }
    }
  }
}

using Way = Vec3<Integer>;

Way way(int x, int y, int z) { return {Integer(x), Integer(y), Integer(z)}; }

// Whether the closed arcs have a point in common; coplanar ones count as if they had. By signs alone, nothing
// of star.h.
bool arcs_meet(const Way& a, const Way& b, const Way& c, const Way& d) {
  const Way n = cross(a, b), m = cross(c, d);
  const Way x = cross(n, m);
  if (x.x.sign() == 0 && x.y.sign() == 0 && x.z.sign() == 0) return true;
  const auto holds = [](const Way& from, const Way& to, const Way& normal, const Way& at) {
    return dot(normal, cross(from, at)).sign() >= 0 && dot(normal, cross(at, to)).sign() >= 0;
  };
  for (const Way& at : {x, -x}) {
    if (holds(a, b, n, at) && holds(c, d, m, at)) return true;
  }
  return false;
}

struct StarOf {
  scene::TriangleMesh mesh;
  std::vector<LocalArc> arcs;
  std::unique_ptr<LocalScene> scene;
  std::unique_ptr<Star<Integer>> star;

  // Triangles at the origin, which have nothing else in common.
  explicit StarOf(const std::vector<std::array<Point, 2>>& ends) {
    mesh.points.push_back({0, 0, 0});
    for (const auto& [a, b] : ends) {
      const auto n = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(a);
      mesh.points.push_back(b);
      mesh.triangles.push_back({0, n, n + 1});
      mesh.face_of.push_back(0);
    }
    scene = std::make_unique<LocalScene>(mesh, exact::ConvexCell::from_doubles({{50, 60, 70}}));
    std::uint32_t center = 0;
    while (!(scene->points[center].exact().x == 0 && scene->points[center].exact().y == 0 &&
             scene->points[center].exact().z == 0))
      ++center;
    for (const std::uint32_t t : scene->point_pieces[center]) {
      const LocalPiece& piece = scene->pieces[t];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = piece.corners[i], b = piece.corners[(i + 1) % 3];
        if (a != center && b != center) arcs.push_back({a, b, piece.edges[i], t});
      }
    }
    star = std::make_unique<Star<Integer>>(*scene, false, center, &scene->points[center], arcs);
  }
};

TEST(Star, AWayThatEndsOnAnArcIsNotFree) {
  const StarOf it({{Point{1, 0, 0}, {0, 1, 0}}});
  // Both ends in the plane of the arc; the first only in the limit.
  const Beside<Integer> start{way(2, -1, 0), way(0, 0, 1), way(0, 0, 1), {}};
  EXPECT_FALSE(it.star->free_between(start, way(1, 1, 0)));
  EXPECT_TRUE(it.star->free_between(start, way(4, -1, 0)));
}

TEST(Star, FreeWaysMeetNoArc) {
  fuzz::Random random(kProofsSeed + 1);
  const auto some = [&] { return way(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)); };
  const auto is_zero = [](const Way& d) { return d.x.sign() == 0 && d.y.sign() == 0 && d.z.sign() == 0; };
  int free = 0, on_circle = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<std::array<Point, 2>> ends;
    while (ends.size() < 2) {
      std::array<Point, 2> e{};
      for (Point& p : e) {
        for (double& x : p) x = random.between(-2, 2);
      }
      const Way n = cross(way(static_cast<int>(e[0][0]), static_cast<int>(e[0][1]), static_cast<int>(e[0][2])),
                          way(static_cast<int>(e[1][0]), static_cast<int>(e[1][1]), static_cast<int>(e[1][2])));
      if (!is_zero(n)) ends.push_back(e);
    }
    std::unique_ptr<StarOf> it;
    it = std::make_unique<StarOf>(ends);
    for (int k = 0; k < 200; ++k) {
      const Beside<Integer> d{some(), some(), some(), {}};
      const Way to = some();
      if (is_zero(d.limit) || is_zero(to)) continue;
      // With such small numbers nothing lies between this and the limit of it.
      const Integer big = Integer(1) << 40;
      const Way start = big * (big * d.limit) + big * d.aside + d.off;
      if (is_zero(cross(start, to)) || it->star->is_on_arc(start)) continue;
      if (!it->star->free_between(d, to)) continue;
      ++free;
      for (const LocalArc& arc : it->arcs) {
        const Way a = it->star->to(it->scene->points[arc.a]), b = it->star->to(it->scene->points[arc.b]);
        const Way n = cross(a, b);
        const bool first = dot(n, d.limit).sign() == 0, last = dot(n, to).sign() == 0;
        on_circle += first && last ? 1 : 0;
        ASSERT_FALSE(arcs_meet(start, to, a, b)) << "star " << i << ", way " << k;
      }
    }
  }
  std::printf("%d free ways, %d with both ends on an arc's circle\n", free, on_circle);
  EXPECT_GT(free, 1000);
  EXPECT_GT(on_circle, 50);
}

// The box of scene and cell begins at z = 0, with a floor. A small triangle beyond the floor's edge looks down; the
// point beside it that is labelled lies below the box, and so does all of the wedge of the floor's edge, from the tip
// of the cell, above which that point is visible. It was taken for hidden, and the triangle left out.
TEST(LocalMap, SeesAPlaceThatIsLabelledFromOutsideTheBoxOfTheScene) {
  scene::TriangleMesh mesh;
  mesh.points = {{16, -50, 0},      {60, -50, 0},        {60, 50, 0},      {16, 50, 0},
                 {9.5, -0.5, 0.02}, {10.5, -0.5, 0.025}, {10, 0.5, 0.0225}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}};
  mesh.face_of = {0, 0, 1};
  const auto cell = exact::ConvexCell::from_doubles({{99, -0.5, 0.1},
                                                     {99.25, -1, 0.1},
                                                     {99.75, -1, 0.1},
                                                     {100, -0.5, 0.1},
                                                     {100, 0.5, 0.1},
                                                     {99.75, 1, 0.1},
                                                     {99.25, 1, 0.1},
                                                     {99, 0.5, 0.1},
                                                     {99.5, 0, 1}});
  LocalMapOptions fronts;
  fronts.mode = SideMode::solid;
  const Box outside{{-300, -300, -300}, {300, 300, 300}};
  const std::vector<std::uint32_t> all{0, 1, 2};
  EXPECT_EQ(make_local_map(mesh, cell, fronts, &outside).visible(), all);
  EXPECT_EQ(make_local_map(mesh, cell, fronts).visible(), all);
  const auto complex = exact::build_complex(mesh, &cell);
  EXPECT_EQ(make_local_map_in(complex, cell, cell, fronts, std::vector<bool>(3, true)).visible(), all);
}

TEST(LocalMap, RefusesWhatItsNumbersCannotHold) {
  scene::TriangleMesh mesh;
  mesh.points = {{0x1p129, 0, 1}, {0, 1, 1}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  mesh.face_of = {0};
  EXPECT_THROW(make_local_map(mesh, exact::ConvexCell::from_doubles({{0, 0, 0}}), {}), scene::Error);
}

}  // namespace
}  // namespace clues::fastpath
