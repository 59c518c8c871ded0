// A decoder of contours in doubles that is wrong in one thing: the comparison with the exact one notices. (The right one passes all of
// this: ContoursInDoubles.*, to the last digit of the area.)
#include <gtest/gtest.h>

#include <iostream>

#include "fuzz/generators/random_scenes.h"
#include "reference/contours/contour_maker.h"
#include "tests/delta/inner_cells.h"
#include "tests/delta/plates.h"
#include "tests/reference/support.h"
#include "tests/seed.h"
#include "validate/stream/compare_contours.h"

namespace clues::test {
namespace {

// Of the cell and its halves.
std::uint64_t cells_noticed(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  reference::ContourMaker maker(mesh, {}, 0);
  maker.add("cell", cell, 0, true);
  for (const auto& half : inner_cells_of(cell)) maker.add("half", half, 1, false);
  const auto& file = maker.file();
  const fastpath::ContourDecoder decoder(mesh);
  reference::ContourMaps kept;
  std::uint64_t noticed = 0;
  for (std::uint32_t c = 0; c < file.cells.size(); ++c) {
    const auto exact = reference::decoded_map(maker.sides(), mesh, file, c, &kept);
    const auto compared = validate::compare_contours(mesh, file, c, maker.sides(), exact, decoder.decode(file, c));
    if (!compared.findings.empty() || compared.area > 1.000001 * compared.exact_area) ++noticed;
  }
  return noticed;
}

TEST(WrongContours, AreNoticed) {
  std::uint64_t noticed = cells_noticed(plates_and_a_box(), box_cell(-2, -1, -1, 2, 1, 0));
  for (const fuzz::Kind kind : {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra, fuzz::Kind::open_sheets}) {
    const auto scene = fuzz::generate(kind, kSeed, 0);
    noticed += cells_noticed(scene.mesh, exact::ConvexCell::from_doubles(scene.cell));
  }
  std::cout << noticed << " of 12 cells\n";
  EXPECT_GT(noticed, 0U);
}

}  // namespace
}  // namespace clues::test
