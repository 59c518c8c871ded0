// D18 at random: the oracle against a polygon union on a projection plane, against exact sight lines, and its witnesses against
// CGAL's own segment-triangle test.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/convex_hull_2.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "exact/sight/point_occlusion.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"

namespace clues::exact {
namespace {

using Soup = std::vector<TriangleCorners>;
using Polygon = CGAL::Polygon_2<Kernel>;

// The first point of V on the way from p to v in int V of a solid cell: from the facet planes alone.
Point3 entry_point(const Point3& p, const Point3& v, const ConvexCell& cell) {
  FT latest(0);
  for (const CellFacet& facet : cell.facets()) {
    if (!facet.plane.has_on_positive_side(p)) continue;
    const FT at_p = facet.plane.orthogonal_vector() * (p - CGAL::ORIGIN) + facet.plane.d();
    const FT at_v = facet.plane.orthogonal_vector() * (v - CGAL::ORIGIN) + facet.plane.d();
    latest = std::max(latest, FT(at_p / (at_p - at_v)));
  }
  return p + (v - p) * latest;
}

// D5 by brute force, for p on no triangle.
bool free_line(const Point3& p, const Point3& v, const ConvexCell& cell, const Soup& soup) {
  const Kernel::Segment_3 line(p, entry_point(p, v, cell));
  return std::none_of(soup.begin(), soup.end(), [&](const TriangleCorners& t) {
    return CGAL::do_intersect(line, Kernel::Triangle_3(t[0], t[1], t[2]));
  });
}

Point3 random_point(fuzz::Random& random, int x0, int x1, int r) {
  const int x = random.between(x0, x1), y = random.between(-r, r);
  return {FT(x) / 4, FT(y) / 4, FT(random.between(-r, r)) / 4};
}

std::optional<ConvexCell> random_cell(fuzz::Random& random) {
  std::vector<Point3> points;
  for (int i = 0; i < 7; ++i) points.push_back(random_point(random, -24, -16, 8));
  ConvexCell cell(points);
  return cell.dimension() == 3 ? std::optional<ConvexCell>(cell) : std::nullopt;
}

void add_random_triangle(Soup& soup, fuzz::Random& random, int x0, int x1, int r) {
  TriangleCorners t;
  do {
    for (Point3& corner : t) corner = random_point(random, x0, x1, r);
  } while (CGAL::collinear(t[0], t[1], t[2]));
  soup.push_back(t);
}

// Whether the projections from p (x to the right of everything) of the triangles cover that of the cell.
bool covered_on_plane(const Point3& p, const ConvexCell& cell, const Soup& soup) {
  const auto project = [&](const Point3& q) {
    return Point2((q.y() - p.y()) / (p.x() - q.x()), (q.z() - p.z()) / (p.x() - q.x()));
  };
  std::vector<Point2> seen, hull;
  for (const Point3& v : cell.vertices()) seen.push_back(project(v));
  CGAL::convex_hull_2(seen.begin(), seen.end(), std::back_inserter(hull));
  CGAL::Polygon_set_2<Kernel> rest(Polygon(hull.begin(), hull.end()));
  for (const TriangleCorners& t : soup) {
    Polygon shadow;
    for (const Point3& corner : t) shadow.push_back(project(corner));
    if (CGAL::collinear(shadow[0], shadow[1], shadow[2])) continue;  // seen edge on
    if (shadow.orientation() == CGAL::NEGATIVE) shadow.reverse_orientation();
    rest.difference(shadow);
  }
  return rest.is_empty();
}

TEST(PointOcclusionRandom, AgreesWithAPolygonUnionOnAPlane) {
  fuzz::Random random(20240607);
  int hidden = 0, open = 0, gaps = 0;
  for (int round = 0; round < 200; ++round) {
    const auto cell = random_cell(random);
    if (!cell) continue;
    const Point3 p = random_point(random, 4, 8, 4);
    Soup soup;
    for (int n = random.between(4, 26); n > 0; --n) add_random_triangle(soup, random, -15, 3, 12);
    const auto answer = point_occlusion(p, std::nullopt, *cell, soup);
    ASSERT_EQ(answer.occluded, covered_on_plane(p, *cell, soup)) << "round " << round;
    (answer.occluded ? hidden : open)++;
    if (!answer.occluded) {
      ASSERT_TRUE(cell->interior_contains(*answer.witness));
      ASSERT_TRUE(free_line(p, *answer.witness, *cell, soup)) << "round " << round;
    }
    // Hidden, one triangle fewer: what is open then is often a single small gap.
    for (std::size_t i = 0; answer.occluded && hidden <= 40 && i < soup.size(); ++i) {
      Soup fewer = soup;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const auto gap = point_occlusion(p, std::nullopt, *cell, fewer);
      ASSERT_EQ(gap.occluded, covered_on_plane(p, *cell, fewer)) << "round " << round << " without " << i;
      if (!gap.occluded) {
        ++gaps;
        ASSERT_TRUE(free_line(p, *gap.witness, *cell, fewer)) << "round " << round << " without " << i;
      }
    }
  }
  EXPECT_GT(hidden, 30);
  EXPECT_GT(open, 30);
  EXPECT_GT(gaps, 30);
}

TEST(PointOcclusionRandom, AgreesWithSightLinesWhereTrianglesReachThroughTheCell) {
  fuzz::Random random(77);
  int hidden = 0, open = 0;
  for (int round = 0; round < 150; ++round) {
    const auto cell = random_cell(random);
    if (!cell) continue;
    const Point3 p = random_point(random, 4, 8, 12);
    Soup soup;
    for (int n = random.between(4, 30); n > 0; --n) add_random_triangle(soup, random, -26, 10, 16);
    if (std::any_of(soup.begin(), soup.end(),
                    [&](const TriangleCorners& t) { return Kernel::Triangle_3(t[0], t[1], t[2]).has_on(p); })) {
      continue;
    }
    const auto answer = point_occlusion(p, std::nullopt, *cell, soup);
    (answer.occluded ? hidden : open)++;
    if (!answer.occluded) {
      ASSERT_TRUE(free_line(p, *answer.witness, *cell, soup)) << "round " << round;
      continue;
    }
    for (int k = 0; k < 40; ++k) {
      std::vector<int> weights(cell->vertices().size());
      for (int& w : weights) w = 1 + random.between(0, 9) * random.between(0, 9);
      ASSERT_FALSE(free_line(p, cell->interior_point(weights), *cell, soup)) << "round " << round;
    }
  }
  EXPECT_GT(hidden, 20);
  EXPECT_GT(open, 20);
}

// The fuzzer's scenes, with p on surfaces and asked for on each side; many coincidences in the axis-aligned ones.
TEST(PointOcclusionRandom, SurfacePointsOfGeneratedScenes) {
  int hidden = 0, open = 0;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t index = 0; index < 6; ++index) {
      const auto scene = fuzz::generate(kind, 3, index);
      const auto cell = ConvexCell::from_doubles(scene.cell);
      if (cell.dimension() != 3) continue;
      Soup soup;
      for (const auto& t : scene.mesh.triangles) {
        soup.push_back(
            {to_exact(scene.mesh.points[t[0]]), to_exact(scene.mesh.points[t[1]]), to_exact(scene.mesh.points[t[2]])});
      }
      for (std::size_t i = 0; i < soup.size(); i += 3) {
        const Point3 p = CGAL::centroid(soup[i][0], soup[i][1], soup[i][2]);
        if (cell.contains(p)) continue;
        const Plane3 front(soup[i][0], soup[i][1], soup[i][2]);
        for (const Plane3& side : {front, front.opposite()}) {
          const auto answer = point_occlusion(p, side, cell, soup);
          // Triangles whose plane holds p and the line meet only p in general position; leave out those that contain p.
          Soup others;
          for (const auto& t : soup) {
            if (!Kernel::Triangle_3(t[0], t[1], t[2]).has_on(p)) others.push_back(t);
          }
          (answer.occluded ? hidden : open)++;
          if (!answer.occluded) {
            ASSERT_TRUE(side.has_on_positive_side(*answer.witness));
            ASSERT_TRUE(free_line(p, *answer.witness, cell, others)) << scene.name << " triangle " << i;
            continue;
          }
          fuzz::Random random(index);
          for (int k = 0; k < 10; ++k) {
            std::vector<int> weights(cell.vertices().size());
            for (int& w : weights) w = 1 + random.between(0, 9) * random.between(0, 9);
            const Point3 v = cell.interior_point(weights);
            if (side.has_on_positive_side(v)) {
              ASSERT_FALSE(free_line(p, v, cell, others)) << scene.name << " triangle " << i;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(hidden, 50);
  EXPECT_GT(open, 50);
}

// Whatever a flat cell sees, so does a solid one around it, as long as no geometry is near either.
TEST(PointOcclusionRandom, AFlatCellSeesNoMoreThanASolidAroundIt) {
  fuzz::Random random(5);
  int open = 0;
  for (int round = 0; round < 80; ++round) {
    std::vector<Point3> flat, solid;
    for (int i = 0; i < 5; ++i) {
      const Point3 q = random_point(random, -20, -20, 8);
      flat.push_back(q);
      solid.push_back(q + Vector3(FT(-1) / 4, 0, 0));
      solid.push_back(q + Vector3(FT(1) / 4, 0, 0));
    }
    const ConvexCell thin(flat), thick(solid);
    const Point3 p = random_point(random, 4, 8, 4);
    Soup soup;
    for (int n = random.between(4, 20); n > 0; --n) add_random_triangle(soup, random, -15, 3, 12);
    const auto answer = point_occlusion(p, std::nullopt, thin, soup);
    if (answer.occluded || thick.dimension() != 3) continue;
    ++open;
    EXPECT_FALSE(point_occlusion(p, std::nullopt, thick, soup).occluded) << round;
    EXPECT_TRUE(free_line(p, *answer.witness, thick, soup)) << round;
  }
  EXPECT_GT(open, 10);
}

}  // namespace
}  // namespace clues::exact
