// D15 as a mesh: sewn, of the right area, and of the right shape.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "fuzz/generators/random_scenes.h"
#include "reference/delta/fragments.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"
#include "sewn_checks.h"
#include "tests/app/program.h"
#include "tests/reference/support.h"
#include "tests/seed.h"
#include "validate/stream/fragments_file.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Point3;
using reference::SewnMesh;

// A vector of twice the area.
exact::Vector3 area_of(const SewnMesh& mesh, std::uint64_t region) {
  exact::Vector3 sum(0, 0, 0);
  for (const auto& t : mesh.triangles) {
    if (t.region != region) continue;
    const Point3& a = mesh.points[t.corners[0]];
    sum += CGAL::cross_product(mesh.points[t.corners[1]] - a, mesh.points[t.corners[2]] - a);
  }
  return sum;
}

// Each fragment's area vector is that of its region: the fraction of its piece, towards the side that is seen.
void expect_areas(const reference::VisibilityMap& map, const reference::FragmentMesh& fragments) {
  for (std::uint64_t i = 0; i < fragments.regions.size(); ++i) {
    const reference::Region& r = map.regions[fragments.regions[i]];
    const auto& c = map.complex.pieces[r.piece].corners;
    const auto& at = map.complex.points;
    const exact::Vector3 piece = CGAL::cross_product(at[c[1]] - at[c[0]], at[c[2]] - at[c[0]]);
    EXPECT_EQ(area_of(fragments.mesh, i), (r.front ? FT(1) : FT(-1)) * r.area_fraction * piece);
  }
}

// Whether the rings are simple and apart, so that they bound a disc with holes.
bool is_simple(const reference::Region& r) {
  std::set<Point3> corners;
  std::size_t n = 0;
  for (const auto& ring : r.rings) {
    n += ring.size();
    corners.insert(ring.begin(), ring.end());
  }
  return n == corners.size();
}

TEST(SewnMesh, ACornerInsideASideCutsIt) {
  // Two squares on one side of an edge, one large on the other: the large one gets a corner in the middle.
  const auto square = [](int x0, int y0, int x1, int y1) {
    return reference::Rings3{{Point3(x0, y0, 0), Point3(x1, y0, 0), Point3(x1, y1, 0), Point3(x0, y1, 0)}};
  };
  const SewnMesh mesh = reference::sew({square(0, 0, 1, 1), square(0, 1, 1, 2), square(1, 0, 3, 2)});
  EXPECT_EQ(mesh.points.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 2U + 2U + 3U);
  EXPECT_EQ(flaws_of(mesh).text(), SewnFlaws{}.text());
}

TEST(SewnMesh, HolesBridgesAndTouchingRings) {
  const auto p = [](int x, int y) { return Point3(x, y, x + y); };
  // A square with two holes that touch the outline and each other in a corner, and a bridge that bounds nothing.
  const reference::Rings3 rings{{p(0, 0), p(4, 0), p(4, 4), p(2, 4), p(2, 3), p(2, 4), p(0, 4)},
                                {p(0, 0), p(1, 2), p(2, 1)},
                                {p(2, 1), p(3, 2), p(3, 1)}};
  const SewnMesh mesh = reference::sew({rings});
  EXPECT_EQ(flaws_of(mesh).text(), SewnFlaws{}.text());
  FT area(0);
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.points[t.corners[0]], &b = mesh.points[t.corners[1]], &c = mesh.points[t.corners[2]];
    area += CGAL::cross_product(b - a, c - a).z();
  }
  EXPECT_EQ(area, FT(32 - 3 - 1));
}

TEST(SewnMeshChecks, NoticeWhatIsNotSewn) {
  const SewnMesh good = reference::sew(
      {{{Point3(0, 0, 0), Point3(2, 0, 0), Point3(0, 2, 0)}}, {{Point3(0, 2, 0), Point3(2, 0, 0), Point3(2, 2, 0)}}});
  SewnMesh crack = good;
  crack.points.emplace_back(1, 1, 0);
  EXPECT_EQ(flaws_of(crack).points_in_sides, 1U);
  SewnMesh turned = good;
  std::swap(turned.triangles[0].corners[0], turned.triangles[0].corners[1]);
  turned.triangles[0].region = turned.triangles[1].region;
  EXPECT_GT(flaws_of(turned).reversed_triangles, 0U);
}

// A shadow inside of a triangle: a region with a hole.
TEST(Fragments, OfARegionWithAHole) {
  SceneBuilder scene;
  scene.plate(2, -2, 3, -1, 4);
  scene.plate(-20, -20, 20, 20, 8);
  const auto map = map_of(scene.mesh(), box_cell(0, -1, -1, 1, 0, 0));
  const auto fragments = reference::visible_fragments(map);
  EXPECT_EQ(flaws_of(fragments.mesh).text(), SewnFlaws{}.text());
  expect_areas(map, fragments);
  std::uint64_t with_holes = 0;
  for (std::uint64_t i = 0; i < fragments.regions.size(); ++i) {
    const auto& r = map.regions[fragments.regions[i]];
    if (r.rings.size() == 1 || !is_simple(r)) continue;
    ++with_holes;
    EXPECT_EQ(euler_characteristic(fragments.mesh, i), 2 - static_cast<int>(r.rings.size()));
  }
  EXPECT_GT(with_holes, 0U);
}

// An input edge that is cut by regions on one side only: each neighbour has all corners of the other.
TEST(Fragments, HaveNoCrackAlongTheEdgesOfTheInput) {
  SceneBuilder scene;
  scene.plate(-1, -1, 1, 1, 4);
  scene.plate(-20, -20, 20, 20, 8);
  const auto map = map_of(scene.mesh(), box_cell(-2, -1, -1, 0, 1, 0));
  const auto fragments = reference::visible_fragments(map);
  EXPECT_EQ(flaws_of(fragments.mesh).text(), SewnFlaws{}.text());
  expect_areas(map, fragments);
  std::set<std::size_t> rings;
  for (std::uint64_t i = 0; i < fragments.regions.size(); ++i) {
    const auto& r = map.regions[fragments.regions[i]];
    rings.insert(r.rings.size());
    if (is_simple(r)) {
      EXPECT_EQ(euler_characteristic(fragments.mesh, i), 2 - static_cast<int>(r.rings.size()));
    }
  }
  EXPECT_FALSE(rings.empty());
}

// Far from the origin, where floats alone would not do.
TEST(Fragments, InBinaryGltfComeBackFromOurReader) {
  SceneBuilder scene;
  constexpr double far = 1 << 24;
  scene.plate(far - 1, -1, far + 1, 1, 4);
  scene.plate(far - 20, -20, far + 20, 20, 8);
  auto record = validate::fragments_of(map_of(scene.mesh(), box_cell(far - 2, -1, -1, far, 1, 0)));
  const tests::TestFolder folder;
  const auto read = scene::read_scene(folder.write("f.glb", validate::to_bytes_of(record, "f.glb"))).mesh;
  ASSERT_EQ(read.triangles.size(), record.fragments.size());
  EXPECT_EQ(read.points.size(), record.rounded.size());
  for (std::size_t t = 0; t < read.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const scene::Point &got = read.points[read.triangles[t][k]],
                         &wanted = record.rounded[record.fragments[t].corners[k]];
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-5);
    }
  }
  record.rounded[0] = {1e39, 0, 0};
  EXPECT_THROW(validate::to_glb_bytes(record), scene::Error);
  record.fragments.clear();
  EXPECT_TRUE(validate::to_glb_bytes(record).starts_with("glTF"));
}

void expect_sewn(std::uint64_t per_kind) {
  std::uint64_t simple = 0, triangles = 0, cut_sides = 0;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < per_kind; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      const auto map = map_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell));
      const auto fragments = reference::visible_fragments(map);
      ASSERT_EQ(flaws_of(fragments.mesh).text(), SewnFlaws{}.text());
      expect_areas(map, fragments);
      triangles += fragments.mesh.triangles.size();
      for (std::uint64_t k = 0; k < fragments.regions.size(); ++k) {
        const auto& r = map.regions[fragments.regions[k]];
        if (!is_simple(r)) continue;
        ++simple;
        EXPECT_EQ(euler_characteristic(fragments.mesh, k), 2 - static_cast<int>(r.rings.size()));
        std::set<std::uint64_t> corners;
        for (const auto& t : fragments.mesh.triangles) {
          if (t.region == k) corners.insert(t.corners.begin(), t.corners.end());
        }
        std::size_t own = 0;
        for (const auto& ring : r.rings) own += ring.size();
        cut_sides += corners.size() > own;
      }
    }
  }
  EXPECT_GT(triangles, 0U);
  EXPECT_GT(simple, 0U);
  EXPECT_GT(cut_sides, 0U);  // corners of neighbours were put into sides
}

TEST(Fragments, OfRandomScenesAreSewn) { expect_sewn(2); }

TEST(FragmentsLong, OfRandomScenesAreSewn) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_sewn(50);
}

}  // namespace
}  // namespace clues::test
