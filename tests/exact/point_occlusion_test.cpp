// D18: the point-occlusion oracle against closed forms, touching and flat cases (D3, D5).
#include "exact/sight/point_occlusion.h"

#include <gtest/gtest.h>

#include "scene/messages/error.h"

namespace clues::exact {
namespace {

using Soup = std::vector<TriangleCorners>;

ConvexCell box(int x0, int y0, int z0, int x1, int y1, int z1) {
  std::vector<Point3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0);
  return ConvexCell(points);
}

// The rectangle [y0,y1] x [z0,z1] at x as two triangles.
void add_screen(Soup& soup, const FT& x, const FT& y0, const FT& z0, const FT& y1, const FT& z1) {
  soup.push_back({Point3(x, y0, z0), Point3(x, y1, z0), Point3(x, y1, z1)});
  soup.push_back({Point3(x, y0, z0), Point3(x, y1, z1), Point3(x, y0, z1)});
}

Soup screen(const FT& x, const FT& y0, const FT& z0, const FT& y1, const FT& z1) {
  Soup soup;
  add_screen(soup, x, y0, z0, y1, z1);
  return soup;
}

bool occluded(const Point3& p, const ConvexCell& cell, const Soup& soup, std::optional<Plane3> side = std::nullopt) {
  const auto answer = point_occlusion(p, side, cell, soup);
  if (!answer.occluded && answer.witness) {
    EXPECT_TRUE(cell.interior_contains(*answer.witness));
  }
  EXPECT_FALSE(answer.occluded && answer.witness);
  return answer.occluded;
}

const ConvexCell cell = box(-2, -1, -1, -1, 1, 1);
const Point3 eye(1, 0, 0);  // the cell's front facet x = -1 is 2 away: it shades half its size at x = 0

TEST(PointOcclusion, NothingInTheWay) { EXPECT_FALSE(occluded(eye, cell, {})); }

TEST(PointOcclusion, AScreenOfExactlyTheShadowsSizeHides) {
  const FT half = FT(1) / FT(2), little = FT(1) / FT(1000000);
  EXPECT_TRUE(occluded(eye, cell, screen(0, -half, -half, half, half)));
  EXPECT_FALSE(occluded(eye, cell, screen(0, -half, -half, half, half - little)));
  EXPECT_FALSE(occluded(eye, cell, screen(0, -half + little, -half, half, half)));
}

TEST(PointOcclusion, TrianglesThatOnlyShareAnEdgeLeaveNoSlit) {
  Soup soup;
  for (int i = -2; i < 2; ++i) {
    for (int j = -2; j < 2; ++j) add_screen(soup, 0, i, j, i + 1, j + 1);
  }
  EXPECT_TRUE(occluded(eye, cell, soup));
}

TEST(PointOcclusion, APinholeIsFound) {
  // Four screens around a hole of side 2e, at an odd place.
  const FT e = FT(1) / FT(1 << 20), y = FT(1) / FT(7), z = FT(-3) / FT(11);
  Soup soup;
  add_screen(soup, 0, -2, -2, y - e, 2);
  add_screen(soup, 0, y + e, -2, 2, 2);
  add_screen(soup, 0, y - e, -2, y + e, z - e);
  add_screen(soup, 0, y - e, z + e, y + e, 2);
  EXPECT_FALSE(occluded(eye, cell, soup));
  add_screen(soup, FT(1) / FT(2), (y - e) / 2, (z - e) / 2, (y + e) / 2, (z + e) / 2);  // its exact plug, nearer
  EXPECT_TRUE(occluded(eye, cell, soup));
  soup.pop_back();
  EXPECT_FALSE(occluded(eye, cell, soup));
}

TEST(PointOcclusion, EverySideOfAnInnerTriangleIsSearched) {
  // A triangle in the middle of the view and a ring around it that leaves a thin triangular gap along side k.
  const Point3 inner[] = {Point3(0, FT(-1) / 4, FT(-1) / 4), Point3(0, FT(1) / 4, FT(-1) / 4), Point3(0, 0, FT(1) / 4)};
  const Point3 outer[] = {Point3(0, -3, -1), Point3(0, 3, -1), Point3(0, 0, 4)};
  const auto ring = [&](Soup& soup, std::size_t k, const FT& gap) {
    const std::size_t n = (k + 1) % 3;
    const Point3 middle = CGAL::midpoint(inner[k], inner[n]);
    const Point3 tip = middle + (CGAL::midpoint(outer[k], outer[n]) - middle) * gap;
    soup.push_back({inner[k], outer[k], gap == 0 ? inner[n] : tip});
    soup.push_back({tip, outer[k], outer[n]});
    soup.push_back({inner[n], outer[n], gap == 0 ? inner[k] : tip});
  };
  for (std::size_t k = 0; k < 3; ++k) {
    Soup soup{{inner[0], inner[1], inner[2]}};
    ring(soup, (k + 1) % 3, 0);
    ring(soup, (k + 2) % 3, 0);
    ring(soup, k, FT(1) / FT(1 << 16));
    EXPECT_FALSE(occluded(eye, cell, soup));
    ring(soup, k, 0);
    EXPECT_TRUE(occluded(eye, cell, soup));
  }
}

TEST(PointOcclusion, GeometryBehindOrInsideTheCellDoesNotHide) {
  EXPECT_FALSE(occluded(eye, cell, screen(-3, -9, -9, 9, 9)));
  EXPECT_FALSE(occluded(eye, cell, screen(FT(-3) / FT(2), -9, -9, 9, 9)));  // through int V (D3)
  EXPECT_FALSE(occluded(eye, cell, screen(2, -9, -9, 9, 9)));               // behind p
}

TEST(PointOcclusion, GeometryOnTheCellsSurfaceHides) {
  EXPECT_TRUE(occluded(eye, cell, screen(-1, -1, -1, 1, 1)));
  EXPECT_FALSE(occluded(eye, cell, screen(-1, -1, -1, 1, FT(1) / FT(2))));
  // From a place that sees two facets both have to be covered.
  const Point3 corner(1, 5, 0);
  Soup soup = screen(-1, -1, -1, 1, 1);
  EXPECT_FALSE(occluded(corner, cell, soup));
  soup.push_back({Point3(-2, 1, -1), Point3(-1, 1, -1), Point3(-1, 1, 1)});
  soup.push_back({Point3(-2, 1, -1), Point3(-1, 1, 1), Point3(-2, 1, 1)});
  EXPECT_TRUE(occluded(corner, cell, soup));
}

TEST(PointOcclusion, TrianglesThatTouchP) {
  // A face of the target: p inside, on its edge, at its corner, in a plane apart from the cell.
  EXPECT_FALSE(occluded(eye, cell, screen(1, -1, -1, 1, 1)));
  EXPECT_FALSE(occluded(eye, cell, screen(1, 0, 0, 1, 1)));
  // Flat cones towards the cell: they block single lines, never all; the witness has to go around them.
  Soup fins;
  for (int i = -3; i <= 3; ++i) {
    fins.push_back({eye, Point3(0, -4, i), Point3(0, 4, i)});
    fins.push_back({eye, Point3(0, i, -4), Point3(0, i, 4)});
    fins.push_back({eye, Point3(0, -4, -4 + i), Point3(0, 4, 4 + i)});
  }
  EXPECT_FALSE(occluded(eye, cell, fins));
  // p on the edge of a triangle that reaches in front of it (a wall at right angles).
  EXPECT_FALSE(occluded(eye, cell, {{Point3(1, 0, -1), Point3(1, 0, 1), Point3(0, 0, 0)}}));
}

TEST(PointOcclusion, APointOfTheCellIsSeen) {
  const Soup soup = screen(-1, -9, -9, 9, 9);
  EXPECT_FALSE(occluded(Point3(-1, 0, 0), cell, soup));
  EXPECT_FALSE(occluded(Point3(FT(-3) / FT(2), 0, 0), cell, soup));
  const auto away = point_occlusion(Point3(-1, 0, 0), Plane3(1, 0, 0, 1), cell, soup);
  EXPECT_FALSE(away.occluded);
  EXPECT_FALSE(away.witness.has_value());
}

TEST(PointOcclusion, TheSideRestrictsTheCell) {
  // p in the plane z = 0 which halves the cell; the upper half is hidden.
  const Soup upper = screen(0, -2, 0, 2, 2);
  EXPECT_FALSE(occluded(eye, cell, upper));
  EXPECT_TRUE(occluded(eye, cell, upper, Plane3(0, 0, 1, 0)));
  EXPECT_FALSE(occluded(eye, cell, upper, Plane3(0, 0, -1, 0)));
  // Nothing of the cell on that side.
  EXPECT_TRUE(occluded(Point3(1, 0, 1), cell, {}, Plane3(0, 0, 1, -1)));
  EXPECT_FALSE(occluded(Point3(1, 0, 1), cell, {}, Plane3(0, 0, -1, 1)));
  EXPECT_THROW(occluded(eye, cell, {}, Plane3(0, 0, 1, -1)), scene::Error);
}

TEST(PointOcclusion, FlatCellSeenFromOutsideItsPlane) {
  const ConvexCell flat({Point3(-1, -1, -1), Point3(-1, 1, -1), Point3(-1, 1, 1), Point3(-1, -1, 1)});
  const FT half = FT(1) / FT(2);
  EXPECT_FALSE(occluded(eye, flat, {}));
  EXPECT_TRUE(occluded(eye, flat, screen(0, -half, -half, half, half)));
  EXPECT_FALSE(occluded(eye, flat, screen(0, -half, -half, half, half - FT(1) / FT(1024))));
  // In the cell's own plane: a sight line to a point off the plane leaves it at once, unlike that of a solid
  // cell.
  EXPECT_FALSE(occluded(eye, flat, screen(-1, -9, -9, 9, 9)));
}

TEST(PointOcclusion, TheCreaseOfATentOnAFlatCellIsNoOpenPartOfIt) {
  const ConvexCell flat({Point3(-1, -1, -1), Point3(-1, 1, -1), Point3(-1, 1, 1), Point3(-1, -1, 1)});
  // Two half screens that lean on the cell along z = 0: all but the crease is hidden.
  const auto leaning = [](int z) {
    return Soup{{Point3(-1, -1, 0), Point3(-1, 1, 0), Point3(0, 3, z)},
                {Point3(-1, -1, 0), Point3(0, 3, z), Point3(0, -3, z)}};
  };
  Soup tent = leaning(2);
  EXPECT_FALSE(occluded(eye, flat, tent));
  for (const auto& t : leaning(-2)) tent.push_back(t);
  EXPECT_TRUE(occluded(eye, flat, tent));  // sight lines from the crease are free, and it has no area (D6)
}

// What stands on the cell, or behind it, may hold the viewpoint that comes to mind first.
TEST(PointOcclusion, AViewpointOnAFlatCellIsOffAllTrianglesThere) {
  const ConvexCell flat({Point3(-1, -1, -1), Point3(-1, 1, -1), Point3(-1, 1, 1), Point3(-1, -1, 1)});
  for (const int x : {-2, 0}) {
    Soup fins{{Point3(-1, -1, 0), Point3(-1, 1, 0), Point3(x, 0, 0)},
              {Point3(-1, 0, -1), Point3(-1, 0, 1), Point3(x, 0, 0)},
              {Point3(-1, -1, -1), Point3(-1, 1, 1), Point3(x, 0, 0)}};
    const auto answer = point_occlusion(eye, std::nullopt, flat, fins);
    ASSERT_FALSE(answer.occluded);
    EXPECT_NE(answer.witness->y(), FT(0));
    EXPECT_NE(answer.witness->z(), FT(0));
    EXPECT_NE(answer.witness->y(), answer.witness->z());
  }
}

TEST(PointOcclusion, FlatCellSeenInItsPlane) {
  const ConvexCell flat({Point3(-2, -1, 0), Point3(-1, -1, 0), Point3(-1, 1, 0), Point3(-2, 1, 0)});
  const FT half = FT(1) / FT(2);
  EXPECT_FALSE(occluded(eye, flat, {}));
  EXPECT_TRUE(occluded(eye, flat,
                       {{Point3(0, -half, -1), Point3(0, half, 1), Point3(0, -half, 1)},
                        {Point3(0, -half, -1), Point3(0, half, -1), Point3(0, half, 1)}}));
  // Only an edge reaches the plane, exactly as long as the shadow: closed, so it hides; shorter does not.
  EXPECT_TRUE(occluded(eye, flat, {{Point3(0, -half, 0), Point3(0, half, 0), Point3(0, 0, 1)}}));
  EXPECT_FALSE(occluded(eye, flat, {{Point3(0, -half, 0), Point3(0, half - FT(1) / FT(99), 0), Point3(0, 0, 1)}}));
  // A triangle in the plane with its corner at p blocks the directions of its cone.
  EXPECT_TRUE(occluded(eye, flat, {{eye, Point3(0, -1, 0), Point3(0, 1, 0)}}));
  EXPECT_FALSE(occluded(eye, flat, {{eye, Point3(0, -1, 0), Point3(0, 0, 0)}}));
  EXPECT_TRUE(occluded(eye, flat, {{Point3(2, -9, 0), Point3(2, 9, 0), Point3(0, 0, 0)}}));  // p inside it
  EXPECT_FALSE(occluded(eye, flat, {{eye, Point3(2, -9, 0), Point3(2, 9, 0)}}));             // all behind p
  // On the cell's edge: hides. In its interior: p sees what is before it.
  EXPECT_TRUE(occluded(eye, flat, {{Point3(-1, -1, 0), Point3(-1, 1, 0), Point3(-1, 0, 1)}}));
  const Soup across{{Point3(FT(-3) / FT(2), -9, 0), Point3(FT(-3) / FT(2), 9, 0), Point3(FT(-3) / FT(2), 0, 1)}};
  const auto before = point_occlusion(eye, std::nullopt, flat, across);
  ASSERT_FALSE(before.occluded);
  EXPECT_GT(before.witness->x(), FT(-3) / FT(2));
  // A triangle in the plane, within the cell: the same, and one that holds all of the cell hides it.
  EXPECT_FALSE(occluded(eye, flat, {{Point3(-2, -9, 0), Point3(-2, 9, 0), Point3(FT(-5) / FT(4), 0, 0)}}));
  EXPECT_TRUE(occluded(eye, flat, {{Point3(-9, -9, 0), Point3(-9, 9, 0), Point3(0, 0, 0)}}));
}

TEST(PointOcclusion, SegmentCell) {
  const ConvexCell segment({Point3(-1, -1, 0), Point3(-1, 1, 0)});
  const FT half = FT(1) / FT(2);
  EXPECT_FALSE(occluded(eye, segment, {}));
  EXPECT_TRUE(occluded(eye, segment, {{Point3(0, -half, 0), Point3(0, half, 0), Point3(0, 0, 1)}}));
  // The ends need not be hidden; anything inside must be.
  EXPECT_FALSE(occluded(eye, segment, {{Point3(0, -half, 0), Point3(0, half - FT(1) / FT(99), 0), Point3(0, 0, 1)}}));
}

// The triangle's section with the plane of p and the segment crosses the segment's line between its corners.
TEST(PointOcclusion, AShadowEndsWhereItsTriangleCrossesTheLineOfASegmentCell) {
  const ConvexCell segment({Point3(0, 0, 0), Point3(1, 0, 0)});
  const FT half = FT(1) / FT(2);
  const Soup one{{Point3(-half, -1, half), Point3(-half, 1, half), Point3(FT(13) / FT(4), 0, -1)}};
  const Point3 p(half, 0, 1);
  const auto answer = point_occlusion(p, std::nullopt, segment, one);
  ASSERT_FALSE(answer.occluded);
  EXPECT_GT(answer.witness->x(), FT(3) / FT(4));
  EXPECT_FALSE(occluded(p, ConvexCell({Point3(FT(3) / FT(4), 0, 0), Point3(1, 0, 0)}), one));
  EXPECT_TRUE(occluded(p, ConvexCell({Point3(0, 0, 0), Point3(FT(3) / FT(4), 0, 0)}), one));
}

TEST(PointOcclusion, AFreePointOfASegmentCellIsNoOpenPartOfIt) {
  const ConvexCell segment({Point3(-1, -1, 0), Point3(-1, 1, 0)});
  // Each triangle stands on the segment and hides one half; sight lines from the point where they meet are
  // free.
  const Soup halves{{Point3(-1, 0, 0), Point3(0, -2, 0), Point3(-1, -2, 0)},
                    {Point3(-1, 0, 0), Point3(0, 2, 0), Point3(-1, 2, 0)}};
  EXPECT_TRUE(occluded(eye, segment, halves));
  EXPECT_FALSE(occluded(eye, segment, {halves[0]}));
}

TEST(PointOcclusion, SegmentSeenEndOnAndPointCell) {
  const ConvexCell segment({Point3(-1, 0, 0), Point3(-2, 0, 0)});
  const Soup at_end{{Point3(-1, 0, 0), Point3(-1, 1, 0), Point3(-1, 0, 1)}};
  const Soup inside{{Point3(FT(-3) / FT(2), 0, 0), Point3(FT(-3) / FT(2), 1, 0), Point3(FT(-3) / FT(2), 0, 1)}};
  EXPECT_FALSE(occluded(eye, segment, {}));
  EXPECT_TRUE(occluded(eye, segment, at_end));
  EXPECT_FALSE(occluded(eye, segment, inside));  // its nearer half is seen
  EXPECT_GT(point_occlusion(eye, std::nullopt, segment, inside).witness->x(), FT(-3) / FT(2));
  EXPECT_TRUE(occluded(Point3(-3, 0, 0), segment, {{Point3(-2, 0, 0), Point3(-1, 0, 0), Point3(-1, 1, 0)}}));
  const ConvexCell point({Point3(-1, 0, 0)});
  EXPECT_FALSE(occluded(eye, point, at_end));  // the point itself is int V
  EXPECT_TRUE(occluded(eye, point, {{Point3(0, 0, 0), Point3(0, 1, 0), Point3(0, 0, 1)}}));  // a corner grazes
  EXPECT_FALSE(occluded(eye, point, {{eye, Point3(1, 1, 0), Point3(1, 0, 1)}}));
  EXPECT_TRUE(occluded(eye, point, {{eye, Point3(0, 0, 0), Point3(0, 0, 1)}}));  // an edge along the line
}

}  // namespace
}  // namespace clues::exact
