// D3, D5, D6 for cells without an interior: the checker of witnesses against the plain way (thin_cells.h), on random
// sight lines amid coincidences; with a planted defect too, which the comparison has to notice.
#include <gtest/gtest.h>

#include <iostream>
#include "exact/sight/witness.h"
#include "tests/validate/thin_scenes.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using thin::is_sight_line;
using thin::Line;
using thin::Random;
using thin::Scene;
using thin::text;
using thin::Triangle;

// Moves of both ends by 2^-100, within the cell and the target: far less than lies between anything in these
// scenes.
bool neighbours_are_free(const Line& line, Random& random) {
  const Rational little(Integer(1), Integer(1) << 100);
  const auto moved = [&](RVector x, const std::vector<RVector>& corners) {
    for (std::size_t i = 1; i < 3 && i < corners.size(); ++i)
      x = sum(x, times(minus(corners[i], corners[0]), Rational(little * random.between(-9, 9))));
    return x;
  };
  const Triangle& t = line.scene.soup[line.target];
  for (int k = 0; k < 6; ++k) {
    const RVector v = moved(line.v, line.scene.cell.corners), p = moved(line.p, {t[0], t[1], t[2]});
    for (const Triangle& x : line.scene.soup) {
      if (thin::blocks(x, v, p)) return false;
    }
  }
  return true;
}

struct Checked {
  int lines = 0, valid = 0, special = 0, wrong = 0;
};

// `lenient` plants the defect that a free line is believed wherever its ends are.
Checked check_witnesses(int dimension, std::uint64_t seed, bool lenient) {
  Random random(seed + 10 + static_cast<std::uint64_t>(dimension));
  Checked total;
  while (total.lines < thin::kPoints) {
    const Scene scene(random, dimension, 4);
    const scene::TriangleMesh mesh = scene.mesh();
    const ConvexCell cell = scene.exact_cell();
    for (int k = 0; k < 5; ++k, ++total.lines) {
      const auto target = static_cast<std::uint32_t>(random.between(0, static_cast<int>(scene.soup.size()) - 1));
      const Triangle& t = scene.soup[target];
      Line line{scene, target, true, scene.in_cell(random), Scene::on(t, random, !random.one_in(8))};
      if (random.one_in(4)) line.v = scene.special(random);
      if (random.one_in(4)) line.p = scene.any(random)[0];
      line.front = sgn(dot(thin::normal_of(t), minus(line.v, t[0]))) > 0;
      if (random.one_in(8)) line.front = !line.front;
      auto verdict = exact::check_witness(mesh, cell, target, line.front, to_point(line.v), to_point(line.p));
      if (lenient && verdict.special) verdict.valid = true;
      total.valid += verdict.valid ? 1 : 0;
      total.special += verdict.special ? 1 : 0;
      const bool free = is_sight_line(line);
      bool held = false, touched = false;
      for (const Triangle& x : scene.soup) {
        held = held || (dimension > 0 && thin::holds(x, line.v));
        const bool flat = is_zero(cross(thin::normal_of(x), thin::normal_of(t)));
        touched = touched || (!flat && thin::holds(x, line.p));
      }
      bool right = !verdict.valid || (free && neighbours_are_free(line, random) &&
                                      !thin::is_shaded(scene.cell, scene.soup, line.p, line.v));
      right = right && (verdict.valid || !free || (verdict.special && (held || touched)));
      right = right && (lenient || !verdict.special || free);
      if (right) continue;
      ++total.wrong;
      if (!lenient)
        ADD_FAILURE() << (verdict.valid ? "accepted" : verdict.reason) << ": v " << text(line.v) << " p "
                      << text(line.p) << " on triangle " << target << "\n"
                      << scene.words();
      if (total.wrong > 3) return total;
    }
  }
  return total;
}

TEST(ThinCells, WitnessesAgreeWithThePlainWay) {
  const std::uint64_t s = thin::seed_of_run();
  for (const int dimension : {0, 1, 2}) {
    const Checked c = check_witnesses(dimension, s, false);
    std::cout << "dimension " << dimension << ": " << c.lines << " sight lines, " << c.valid << " accepted, "
              << c.special << " free, but touched at an end\n";
    EXPECT_GT(c.valid, 1000);
    EXPECT_GT(c.special, 10);
  }
}

TEST(ThinCells, AWitnessCheckerThatBelievesTouchedEndsIsCaught) {
  const std::uint64_t s = thin::seed_of_run();
  for (const int dimension : {0, 1, 2}) EXPECT_EQ(check_witnesses(dimension, s, true).wrong, 4) << dimension;
}

}  // namespace
}  // namespace clues::validate
