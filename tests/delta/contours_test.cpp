// FIGS. 31, 32, 34, 35: boundaries as the labels of the planes that made them, and the same boundaries again from these.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <random>
#include <tuple>

#include "fuzz/generators/random_scenes.h"
#include "reference/contours/contour_maker.h"
#include "reference/contours/list_contour.h"
#include "scene/messages/error.h"
#include "tests/app/program.h"
#include "tests/delta/inner_cells.h"
#include "tests/delta/plates.h"
#include "tests/reference/support.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::FT;
using reference::ContourLabel;
using reference::PlaneTable;

struct CodeSums {
  std::uint64_t labels = 0, planes = 0, left_out = 0, points = 0, in_full = 0, bytes = 0, bridges = 0;
};

using SegmentKey = std::tuple<std::size_t, exact::Point2, exact::Point2>;
std::vector<SegmentKey> keys_of(const ContourLabel& label) {
  std::vector<SegmentKey> keys;
  for (const auto& s : label.segments) keys.emplace_back(s.side, std::min(s.at.a, s.at.b), std::max(s.at.a, s.at.b));
  std::sort(keys.begin(), keys.end());
  return keys;
}

// The child's boundary as labels, within the parent's within whole triangles, and the same made again.
scene::ContourCell code_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& parent,
                           const exact::ConvexCell& child, ContourLabel& label, CodeSums& sums) {
  const auto sides = reference::input_sides(mesh, reference::Mode::sheet);
  reference::ContourMaker maker(mesh, {}, 0);
  maker.add("parent", parent, 0, true);
  const auto known = reference::decoded_map(sides, mesh, maker.file(), 0);
  const auto of_child = map_of(mesh, child);
  const auto wanted = reference::visible_on(sides, mesh, of_child);
  label = reference::contour_label(sides, mesh, known, wanted);
  PlaneTable planes(mesh, child);
  planes.add_wedges(of_child);
  for (const auto& l : planes.labels()) {
    // Made again from its numbers it holds what it held.
    EXPECT_TRUE(
        std::any_of(of_child.wedges.begin(), of_child.wedges.end(),
                    [&, h = planes.plane_of(l)](const auto& w) { return h == w.plane || h.opposite() == w.plane; }) ||
        l.kind == reference::PlaneLabel::Kind::triangle);
  }
  reference::Drawings around(mesh);
  around.add(maker.file().cells[0]);
  reference::ContourCounts counts;
  scene::ContourCell cell = reference::encoded_contours(sides, label, around, planes, counts);
  for (const auto& p : child.vertices()) cell.points.push_back(exact::to_double_estimate(p));
  cell.within = 1;
  const ContourLabel back = reference::decoded_contours(sides, cell, around);
  EXPECT_EQ(keys_of(back), keys_of(label));
  EXPECT_EQ(back.seeds.size(), label.seeds.size());
  const auto found = reference::flooded(sides, mesh, known, back);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    EXPECT_TRUE(subtract(found[s], wanted[s]).empty());
    EXPECT_TRUE(subtract(wanted[s], found[s]).empty());
  }
  std::vector<scene::ContourCell> cells{maker.file().cells[0], cell};
  ++sums.labels;
  sums.planes += planes.labels().size();
  sums.left_out += planes.left_out();
  sums.points += counts.by_labels;
  sums.in_full += counts.in_full;
  sums.bridges += counts.bridges;
  sums.bytes += scene::contour_bytes(cells, 1).size();
  return cell;
}

TEST(Contours, LabelsMakeTheSegmentsOfScenePAgain) {
  CodeSums sums;
  ContourLabel label;
  const auto mesh = plates_and_a_box();
  code_of(mesh, box_cell(-2, -1, -1, 2, 1, 0), box_cell(-2, -1, -1, 0, 1, 0), label, sums);
  EXPECT_GT(label.segments.size(), 4U);
  EXPECT_EQ(sums.in_full, 0U);
  EXPECT_GT(sums.points, 4U);
}

// A seed in a part that is so small that few bits do not find it, or none.
TEST(Contours, SeedsComeBackInTheirComponents) {
  SceneBuilder builder;
  builder.triangle({0, 0, 4}, {1, 0, 4}, {0, 1, 4});
  const auto& mesh = builder.mesh();
  const auto sides = reference::input_sides(mesh, reference::Mode::sheet);
  const auto cell = box_cell(0, 0, 0, 1, 1, 1);
  for (const int bits : {3, 20, 50, 90}) {
    // A corner of the triangle, cut off.
    const exact::FT x = exact::FT(1) / exact::FT(FT::Exact_type(mpz_class(1) << bits));
    const auto corner = [&](const exact::FT& a, const exact::FT& b) {
      return reference::frame_of(mesh, 0).frame()(exact::Point3(a, b, 4));
    };
    ContourLabel label;
    label.segments.push_back({0, {corner(x, 0), corner(0, x)}});
    label.seeds.push_back({0, corner(x / 3, x / 3)});
    reference::ContourCounts counts;
    const auto coded =
        reference::encoded_contours(sides, label, reference::Drawings(mesh), PlaneTable(mesh, cell), counts);
    ASSERT_EQ(coded.seeds.size(), 1U);
    EXPECT_EQ(coded.seeds[0].bits == 0, bits > 52) << bits;
    reference::Drawings drawings(mesh);
    const auto back = reference::decoded_contours(sides, coded, drawings);
    const auto found = reference::flooded(sides, mesh, reference::whole_sides(sides, mesh), back);
    EXPECT_EQ(found[0].fraction(), x * x) << bits;
    EXPECT_TRUE(found[1].empty());
  }
}

// Beyond 2^256 arrangements of the library crashed, or lost what is visible (found by a reader).
TEST(ContourCommands, CoordinatesBeyondTheirRangeAreRefused) {
  const tests::TestFolder folder;
  folder.write("huge.off", "OFF\n3 1 0\n0 0 2e102\n1e102 0 2e102\n0 1e102 2e102\n3 0 1 2\n");
  for (const auto& command :
       {std::vector<std::string>{"delta", "contours", "huge.off", "--parent", "box:-2,-2,-2,2,2,2", "--cells",
                                 "grid:2x1x1:box:-1,-1,-1,1,1,1", "-o", "c"},
        {"occluders", "huge.off", "--cell", "box:0,0,0,1,1,1", "--plane", "z=2", "-o", "c.json"}}) {
    const auto refused = tests::run_clues(command, folder.path());
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_NE(refused.err.find("coordinates beyond 2^256"), std::string::npos) << refused.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"huge.off"});
  }
}

// And for a solid P, or one of C's dimension: from the line of two curtains one sees between them, and from beside it not.
TEST(ContourCommands, ASegmentInAFlatParentIsRefused) {
  const tests::TestFolder folder;
  folder.write("curtains.obj",
               "v -5 0 0\nv 5 0 0\nv 0 -3 3\nv 0 3 3\nv -0.25 -0.25 1\nv 0.25 -0.25 1\nv 0 0.25 1\n"
               "f 1 2 3\nf 1 2 4\nf 5 6 7\n");
  const auto contours = [&](const std::string& parent) {
    return tests::run_clues(
        {"delta", "contours", "curtains.obj", "--parent", parent, "--cells", "grid:1x1x1:box:-1,0,0,1,0,0"},
        folder.path());
  };
  const auto refused = contours("box:-2,-2,0,2,2,0");
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_NE(refused.err.find("has fewer dimensions than --parent"), std::string::npos) << refused.err;
  for (const char* taken : {"box:-2,-2,-1,2,2,1", "box:-2,0,0,2,0,0"}) {
    const auto ran = contours(taken);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
  }
}

// T6 asks for int C in int P: of a parent's border nothing is known from its map.
TEST(ContourCommands, ACellInTheBorderOfItsParentIsRefused) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const auto contours = [&](const std::string& parent, const std::string& cell) {
    return tests::run_clues({"delta", "contours", "screen.off", "--parent", parent, "--cells", cell}, folder.path());
  };
  const std::string solid = "box:-0.25,-0.25,-0.25,0.25,0.25,0", flat = "box:-0.25,-0.25,0,0.25,0.25,0";
  for (const auto& [parent, cell] : {std::pair(solid, flat), {flat, std::string("box:-0.25,-0.25,0,0.25,-0.25,0")}}) {
    const auto refused = contours(parent, "grid:1x1x1:" + cell);
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_NE(refused.err.find("lies in the border of --parent"), std::string::npos) << refused.err;
  }
  for (const std::string& parent : {solid, flat}) {
    const auto taken = contours(parent, "grid:1x1x1:" + parent);
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
  }
}

void expect_codes_of_random_scenes(std::uint64_t first, std::uint64_t end) {
  CodeSums sums;
  for (const fuzz::Kind kind :
       {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra, fuzz::Kind::open_sheets, fuzz::Kind::interpenetrating}) {
    for (std::uint64_t i = first; i < end; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      const auto cell = exact::ConvexCell::from_doubles(scene.cell);
      ContourLabel label;
      for (const auto& half : inner_cells_of(cell)) code_of(scene.mesh, cell, half, label, sums);
    }
  }
  std::cout << sums.labels << " boundaries, " << sums.planes << " planes and " << sums.left_out << " without a label, "
            << sums.points << " points by labels and " << sums.in_full << " in full, " << sums.bridges << " bridges, "
            << sums.bytes << " bytes\n";
  EXPECT_GT(sums.points, 5 * sums.in_full);
  EXPECT_GT(sums.bridges, 0U);
  EXPECT_GT(sums.planes, 10 * sums.left_out);  // at edges where surfaces pierce each other, which are not in the file
}

TEST(Contours, LabelsMakeTheSegmentsOfRandomScenesAgain) { expect_codes_of_random_scenes(0, 2); }

TEST(ContoursLong, LabelsMakeTheSegmentsOfFiftyScenesAgain) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_codes_of_random_scenes(0, 13);
}

// Whole triangles, from lists at random in random scenes: each seed and each edge of the boundary left out once.
TEST(ListContours, FindListsAgainAndLoseWhatTheyShould) {
  std::mt19937_64 random(kSeed);
  std::uint64_t more = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto mesh = fuzz::generate(i % 2 == 0 ? fuzz::Kind::axis_boxes : fuzz::Kind::open_sheets, kSeed, i).mesh;
    const reference::EdgeUsers edges(mesh);
    std::vector<std::uint32_t> known, wanted;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (random() % 8 == 0) continue;
      known.push_back(t);
      if (random() % 3 != 0) wanted.push_back(t);
    }
    const auto contour = reference::list_contour(edges, known, wanted);
    EXPECT_EQ(reference::flooded_list(edges, known, contour), wanted);
    const auto bytes = reference::to_bytes(contour);
    const auto back = reference::parse_list_contour(bytes, edges);
    EXPECT_EQ(back.seeds, contour.seeds);
    EXPECT_EQ(back.boundary, contour.boundary);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(reference::parse_list_contour(bytes.substr(0, size), edges), scene::Error);
    std::uint64_t lost = 0;
    for (std::size_t k = 0; k < contour.seeds.size(); ++k) {
      auto less = contour;
      less.seeds.erase(less.seeds.begin() + static_cast<std::ptrdiff_t>(k));
      const auto found = reference::flooded_list(edges, known, less);
      EXPECT_TRUE(std::includes(wanted.begin(), wanted.end(), found.begin(), found.end()));
      lost += wanted.size() - found.size();
    }
    EXPECT_EQ(lost, wanted.size());  // each triangle with one seed
    for (std::size_t k = 0; k < contour.boundary.size(); ++k) {
      auto less = contour;
      less.boundary.erase(less.boundary.begin() + static_cast<std::ptrdiff_t>(k));
      const auto found = reference::flooded_list(edges, known, less);
      EXPECT_TRUE(std::includes(found.begin(), found.end(), wanted.begin(), wanted.end()));
      EXPECT_GT(found.size(), wanted.size());
      ++more;
    }
  }
  EXPECT_GT(more, 100U);
}

}  // namespace
}  // namespace clues::test
