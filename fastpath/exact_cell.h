// The view cell in rationals (D2): int V as strict half spaces and, for a flat cell, planes. For the exact stage only.
#pragma once

#include <gmpxx.h>

#include <array>
#include <memory>
#include <vector>

#include "fastpath/filter.h"

namespace clues::fastpath {

struct ExactCell {
  struct Plane {
    std::array<mpq_class, 3> normal;
    mpq_class offset;  // value(x) = normal . x - offset
  };
  std::vector<Plane> bounds;  // int V has value < 0
  std::vector<Plane> flats;   // V has value = 0
};

// vertices: the extreme points; polygons: the facets (dimension 3, counter-clockwise seen from outside) or the cell itself (2).
std::shared_ptr<const ExactCell> make_exact_cell(int dimension, const std::vector<Point>& vertices,
                                                 const std::vector<std::vector<Point>>& polygons);

}  // namespace clues::fastpath
