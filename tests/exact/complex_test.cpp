// D16: the refined scene is embedded (two pieces meet in a common vertex, a common edge, or not at all) and covers exactly the input.
#include "exact/complex/complex.h"

#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "exact/complex/complex_internal.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"

namespace clues::exact {
namespace {

Kernel::Triangle_3 triangle_of(const Complex& c, std::uint32_t piece) {
  const auto& k = c.pieces[piece].corners;
  return {c.points[k[0]], c.points[k[1]], c.points[k[2]]};
}

std::uint64_t wrong_contacts(const Complex& c) {
  std::uint64_t wrong = 0;
  for (std::uint32_t i = 0; i < c.pieces.size(); ++i) {
    for (std::uint32_t j = i + 1; j < c.pieces.size(); ++j) {
      std::vector<std::uint32_t> common;
      for (const std::uint32_t a : c.pieces[i].corners) {
        const auto& other = c.pieces[j].corners;
        if (std::find(other.begin(), other.end(), a) != other.end()) common.push_back(a);
      }
      const auto met = CGAL::intersection(triangle_of(c, i), triangle_of(c, j));
      if (!met) {
        wrong += !common.empty();
      } else if (const auto* p = boost::get<Point3>(&*met)) {
        wrong += common.size() != 1 || c.points[common[0]] != *p;
      } else if (const auto* s = boost::get<Kernel::Segment_3>(&*met)) {
        wrong += common.size() != 2 || (*s != Kernel::Segment_3(c.points[common[0]], c.points[common[1]]) &&
                                        *s != Kernel::Segment_3(c.points[common[1]], c.points[common[0]]));
      } else {
        ++wrong;
      }
    }
  }
  return wrong;
}

// Per input triangle, the vector areas of its pieces add up to its own.
void expect_covered(const scene::TriangleMesh& mesh, const Complex& c) {
  std::map<std::uint32_t, Vector3> area;
  for (const Piece& p : c.pieces) {
    const Vector3 n = CGAL::cross_product(c.points[p.corners[1]] - c.points[p.corners[0]],
                                          c.points[p.corners[2]] - c.points[p.corners[0]]);
    for (const Origin& o : p.origins) {
      auto [it, fresh] = area.try_emplace(o.triangle, CGAL::NULL_VECTOR);
      it->second = it->second + (o.same_side ? n : -n);
    }
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& k = mesh.triangles[t];
    const Point3 a = to_exact(mesh.points[k[0]]), b = to_exact(mesh.points[k[1]]), d = to_exact(mesh.points[k[2]]);
    const Vector3 n = CGAL::cross_product(b - a, d - a);
    if (n == CGAL::NULL_VECTOR) continue;
    ASSERT_TRUE(area.contains(t)) << t;
    EXPECT_EQ(area[t], n) << t;
  }
}

scene::TriangleMesh mesh_of(const std::vector<std::array<scene::Point, 3>>& triangles) {
  scene::TriangleMesh mesh;
  for (const auto& t : triangles) {
    const auto n = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), t.begin(), t.end());
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  return mesh;
}

TEST(Complex, RandomScenesAreEmbeddedAndCovered) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, 20261121, i);
      SCOPED_TRACE(scene.name);
      const Complex c = build_complex(scene.mesh);
      if (c.pieces.size() < 200) {
        EXPECT_EQ(wrong_contacts(c), 0U);
      }
      expect_covered(scene.mesh, c);
    }
  }
}

// Every triangle passes through the origin's neighbourhood and crosses every other one.
TEST(Complex, EveryTriangleMeetsEveryOther) {
  constexpr std::uint64_t kSeed = 11;
  fuzz::Random random(kSeed);
  std::vector<std::array<scene::Point, 3>> triangles;
  for (int i = 0; i < 6; ++i) {
    const double a = random.between(1, 9), b = random.between(1, 9), c = random.between(-9, 9);
    triangles.push_back({scene::Point{-20, -a, c}, scene::Point{20 + b, -20, -c}, scene::Point{b, 20 + a, -b}});
  }
  const scene::TriangleMesh mesh = mesh_of(triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto of = [&](std::size_t k) {
        return Kernel::Triangle_3(to_exact(triangles[k][0]), to_exact(triangles[k][1]), to_exact(triangles[k][2]));
      };
      ASSERT_TRUE(CGAL::do_intersect(of(i), of(j))) << "seed " << kSeed;
    }
  }
  const Complex c = build_complex(mesh);
  EXPECT_EQ(c.refined_triangles, triangles.size());
  EXPECT_EQ(wrong_contacts(c), 0U);
  expect_covered(mesh, c);
}

// A pair is cut if and only if it meets in more than common corners or a common edge; on so small a grid corners lie in planes and on lines of the other
// triangle all the time.
TEST(Complex, CutsAPairOnlyWhereItMeetsInMoreThanCommonCorners) {
  constexpr std::uint64_t kSeed = 20261121;
  fuzz::Random random(kSeed);
  int cut = 0, whole = 0;
  for (int n = 0; n < 4000; ++n) {
    SCOPED_TRACE(n);
    std::vector<std::array<scene::Point, 3>> triangles(2);
    for (auto& t : triangles) {
      for (scene::Point& p : t) {
        for (double& x : p) x = random.between(0, 2);
      }
    }
    if (random.one_in(2)) triangles[1][0] = triangles[0][0];
    if (random.one_in(4)) triangles[1][1] = triangles[0][1];
    const auto of = [&](std::size_t k) {
      return Kernel::Triangle_3(to_exact(triangles[k][0]), to_exact(triangles[k][1]), to_exact(triangles[k][2]));
    };
    if (of(0).is_degenerate() || of(1).is_degenerate()) continue;
    std::size_t common = 0;
    for (const scene::Point& p : triangles[1])
      common += static_cast<std::size_t>(std::count(triangles[0].begin(), triangles[0].end(), p));
    const Contact contact = meet(of(0), of(1));
    const bool must = common < 3 && (contact.overlap || contact.points.size() > common);
    const Complex c = build_complex(mesh_of(triangles));
    ASSERT_EQ(c.refined_triangles, must ? 2U : 0U) << "seed " << kSeed;
    ASSERT_EQ(wrong_contacts(c), 0U);
    (must ? cut : whole) += 1;
  }
  EXPECT_GT(cut, 500);
  EXPECT_GT(whole, 500);
}

TEST(Complex, NothingMeetsAnything) {
  std::vector<std::array<scene::Point, 3>> triangles;
  for (int i = 0; i < 300; ++i) {
    const double z = i;
    triangles.push_back({scene::Point{0, 0, z}, scene::Point{1, 0, z}, scene::Point{0, 1, z + 0.5}});
  }
  const scene::TriangleMesh mesh = mesh_of(triangles);
  const Complex c = build_complex(mesh);
  EXPECT_EQ(c.refined_triangles, 0U);
  EXPECT_EQ(c.pieces.size(), 300U);
  EXPECT_EQ(c.points.size(), 900U);
  expect_covered(mesh, c);
}

TEST(Complex, DuplicatesAndTurnedTrianglesAreOnePiece) {
  const scene::Point a{0, 0, 0}, b{1, 0, 0}, d{0, 1, 0};
  const scene::TriangleMesh mesh = mesh_of({{a, b, d}, {a, d, b}, {b, d, a}, {a, a, b}});
  const Complex c = build_complex(mesh);
  ASSERT_EQ(c.pieces.size(), 1U);
  ASSERT_EQ(c.pieces[0].origins.size(), 3U);
  EXPECT_NE(c.pieces[0].origins[0].same_side, c.pieces[0].origins[1].same_side);
  EXPECT_EQ(c.pieces[0].origins[0].same_side, c.pieces[0].origins[2].same_side);
  EXPECT_EQ(c.degenerate, std::vector<std::uint32_t>{3});
}

}  // namespace
}  // namespace clues::exact
