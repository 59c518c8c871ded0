// D27: slices of the umbra have their exact areas, which integrate to its volume; and what they hide is hidden.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <set>

#include "fuzz/generators/random_scenes.h"
#include "reference/delta/virtual_occluders.h"
#include "reference/visibility/hidden/umbra_slice.h"
#include "tests/reference/support.h"
#include "tests/seed.h"
#include "validate/certificates/umbra_certificate.h"
#include "validate/certificates/umbra_file.h"
#include "validate/verdicts/judge.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Plane3;
using reference::Approach;

Plane3 at_height(const FT& z) { return {0, 0, 1, -z}; }

FT area_at(const reference::Umbra& umbra, const FT& z, Approach approach) {
  return reference::slice_of(umbra, at_height(z), approach).twice_area / FT(2);
}

struct PlateBeforeReceiver {
  SceneBuilder scene;
  exact::ConvexCell cell = box_cell(-2, -1, -1, 0, 1, 0);
  PlateBeforeReceiver() {
    scene.plate(-1, -1, 1, 1, 4);
    scene.plate(-20, -20, 20, 20, 8);
  }
  reference::Umbra umbra() const {
    return reference::build_umbra(reference::Omega(scene.mesh(), cell, {}), std::nullopt, 1);
  }
};

TEST(UmbraSlices, OfScenePHaveTheirExactAreas) {
  const auto umbra = PlateBeforeReceiver().umbra();
  for (int i = 0; i <= 16; ++i) {
    const FT h = FT(4) + FT(i) / 4;
    const Approach approach = i == 0 ? Approach::before : Approach::behind;
    EXPECT_EQ(area_at(umbra, h, approach), (FT(44) - h) / 10) << i;
    if (i > 0 && i < 16) {
      EXPECT_EQ(area_at(umbra, h, Approach::before), (FT(44) - h) / 10);
    }
  }
  EXPECT_EQ(area_at(umbra, FT(4), Approach::behind), FT(0));  // below the plate all is seen
  EXPECT_GE(area_at(umbra, FT(8), Approach::before), FT(1600));
}

// Between two heights of corners the area is a polynomial of degree two, for which Simpson's rule is exact.
FT integral(const reference::Umbra& umbra) {
  std::set<FT> heights;
  for (const auto& f : umbra.facets) {
    for (const auto& p : f.corners) heights.insert(p.z());
  }
  FT volume(0);
  const FT* last = nullptr;
  for (const FT& z : heights) {
    if (last != nullptr) {
      const FT sum = area_at(umbra, *last, Approach::before) + area_at(umbra, z, Approach::behind) +
                     FT(4) * area_at(umbra, (*last + z) / FT(2), Approach::before);
      volume += (z - *last) / FT(6) * sum;
    }
    last = &z;
  }
  return exact::collapsed(volume);
}

std::string volume_of(const reference::Umbra& umbra) {
  return validate::enclosed_volume(validate::record_of(umbra).facets).get_str();
}

TEST(UmbraSlices, OfScenePIntegrateToItsVolume) {
  const auto umbra = PlateBeforeReceiver().umbra();
  EXPECT_EQ(exact::to_string_exact(integral(umbra)), volume_of(umbra));
}

void expect_volumes(std::uint64_t first, std::uint64_t end) {
  std::uint64_t umbrae = 0;
  for (const fuzz::Kind kind : {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra, fuzz::Kind::loose_triangles}) {
    for (std::uint64_t i = first; i < end; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      if (scene.mesh.triangles.size() > 16) continue;
      SCOPED_TRACE(scene.name);
      const auto cell = exact::ConvexCell::from_doubles(scene.cell);
      const auto umbra = reference::build_umbra(reference::Omega(scene.mesh, cell, {}), std::nullopt, 0);
      if (umbra.facets.size() > 1500 ||
          !validate::check_umbra_certificate(scene.mesh, cell, validate::record_of(umbra).facets).valid)
        continue;
      EXPECT_EQ(exact::to_string_exact(integral(umbra)), volume_of(umbra));
      ++umbrae;
    }
  }
  std::cout << umbrae << " umbrae\n";
  EXPECT_GT(umbrae, 0U);
}

TEST(UmbraSlices, OfRandomScenesIntegrateToTheirVolumes) { expect_volumes(0, 2); }

TEST(UmbraSlicesLong, OfRandomScenesIntegrateToTheirVolumes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_volumes(2, 40);
}

// Corners that are no doubles are moved inwards, and no further than they have to be.
TEST(InwardRounding, LiesInTheFaceAndIsNearlyAllOfIt) {
  const auto q = [](int x, int y) { return exact::Point2(FT(x) / FT(7), FT(y) / FT(7)); };
  const std::vector<reference::Ring2> face{{q(0, 0), q(9, 1), q(8, 6), q(4, 3), q(1, 8)},
                                           {q(2, 2), q(2, 3), q(3, 2)}};  // with a dent and a hole
  const auto rounded = reference::rounded_inwards(face);
  ASSERT_TRUE(rounded);
  FT was(0), is(0);
  for (const auto& ring : face) was += reference::twice_area(ring);
  for (const auto& ring : *rounded) {
    is += reference::twice_area(ring);
    for (const auto& p : ring) {
      EXPECT_EQ(FT(CGAL::to_double(p.x())), p.x());
      EXPECT_EQ(FT(CGAL::to_double(p.y())), p.y());
    }
  }
  EXPECT_LT(is, was);
  EXPECT_GT(is, was * FT(0.999999));
}

TEST(InwardRounding, KeepsWhatIsDoubles) {
  const std::vector<reference::Ring2> face{{exact::Point2(0, 0), exact::Point2(0.1, 0), exact::Point2(0, 0.3)}};
  EXPECT_EQ(reference::rounded_inwards(face), face);
}

// A scene in which something is hidden, with occluders in it.
struct HiddenBehindAPlate : PlateBeforeReceiver {
  std::uint32_t hidden;
  HiddenBehindAPlate() { hidden = scene.triangle({-0.5, -0.5, 6}, {0.5, -0.5, 6}, {0, 0.5, 6}); }
};

std::vector<std::uint32_t> own_visible(const scene::TriangleMesh& with, const exact::ConvexCell& cell,
                                       std::size_t own) {
  auto visible = map_of(with, cell).visible;
  std::erase_if(visible, [&](std::uint32_t t) { return t >= own; });
  return visible;
}

TEST(VirtualOccluders, HideWhatIsHiddenAndNothingElse) {
  const HiddenBehindAPlate scene;
  const auto& mesh = scene.scene.mesh();
  const auto umbra = scene.umbra();
  for (const double h : {4.5, 5.0, 5.3, 5.9}) {
    const auto occluder = reference::virtual_occluder(umbra, 2, h);
    EXPECT_EQ(occluder.area, (FT(44) - FT(h)) / FT(10));
    EXPECT_EQ(occluder.faces_left_out, 0U);
    EXPECT_LE(occluder.rounded_area, occluder.area);
    EXPECT_GT(occluder.rounded_area, occluder.area * FT(0.999999));
    const auto visible = own_visible(reference::with_occluders(mesh, {occluder}), scene.cell, mesh.triangles.size());
    const auto map = map_of(mesh, scene.cell);
    EXPECT_EQ(validate::judge_pvs(mesh, map, visible).verdict, validate::Verdict::sound);
    EXPECT_FALSE(std::binary_search(visible.begin(), visible.end(), scene.hidden));
    // It stands for the plate: without that, what it hides is hidden all the same.
    scene::TriangleMesh without = mesh;
    without.triangles.erase(without.triangles.begin(), without.triangles.begin() + 2);
    without.face_of.erase(without.face_of.begin(), without.face_of.begin() + 2);
    const auto alone =
        own_visible(reference::with_occluders(without, {occluder}), scene.cell, without.triangles.size());
    EXPECT_FALSE(std::binary_search(alone.begin(), alone.end(), scene.hidden - 2));
  }
}

// Planted: an occluder that reaches out of the umbra hides something visible, and the judge of lists says so.
TEST(VirtualOccluders, OneThatIsTooLargeIsCaught) {
  HiddenBehindAPlate scene;
  const auto sliver = scene.scene.triangle({1.75, -0.2, 6}, {1.85, -0.2, 6}, {1.75, 0.2, 6});
  const auto& mesh = scene.scene.mesh();
  auto occluder = reference::virtual_occluder(scene.umbra(), 2, 5);
  for (auto& p : occluder.rounded.points) {
    p[0] *= 4;
    p[1] *= 4;
  }
  const auto visible = own_visible(reference::with_occluders(mesh, {occluder}), scene.cell, mesh.triangles.size());
  EXPECT_FALSE(std::binary_search(visible.begin(), visible.end(), sliver));
  const auto judgement = validate::judge_pvs(mesh, map_of(mesh, scene.cell), visible);
  EXPECT_EQ(judgement.verdict, validate::Verdict::unsound);
}

// All directions of planes, and random scenes: lists made with occluders are never unsound.
TEST(VirtualOccluders, OfRandomScenesHideNothingVisible) {
  std::uint64_t occluders = 0;
  for (const fuzz::Kind kind : {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra}) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      if (scene.mesh.triangles.size() > 24) continue;
      SCOPED_TRACE(scene.name);
      const auto cell = exact::ConvexCell::from_doubles(scene.cell);
      const auto umbra = reference::build_umbra(reference::Omega(scene.mesh, cell, {}), std::nullopt, 0);
      if (!validate::check_umbra_certificate(scene.mesh, cell, validate::record_of(umbra).facets).valid) continue;
      std::vector<reference::VirtualOccluder> all;
      for (int axis = 0; axis < 3; ++axis) {
        const auto& p = scene.mesh.points[static_cast<std::size_t>(axis)];
        all.push_back(reference::virtual_occluder(umbra, axis, p[static_cast<std::size_t>(axis)] + 0.25));
        occluders += !all.back().rounded.triangles.empty();
      }
      const auto visible = own_visible(reference::with_occluders(scene.mesh, all), cell, scene.mesh.triangles.size());
      EXPECT_NE(validate::judge_pvs(scene.mesh, map_of(scene.mesh, cell), visible).verdict, validate::Verdict::unsound);
    }
  }
  EXPECT_GT(occluders, 0U);
}

}  // namespace
}  // namespace clues::test
