// Umbrae against CGAL's Nef polyhedra. What one convex blocker hides from V is what it hides from every vertex of V: the intersection of its shadows. Two
// blockers that do not fuse hide the union of what each hides.
#include <gtest/gtest.h>

#include "reference/visibility/hidden/umbra.h"
#include "tests/reference/nef_volume.h"
#include "tests/reference/support.h"
#include "validate/certificates/umbra_certificate.h"
#include "validate/certificates/umbra_file.h"

namespace clues::test {
namespace {

using exact::Point3;

// Within the same bounds.
mpq_class umbra_volume(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  const reference::Omega omega(mesh, cell, {});
  const reference::Box box{Point3(-6, -6, -1), Point3(6, 6, 6)};
  const auto record = validate::record_of(reference::build_umbra(omega, box, 0));
  EXPECT_TRUE(validate::check_umbra_certificate(mesh, cell, record.facets).valid);
  return mpq_class(validate::enclosed_volume(record.facets).get_str());
}

std::vector<Corner> corners_of(const exact::ConvexCell& cell) {
  std::vector<Corner> all;
  for (const Point3& s : cell.vertices()) {
    Corner& c = all.emplace_back();
    for (int i = 0; i < 3; ++i) c[static_cast<std::size_t>(i)] = mpq_class(exact::to_string_exact(s[i]));
  }
  return all;
}

struct Tetrahedron {
  std::array<scene::Point, 4> p;
  void add_to(SceneBuilder& s) const {
    s.triangle(p[0], p[2], p[1]);
    s.triangle(p[0], p[1], p[3]);
    s.triangle(p[1], p[2], p[3]);
    s.triangle(p[2], p[0], p[3]);
  }
  std::vector<Corner> corners() const {
    std::vector<Corner> all;
    for (const scene::Point& x : p) all.push_back({mpq_class(x[0]), mpq_class(x[1]), mpq_class(x[2])});
    return all;
  }
};

TEST(UmbraAgainstNef, OneTetrahedron) {
  const Tetrahedron t{{{{-2, -1, 1.5}, {2, -1.5, 1}, {0.5, 2, 1.25}, {0.25, 0, 3}}}};
  for (const auto& cell : {box_cell(-1, -1, -0.5, 0.5, 1, 0), box_cell(-0.5, -0.25, 0, 0.5, 0.75, 0)}) {
    SceneBuilder s;
    t.add_to(s);
    EXPECT_EQ(umbra_volume(s.mesh(), cell), hidden_volume({t.corners()}, corners_of(cell)));
  }
}

TEST(UmbraAgainstNef, TwoTetrahedraApart) {
  const Tetrahedron t{{{{-4, -1, 1.5}, {-2, -1.5, 1}, {-2.5, 2, 1.25}, {-3, 0, 2}}}};
  const Tetrahedron u{{{{2.5, -1, 2.5}, {4, -1.5, 2}, {3.5, 1, 2.25}, {3, 0, 3}}}};
  const auto cell = box_cell(-0.5, -0.5, -0.5, 0.5, 0.5, 0);
  SceneBuilder s;
  t.add_to(s);
  u.add_to(s);
  EXPECT_EQ(umbra_volume(s.mesh(), cell), hidden_volume({t.corners(), u.corners()}, corners_of(cell)));
}

}  // namespace
}  // namespace clues::test
