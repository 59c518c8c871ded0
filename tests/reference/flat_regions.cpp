#include "flat_regions.h"

#include <algorithm>

#include "fuzz/generators/random.h"

namespace clues::test {

using exact::FT;
using exact::Point2;
using reference::Face2;
using reference::FlatSet;
using reference::Ring2;

exact::Kernel::Triangle_2 outline() { return {Point2(0, 0), Point2(200, 0), Point2(0, 200)}; }

Ring2 ring(const std::vector<std::pair<int, int>>& corners) {
  Ring2 out;
  for (const auto& [x, y] : corners) out.emplace_back(x, y);
  return out;
}

FlatSet set_of(const Face2& face) { return FlatSet(FT(200 * 200), {face}); }
bool inside(const Face2& inner, const Face2& outer) { return subtract(set_of(inner), set_of(outer)).empty(); }

std::vector<Point2> sorted(Ring2 points) {
  std::sort(points.begin(), points.end());
  return points;
}

Face2 chamfered_square() { return {ring({{10, 10}, {30, 10}, {30, 29}, {29, 30}, {10, 30}})}; }

Face2 star(std::uint64_t seed) {
  fuzz::Random random(seed);
  const std::vector<std::pair<int, int>> rays{{8, 0},  {7, 3},  {6, 6},  {3, 7},   {0, 8},   {-3, 7},
                                              {-6, 6}, {-7, 3}, {-8, 0}, {-7, -3}, {-6, -6}, {-3, -7},
                                              {0, -8}, {3, -7}, {6, -6}, {7, -3}};
  Ring2 out;
  for (const auto& [x, y] : rays) {
    const FT length = FT(random.between(16, 64)) / FT(16);
    out.emplace_back(FT(60) + length * FT(x), FT(60) + length * FT(y));
  }
  return {out};
}

}  // namespace clues::test
