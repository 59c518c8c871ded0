// D14 with flat cells and segments: where no sight line is in general position is known at once, and where some are, one of them is found mostly. Against sight lines
// from many points of the cell.
#include "reference/visibility/labels/special_position.h"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/cell/cell_plane.h"
#include "exact/complex/complex.h"
#include "fuzz/generators/random.h"
#include "tests/differential/touching_series.h"

namespace clues::tests {
namespace {

using exact::FT;
using exact::Point3;

struct Counts {
  int none = 0, found = 0, wrong = 0, missed = 0;
};

class Place {
 public:
  Place(const fuzz::Case& scene, const exact::ConvexCell& cell)
      : cell_(cell),
        complex_(exact::build_complex(scene.mesh, &cell)),
        query_(complex_, cell),
        random_(fuzz::Random(scene.seed).next() ^ scene.index) {}

  void judge(Counts& counts) {
    const std::vector<Point3> viewpoints =
        cell_.dimension() == 2 ? exact::corners_of(cell_, cell_.facets()[0]) : cell_.vertices();
    for (int i = 0; i < 8; ++i) {
      const Point3 p = beside();
      if (cell_.contains(p) || CGAL::collinear(viewpoints[0], viewpoints[1], p)) continue;
      const reference::SpecialPosition special(query_, exact::Plane3(viewpoints[0], viewpoints[1], p));
      for (const bool off : {false, true}) judge_place(special.free_viewpoint(viewpoints, p, off), p, off, counts);
    }
  }

 private:
  // A point in a plane with V, near the scene.
  Point3 beside() {
    const auto& s = cell_.vertices();
    const auto share = [&] { return FT(random_.between(-60, 60)) / FT(17); };
    if (cell_.dimension() == 2) return s[0] + share() * (s[1] - s[0]) + share() * (s[2] - s[0]);
    return {share(), share(), share()};
  }
  Point3 of_cell() {
    std::vector<int> weights;
    for (std::size_t i = 0; i < cell_.vertices().size(); ++i) weights.push_back(random_.between(1, 1000));
    return cell_.interior_point(weights);
  }
  bool is_special(const Point3& v, const Point3& p, bool off_planes) const {
    return query_.crossings(v, p, off_planes).degenerate;
  }

  void judge_place(const std::optional<Point3>& found, const Point3& p, bool off_planes, Counts& counts) {
    ++(found ? counts.found : counts.none);
    if (!found) {
      for (int i = 0; i < 50; ++i) counts.wrong += is_special(of_cell(), p, off_planes) ? 0 : 1;
      return;
    }
    // Next to it. What goes through the plane has edges in it where it is cut there; of such edges it knows nothing.
    for (int i = 0; i < 6; ++i) {
      const Point3 near = *found + FT(std::ldexp(1, -12 - 4 * i)) * (of_cell() - *found);
      if (!is_special(near, p, off_planes)) return;
    }
    ++counts.missed;
  }

  const exact::ConvexCell& cell_;
  exact::Complex complex_;
  exact::SceneQuery query_;
  fuzz::Random random_;
};

TEST(SpecialPosition, IsWhereAllSightLinesAre) {
  Counts counts;
  for (std::uint64_t n = 0; n < 700; ++n) {
    const fuzz::Case scene = touching_scene(kTouchingSeed + 7, n);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    if (cell.dimension() == 1 || cell.dimension() == 2) Place(scene, cell).judge(counts);
  }
  EXPECT_EQ(counts.wrong, 0);
  EXPECT_LT(30 * counts.missed, counts.found);
  EXPECT_GT(counts.none, 100);
  EXPECT_GT(counts.found, 1000);
}

// What is left of the one above the plane touches it at two points only; between them it is the other's, too, and is crossed.
TEST(SpecialPosition, IsNotWhereTrianglesOverlapAcrossThePlane) {
  fuzz::Case scene;
  scene.mesh.points = {{-20, 5, -2}, {20, 5, -2}, {0, 5, 2}, {-20, 5, 2}, {20, 5, 2}, {0, 5, -2}};
  scene.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  scene.cell = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const auto cell = exact::ConvexCell::from_doubles(scene.cell);
  const auto complex = exact::build_complex(scene.mesh, &cell);
  const exact::SceneQuery query(complex, cell);
  const reference::SpecialPosition special(query, cell.facets()[0].plane);
  EXPECT_TRUE(special.free_viewpoint(cell.vertices(), {0, 10, 0}, false).has_value());
}

// Of a triangle in the plane that two walls cut, the middle piece is not among the occluders.
TEST(SpecialPosition, IsNotBehindWhatIsLeftOut) {
  fuzz::Case scene;
  scene.mesh.points = {{-8, 4, 0}, {8, 4, 0},  {0, 6, 0},  {-2, 3, -1}, {-2, 8, -1},
                       {-2, 5, 3}, {2, 3, -1}, {2, 8, -1}, {2, 5, 3}};
  scene.mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  scene.cell = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const auto cell = exact::ConvexCell::from_doubles(scene.cell);
  const auto complex = exact::build_complex(scene.mesh, &cell);
  std::vector<bool> occluders;
  for (const auto& piece : complex.pieces) {
    FT x(0);
    for (const auto i : piece.corners) x = x + complex.points[i].x();
    occluders.push_back(CGAL::abs(x) > FT(5));
  }
  const exact::SceneQuery query(complex, cell, occluders);
  const reference::SpecialPosition special(query, cell.facets()[0].plane);
  EXPECT_TRUE(special.free_viewpoint(cell.vertices(), {0, 10, 0}, false).has_value());
}

}  // namespace
}  // namespace clues::tests
