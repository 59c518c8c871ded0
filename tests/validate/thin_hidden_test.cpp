// D3, D18 for cells without an interior: proofs that triangles are hidden, and whole visible sets, against the plain way
// (thin_cells.h); with a planted defect too, which the comparison has to notice.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include "tests/validate/thin_scenes.h"
#include "validate/certificates/umbra_certificate.h"
#include "validate/visible_set/visible_set.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using exact::Plane3;
using exact::Point3;
using thin::Frustum;
using thin::is_sight_line;
using thin::Line;
using thin::Random;
using thin::Scene;
using thin::text;
using thin::Triangle;

using HiddenProof = std::function<bool(const scene::TriangleMesh&, const ConvexCell&, const UmbraCertificate&, bool)>;

struct Proved {
  int triangles = 0, hidden = 0, meet_cell = 0, wrong = 0;
};

Proved compare_proofs(int dimension, std::uint64_t seed, const HiddenProof& proves, bool complain) {
  Random random(seed + 20 + static_cast<std::uint64_t>(dimension));
  Proved total;
  while (total.triangles < thin::kPoints) {
    const Frustum frustum(random, dimension);
    Scene scene(random, dimension, 1);
    scene.cell = frustum.cell;
    const ConvexCell cell = scene.exact_cell();
    for (int k = 0; k < 5; ++k) {
      const bool strictly_inside = random.one_in(2);
      const Triangle t = frustum.triangle(random, scene, !strictly_inside);
      scene.soup = {frustum.plate, t};
      const scene::TriangleMesh mesh = scene.mesh();
      if (k == 0) {
        const auto verdict = check_umbra_certificate(mesh, cell, frustum.facets);
        if (!verdict.valid) ADD_FAILURE() << verdict.reason << "\n" << scene.words();
      }
      const bool meets = thin::meets(frustum.cell, t);
      total.meet_cell += meets ? 1 : 0;
      for (const bool front : {true, false}) {
        ++total.triangles;
        const bool hidden = proves(mesh, cell, frustum.facets, front);
        total.hidden += hidden ? 1 : 0;
        const RVector n = front ? thin::normal_of(t) : times(thin::normal_of(t), Rational(-1));
        bool right = !hidden || !meets;
        for (int i = 0; i < 3 && right && hidden; ++i)
          right = thin::is_occluded(frustum.cell, {frustum.plate}, Scene::on(t, random, true), n);
        const bool faces_away = std::none_of(frustum.cell.corners.begin(), frustum.cell.corners.end(),
                                             [&](const RVector& x) { return sgn(dot(n, minus(x, t[0]))) > 0; });
        right = right && (hidden || meets || !(faces_away || strictly_inside));
        if (right) continue;
        ++total.wrong;
        if (complain) ADD_FAILURE() << (hidden ? "proved hidden" : "not proved hidden") << "\n" << scene.words();
        if (total.wrong > 3) return total;
      }
    }
  }
  return total;
}

bool ask_proof(const scene::TriangleMesh& mesh, const ConvexCell& cell, const UmbraCertificate& facets, bool front) {
  return proves_hidden(mesh, cell, facets, 1, front);
}

TEST(ThinCells, ProofsThatTrianglesAreHiddenAgreeWithThePlainWay) {
  const std::uint64_t s = thin::seed_of_run();
  for (const int dimension : {0, 1, 2}) {
    const Proved p = compare_proofs(dimension, s, ask_proof, true);
    std::cout << "dimension " << dimension << ": " << p.triangles << " sides of triangles, " << p.hidden << " hidden; "
              << p.meet_cell << " triangles meet the cell\n";
    EXPECT_GT(p.hidden, 1000);
    EXPECT_GT(p.meet_cell, 100);
  }
}

// As it was once: a side that nothing of the cell is before is hidden, and nobody asks whether the triangle
// touches the cell.
TEST(ThinCells, AProofThatDoesNotAskForTheCellIsCaught) {
  const auto faces_away = [](const scene::TriangleMesh& mesh, const ConvexCell& cell, const UmbraCertificate& facets,
                             bool front) {
    const auto corner = [&](std::size_t i) { return exact::to_exact(mesh.points[mesh.triangles[1][i]]); };
    const Plane3 plane(corner(0), corner(1), corner(2));
    const auto before = front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
    return ask_proof(mesh, cell, facets, front) ||
           std::none_of(cell.vertices().begin(), cell.vertices().end(),
                        [&](const Point3& x) { return plane.oriented_side(x) == before; });
  };
  const std::uint64_t s = thin::seed_of_run();
  for (const int dimension : {0, 1, 2}) EXPECT_EQ(compare_proofs(dimension, s, faces_away, false).wrong, 4);
}

// Hidden: no point of a triangle that no other touches is seen. Visible: the witness is one. From a point,
// the triangle itself is the polygon to be covered.
TEST(ThinCells, VisibleSetsAgreeWithThePlainWay) {
  const std::uint64_t s = thin::seed_of_run();
  for (const int dimension : {0, 1, 2}) {
    Random random(s + 30 + static_cast<std::uint64_t>(dimension));
    int visible = 0, hidden = 0, points = 0;
    for (int round = 0; round < 300; ++round) {
      Scene scene(random, dimension, 6);
      if (round % 3 != 0) {  // most of it behind a plate
        const Frustum frustum(random, dimension);
        scene.cell = frustum.cell;
        scene.soup = {frustum.plate};
        for (int k = random.between(1, 4); k > 0; --k)
          scene.soup.push_back(frustum.triangle(random, scene, random.one_in(3)));
      }
      VisibleSetOptions options;
      options.trust_map = false;
      options.points_first = round % 2 == 0;
      const VisibleSet set = exact_visible_set(scene.mesh(), scene.exact_cell(), options);
      for (std::uint32_t i = 0; i < scene.soup.size(); ++i) {
        const Triangle& t = scene.soup[i];
        const TriangleSight& told = set.triangles[i];
        ASSERT_EQ(told.meets_cell, thin::meets(scene.cell, t)) << i << "\n" << scene.words();
        if (told.meets_cell) continue;
        (told.sight == Sight::visible ? visible : hidden)++;
        if (told.sight == Sight::visible) {
          ASSERT_TRUE(told.witness.has_value());
          const Line line{scene, i, told.witness->front, read(told.witness->v), read(told.witness->p)};
          ASSERT_TRUE(is_sight_line(line) && !thin::is_shaded(scene.cell, scene.soup, line.p, line.v));
          continue;
        }
        ASSERT_EQ(told.sight, Sight::hidden);
        std::vector<Triangle> others = scene.soup;
        others.erase(others.begin() + i);
        if (dimension == 0) {
          const RVector& v = scene.cell.corners[0];
          const bool beside = sgn(dot(thin::normal_of(t), minus(v, t[0]))) != 0;
          ASSERT_TRUE(!beside || thin::is_occluded({{t[0], t[1], t[2]}}, others, v, std::nullopt)) << scene.words();
        }
        for (int k = 0; k < 12; ++k) {
          const RVector p = Scene::on(t, random, true);
          if (std::any_of(others.begin(), others.end(), [&](const Triangle& x) { return thin::holds(x, p); })) continue;
          ++points;
          for (const int sign : {1, -1}) {
            ASSERT_TRUE(thin::is_occluded(scene.cell, others, p, times(thin::normal_of(t), Rational(sign))))
                << "triangle " << i << " is seen at " << text(p) << "\n"
                << scene.words();
          }
        }
      }
    }
    std::cout << "dimension " << dimension << ": " << visible << " visible, " << hidden << " hidden triangles, "
              << points << " points of these\n";
    EXPECT_GT(visible, 100);
    EXPECT_GT(hidden, 30);
    EXPECT_GT(points, 300);
  }
}

}  // namespace
}  // namespace clues::validate
