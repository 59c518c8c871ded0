// D23: polytopes cut exactly, and the cells of doubles within and around them, each against an enumeration that shares no code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "scene/levels/polytope.h"
#include "scene/levels/rounding.h"

namespace clues::tests {
namespace {

using scene::HalfSpace;
using scene::Polytope;
using scene::RationalPoint;

mpq_class determinant(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// All points that lie on three of the planes and in every half space, by Cramer's rule.
std::set<RationalPoint> corners_by_triples(const std::vector<HalfSpace>& all) {
  std::set<RationalPoint> corners;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        const std::array planes{&all[i], &all[j], &all[k]};
        const auto& [a, b, c] = planes;
        const mpq_class d = determinant(a->normal, b->normal, c->normal);
        if (sgn(d) == 0) continue;
        RationalPoint p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<RationalPoint, 3> rows{a->normal, b->normal, c->normal};
          for (std::size_t row = 0; row < 3; ++row) rows[row][axis] = planes[row]->offset;
          p[axis] = determinant(rows[0], rows[1], rows[2]) / d;
        }
        if (std::all_of(all.begin(), all.end(), [&](const HalfSpace& h) { return h.holds(p); })) corners.insert(p);
      }
    }
  }
  return corners;
}

struct Made {
  std::vector<HalfSpace> half_spaces;
  std::optional<Polytope> polytope;
};

// A box that random planes cut; small whole numbers, so that planes meet in one point and in one line often.
Made random_polytope(std::mt19937_64& random, int range, bool thirds) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Made made;
  made.polytope = scene::box_polytope({0, 0, 0}, {8, 8, 8});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    HalfSpace below, above;
    above.normal[axis] = 1;
    above.offset = 8;
    below.normal[axis] = -1;
    made.half_spaces.push_back(above);
    made.half_spaces.push_back(below);
  }
  for (int i = number(0, 7); i > 0; --i) {
    HalfSpace h;
    for (auto& x : h.normal) x = number(-range, range);
    if (h.normal == RationalPoint{0, 0, 0}) h.normal[0] = 1;
    const RationalPoint through{number(0, 8), number(0, 8), number(0, 8)};
    h.offset = h.height(through) + h.offset;
    if (thirds) h.offset += mpq_class(number(-5, 5)) / 3;
    made.half_spaces.push_back(h);
    if (made.polytope) made.polytope = scene::intersection(*made.polytope, h);
  }
  return made;
}

bool flat(const std::set<RationalPoint>& points) {
  const std::vector<RationalPoint> all(points.begin(), points.end());
  const auto from = [&](std::size_t i) {
    return RationalPoint{mpq_class(all[i][0] - all[0][0]), mpq_class(all[i][1] - all[0][1]),
                         mpq_class(all[i][2] - all[0][2])};
  };
  for (std::size_t i = 1; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        if (sgn(determinant(from(i), from(j), from(k))) != 0) return false;
      }
    }
  }
  return true;
}

TEST(Polytope, IsWhatThreePlanesAtATimeSay) {
  int empty = 0, solid = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto made = random_polytope(random, seed % 2 == 0 ? 1 : 3, seed % 3 == 0);
    const auto corners = corners_by_triples(made.half_spaces);
    ASSERT_EQ(made.polytope.has_value(), !flat(corners));
    ++(made.polytope ? solid : empty);
    if (!made.polytope) continue;
    const std::set<RationalPoint> vertices(made.polytope->vertices.begin(), made.polytope->vertices.end());
    EXPECT_EQ(vertices, corners);
    EXPECT_EQ(vertices.size(), made.polytope->vertices.size()) << "none is there twice";
    std::size_t corners_of_faces = 0;
    for (const auto& face : made.polytope->faces) {
      ASSERT_GE(face.vertices.size(), 3U);
      corners_of_faces += face.vertices.size();
      for (const auto v : face.vertices) EXPECT_EQ(sgn(face.half_space.height(made.polytope->vertices[v])), 0);
    }
    EXPECT_EQ(vertices.size() + made.polytope->faces.size(), corners_of_faces / 2 + 2) << "Euler";
  }
  EXPECT_GT(empty, 10);
  EXPECT_GT(solid, 100);
}

// No point of the hull of the points is beyond the plane: the points are not.
bool hull_reaches(const std::vector<scene::Point>& points, const RationalPoint& normal, const mpq_class& height) {
  return std::any_of(points.begin(), points.end(), [&](const scene::Point& p) {
    mpq_class sum;
    for (std::size_t axis = 0; axis < 3; ++axis) sum += normal[axis] * mpq_class(p[axis]);
    return sum >= height;
  });
}

TEST(RoundedCells, LieWithinAndAround) {
  int rounded = 0, moved = 0, on_grid = 0, off_grid = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto made = random_polytope(random, 3, seed % 2 == 0);
    if (!made.polytope) continue;
    const auto inner = scene::inner_vertices(*made.polytope);
    ASSERT_TRUE(inner.has_value());
    ASSERT_EQ(inner->size(), made.polytope->vertices.size());
    for (const auto& p : *inner) {
      for (const auto& h : made.half_spaces) ASSERT_TRUE(h.holds(scene::to_rational(p)));
    }
    // On a grid, where such a point is near; what is a double stays.
    const auto coarse = scene::inner_vertices(*made.polytope, 10);
    ASSERT_TRUE(coarse.has_value());
    ASSERT_EQ(coarse->size(), inner->size());
    for (std::size_t i = 0; i < coarse->size(); ++i) {
      const auto& v = made.polytope->vertices[i];
      for (const auto& h : made.half_spaces) ASSERT_TRUE(h.holds(scene::to_rational((*coarse)[i])));
      if (scene::to_rational((*inner)[i]) == v) {
        EXPECT_EQ((*coarse)[i], (*inner)[i]);
        continue;
      }
      bool short_ones = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = (*coarse)[i][axis];
        short_ones = short_ones && (x == v[axis] || std::ldexp(x, 10) == std::floor(std::ldexp(x, 10)));
      }
      (short_ones ? on_grid : off_grid) += 1;
    }
    const auto outer = scene::outer_points(*made.polytope);
    rounded += outer.size() == made.polytope->vertices.size() ? 1 : 0;
    // In every direction of a sample the outer points reach as far as the polytope: directions of its faces, and between its vertices.
    for (const auto& v : made.polytope->vertices) {
      for (const auto& w : made.polytope->vertices) {
        const RationalPoint direction{mpq_class(w[0] - v[0]), mpq_class(w[1] - v[1]), mpq_class(w[2] - v[2])};
        mpq_class most = direction[0] * w[0] + direction[1] * w[1] + direction[2] * w[2];
        ASSERT_TRUE(hull_reaches(outer, direction, most));
      }
    }
    for (const auto& h : made.half_spaces) {
      const bool touched = std::any_of(made.polytope->vertices.begin(), made.polytope->vertices.end(),
                                       [&](const RationalPoint& v) { return sgn(h.height(v)) == 0; });
      ASSERT_TRUE(!touched || hull_reaches(outer, h.normal, h.offset));
    }
    for (std::size_t i = 0; i < inner->size(); ++i) {
      if (scene::to_rational((*inner)[i]) != made.polytope->vertices[i]) ++moved;
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR((*inner)[i][axis], made.polytope->vertices[i][axis].get_d(), 1e-9);
    }
  }
  EXPECT_GT(rounded, 20);
  EXPECT_GT(moved, 100) << "thirds are no doubles";
  EXPECT_GT(on_grid, 100);
  EXPECT_LT(off_grid, on_grid / 4);
}

// Walls lie in the sides of a leaf. An outer cell that reaches through one by a rounding sees what is in the wall: a leaf of a level
// of OpenArena listed 3,059 triangles for 416. Sides across the axes need no rounding, even where another side is slanted.
TEST(RoundedCells, DoNotReachThroughSidesAcrossTheAxes) {
  HalfSpace slanted;  // as in a file of floats: nearly half a right angle
  slanted.normal = {mpq_class(0.70710676908493042), mpq_class(0.70710676908493042), 0};
  slanted.offset = mpq_class(100.1);
  const auto box = scene::box_polytope({-128, 0, 8}, {128, 256, 72});
  const auto leaf = scene::intersection(box, slanted);
  ASSERT_TRUE(leaf.has_value());
  const auto outer = scene::outer_points(*leaf);
  EXPECT_EQ(outer.size(), leaf->vertices.size());
  int beyond_the_slant = 0;
  for (const auto& p : outer) {
    EXPECT_TRUE(box.holds(scene::to_rational(p)));
    beyond_the_slant += slanted.holds(scene::to_rational(p)) ? 0 : 1;
  }
  EXPECT_GT(beyond_the_slant, 0) << "its corners are no doubles";
  for (const auto& v : leaf->vertices) {
    EXPECT_TRUE(hull_reaches(outer, slanted.normal, slanted.height(v) + slanted.offset));
  }
}

// Of 330 leaves of a level of OpenArena 25 had vertices in twos and fours, an ulp from each other: where two planes of floats meet, hardly any corner of so
// small a box is beyond both. All planes through two of them are nearly the same, and lists for such leaves took three times as long.
TEST(RoundedCells, HaveOneShortPointForAVertex) {
  const auto half_space = [](double x, double y, double offset) {
    HalfSpace h;
    h.normal = {mpq_class(x), mpq_class(y), 0};
    h.offset = mpq_class(offset);
    return h;
  };
  auto leaf = scene::intersection(scene::box_polytope({-128, 0, 64}, {240, 400, 80}),
                                  half_space(-0.89442718029022217, 0.44721359014511108, 57.243339538574219));
  ASSERT_TRUE(leaf.has_value());
  leaf = scene::intersection(*leaf, half_space(0.44721359014511108, 0.89442718029022217, 400.70330810546875));
  ASSERT_TRUE(leaf.has_value());
  const auto outer = scene::outer_points(*leaf);
  EXPECT_EQ(outer.size(), leaf->vertices.size());
  for (const auto& p : outer) {
    for (const double x : p) EXPECT_EQ(std::ldexp(x, 14), std::floor(std::ldexp(x, 14))) << x;
    EXPECT_TRUE(std::any_of(leaf->vertices.begin(), leaf->vertices.end(), [&](const RationalPoint& v) {
      return std::fabs(v[0].get_d() - p[0]) < 0x1p-12 && std::fabs(v[1].get_d() - p[1]) < 0x1p-12 && v[2] == p[2];
    }));
  }
  for (const auto& h : {half_space(-0.89442718029022217, 0.44721359014511108, 57.243339538574219),
                        half_space(0.44721359014511108, 0.89442718029022217, 400.70330810546875)})
    EXPECT_TRUE(hull_reaches(outer, h.normal, h.offset));
}

// Of a cell that is as small as the steps of a coarse grid the points are no further off than a fraction of it.
TEST(RoundedCells, AreAsCloseAsTheCellIsSmall) {
  HalfSpace slanted;
  slanted.normal = {1, 2, 0};
  slanted.offset = mpq_class(0x1p-12);
  const auto cell = scene::intersection(scene::box_polytope({0, 0, 0}, {0x1p-12, 0x1p-12 * 2 / 3, 0x1p-12}), slanted);
  ASSERT_TRUE(cell.has_value());
  for (const auto& p : scene::outer_points(*cell)) {
    for (const double x : p) EXPECT_LT(std::fabs(x), 0x1p-12 + 0x1p-24);
  }
}

// A cell between two planes with no double between them has no inner cell that is solid, and an outer one.
TEST(RoundedCells, OfASliverAreEmptyWithin) {
  HalfSpace low, high;
  high.normal[0] = 1;
  high.offset = mpq_class(1, 3) + mpq_class(1, mpz_class(1) << 70);
  low.normal[0] = -1;
  low.offset = mpq_class(-1, 3);
  const auto half = scene::intersection(scene::box_polytope({0, 0, 0}, {8, 8, 8}), high);
  ASSERT_TRUE(half.has_value());
  const auto sliver = scene::intersection(*half, low);
  ASSERT_TRUE(sliver.has_value());
  const auto inner = scene::inner_vertices(*sliver);
  EXPECT_FALSE(inner.has_value());
  const auto outer = scene::outer_points(*sliver);
  EXPECT_FALSE(scene::are_coplanar(outer));
  EXPECT_TRUE(hull_reaches(outer, {1, 0, 0}, mpq_class(1, 3) + mpq_class(1, mpz_class(1) << 70)));
  EXPECT_TRUE(hull_reaches(outer, {-1, 0, 0}, mpq_class(-1, 3)));
}

}  // namespace
}  // namespace clues::tests
