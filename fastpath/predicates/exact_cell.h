// The inside of a solid view cell in rationals (D2), as strict half spaces. For the exact stage only.
#pragma once

#include <gmpxx.h>

#include <array>
#include <memory>
#include <vector>

#include "fastpath/predicates/filter.h"

namespace clues::fastpath {

struct ExactCell {
  struct Plane {
    std::array<mpq_class, 3> normal;
    mpq_class offset;  // value(x) = normal . x - offset
  };
  std::vector<Plane> bounds;  // int V has value < 0
};

// From the facets, counter-clockwise seen from outside.
std::shared_ptr<const ExactCell> make_exact_cell(const std::vector<std::vector<Point>>& facets);

}  // namespace clues::fastpath
