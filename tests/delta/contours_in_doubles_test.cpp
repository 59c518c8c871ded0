// D26 in doubles: what the run-time decoder calls visible holds what the exact one finds, on every side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "exact/dials.h"
#include "fuzz/generators/degenerate_scenes.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/contours/contour_maker.h"
#include "tests/delta/inner_cells.h"
#include "tests/delta/plates.h"
#include "tests/reference/support.h"
#include "tests/seed.h"
#include "validate/stream/compare_contours.h"
#include "validate/vectors/reader.h"

namespace clues::test {
namespace {

struct DoublesSums {
  std::uint64_t cells = 0, sides = 0, ends = 0, points = 0, unbounded = 0, wild = 0, exact_list = 0, list = 0;
  std::uint64_t seen_points = 0, hidden_points = 0, held_though_hidden = 0;
  double exact_area = 0, area = 0, radius = 0;
};

// A point in each part that is seen is held; of those in parts that are not, hardly any.
void ask_for_points(const scene::TriangleMesh& mesh, const std::vector<reference::InputSide>& sides,
                    const std::vector<reference::FlatSet>& exact, const fastpath::ContourDecoding& decoding,
                    DoublesSums& sums) {
  const auto whole = reference::whole_sides(sides, mesh);
  for (const auto& region : decoding.regions) {
    const auto side = std::find_if(sides.begin(), sides.end(),
                                   [&](const auto& s) { return 2 * s.triangle + (s.front ? 0U : 1U) == region.side; });
    const auto s = static_cast<std::size_t>(side - sides.begin());
    const auto frame = reference::frame_of(mesh, side->triangle);
    const auto place_in = [&](const reference::Face2& face) {
      return exact::to_double_estimate(frame.lift(reference::inner_point(face, 0)));
    };
    for (const auto& face : exact[s].faces()) {
      ++sums.seen_points;
      EXPECT_TRUE(region.may_hold(place_in(face))) << region.side;
    }
    for (const auto& face : subtract(whole[s], exact[s]).faces()) {
      ++sums.hidden_points;
      sums.held_though_hidden += region.may_hold(place_in(face));
    }
  }
}

struct CodedCells {
  scene::ContourFile file;
  std::vector<std::vector<std::uint32_t>> lists;  // of the maps
};

void expect_doubles_hold(const scene::TriangleMesh& mesh, const CodedCells& coded, DoublesSums& sums) {
  const scene::ContourFile& file = coded.file;
  const auto sides =
      reference::input_sides(mesh, file.mode == "solid" ? reference::Mode::solid : reference::Mode::sheet);
  const fastpath::ContourDecoder decoder(mesh);
  reference::ContourMaps kept;
  for (std::uint32_t c = 0; c < file.cells.size(); ++c) {
    const auto exact = reference::decoded_map(sides, mesh, file, c, &kept);
    EXPECT_EQ(reference::list_of(sides, exact, file.cells[c].besides), coded.lists[c]);
    const auto decoding = decoder.decode(file, c);
    const auto compared = validate::compare_contours(mesh, file, c, sides, exact, decoding);
    for (const auto& finding : compared.findings) ADD_FAILURE() << "cell " << c << ": " << finding;
    ask_for_points(mesh, sides, exact, decoding, sums);
    ++sums.cells;
    sums.sides += compared.sides;
    sums.ends += compared.ends_checked;
    sums.exact_list += compared.exact_list;
    sums.list += compared.list;
    sums.exact_area += compared.exact_area;
    sums.area += compared.area;
    sums.radius = std::max(sums.radius, compared.radius);
    sums.points += decoding.points;
    sums.unbounded += decoding.unbounded;
    sums.wild += decoding.wild;
  }
}

// The cell, its halves, and halves of these: three levels.
CodedCells file_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, reference::Mode mode) {
  reference::Options options;
  options.mode = mode;
  reference::ContourMaker maker(mesh, options, 0);
  CodedCells out;
  const auto add = [&](const char* name, const exact::ConvexCell& one, std::uint32_t within, bool is_around) {
    out.lists.push_back(maker.add(name, one, within, is_around).visible);
  };
  add("cell", cell, 0, true);
  for (const auto& half : inner_cells_of(cell)) {
    add("half", half, 1, true);
    const auto within = static_cast<std::uint32_t>(maker.file().cells.size());
    const auto quarters = inner_cells_of(half);
    if (!quarters.empty()) add("quarter", quarters[0], within, false);
  }
  out.file = maker.file();
  return out;
}

void print(const char* what, const DoublesSums& s) {
  std::cout << what << ": " << s.cells << " cells, " << s.sides << " sides, " << s.ends << " ends; lists "
            << s.exact_list << " and " << s.list << ", area " << s.exact_area << " and " << s.area << ", radius "
            << s.radius << "; " << s.points << " points, " << s.unbounded << " unbounded, " << s.wild << " wild; of "
            << s.hidden_points << " hidden points " << s.held_though_hidden << " held\n";
}

TEST(ContoursInDoubles, HoldSceneP) {
  DoublesSums sums;
  const auto mesh = plates_and_a_box();
  expect_doubles_hold(mesh, file_of(mesh, box_cell(-2, -1, -1, 2, 1, 0), reference::Mode::sheet), sums);
  print("scene P", sums);
  EXPECT_EQ(sums.list, sums.exact_list);
  EXPECT_EQ(sums.area, sums.exact_area);
  EXPECT_EQ(sums.wild, 0U);
  EXPECT_GT(sums.ends, 40U);
}

void expect_doubles_hold_random_scenes(std::uint64_t first, std::uint64_t end) {
  DoublesSums sums;
  for (const fuzz::Kind kind :
       {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra, fuzz::Kind::open_sheets, fuzz::Kind::interpenetrating}) {
    for (std::uint64_t i = first; i < end; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      expect_doubles_hold(scene.mesh,
                          file_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell),
                                  scene.solid ? reference::Mode::solid : reference::Mode::sheet),
                          sums);
    }
  }
  print("random scenes", sums);
  EXPECT_GT(sums.ends, 100U);
  EXPECT_LE(sums.area, 1.01 * sums.exact_area);
  EXPECT_GT(sums.seen_points, 100U);
  EXPECT_GT(sums.hidden_points, 40U);
  EXPECT_LT(sums.held_though_hidden, sums.hidden_points / 10);
}

TEST(ContoursInDoubles, HoldRandomScenes) { expect_doubles_hold_random_scenes(0, 1); }

TEST(ContoursInDoublesLong, HoldFiftyScenes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_doubles_hold_random_scenes(0, 13);
}

// Where much is equal, in one plane, thin or nearly closed.
void expect_doubles_hold_degenerate_scenes(std::uint64_t count, std::size_t most_triangles) {
  DoublesSums sums;
  for (const auto& generator : fuzz::degenerate_generators()) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto scene = generator.make(kSeed, i);
      SCOPED_TRACE(scene.name + " " + std::to_string(i));
      if (scene.mesh.triangles.size() > most_triangles) continue;
      expect_doubles_hold(
          scene.mesh, file_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), reference::Mode::sheet), sums);
    }
  }
  print("degenerate scenes", sums);
  EXPECT_GT(sums.ends, 100U);
}

TEST(ContoursInDoubles, HoldDegenerateScenes) { expect_doubles_hold_degenerate_scenes(1, 12); }

TEST(ContoursInDoublesLong, HoldManyDegenerateScenes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_doubles_hold_degenerate_scenes(10, 1000);
}

// The cases of the suite with a solid cell, each `step`-th of them.
void expect_doubles_hold_the_suite(std::size_t step) {
  DoublesSums sums;
  const auto suite = validate::read_suite(CLUES_SOURCE_DIR "/vectors");
  for (std::size_t i = 0; i < suite.size(); i += step) {
    const auto& c = suite[i];
    if (!c.blocks.empty() || !c.counts.empty()) continue;
    const auto cell = exact::ConvexCell::from_doubles(c.cell);
    if (cell.dimension() != 3) continue;
    SCOPED_TRACE(c.id);
    expect_doubles_hold(
        c.mesh,
        file_of(c.mesh, cell, c.mode == validate::CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet),
        sums);
  }
  print("suite", sums);
  EXPECT_GT(sums.ends, 100U);
}

TEST(ContoursInDoubles, HoldPartOfTheSuite) { expect_doubles_hold_the_suite(40); }

TEST(ContoursInDoublesLong, HoldTheSuite) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_doubles_hold_the_suite(1);
}

// Where doubles decide nothing all is one face, and nothing is missing.
TEST(ContoursInDoubles, WithoutAnySignTheyHoldAllTheMore) {
  const auto mesh = plates_and_a_box();
  const auto file = file_of(mesh, box_cell(-2, -1, -1, 2, 1, 0), reference::Mode::sheet);
  DoublesSums sums;
  {
    const exact::TurnedProcessDials turned({.unsure_intervals = true});
    expect_doubles_hold(mesh, file, sums);
  }
  EXPECT_GT(sums.wild, 0U);
  EXPECT_GT(sums.area, sums.exact_area);
}

}  // namespace
}  // namespace clues::test
