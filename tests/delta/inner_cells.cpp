#include "tests/delta/inner_cells.h"

#include <algorithm>

#include "fuzz/trials/deltas_trial.h"

namespace clues::test {
namespace {

bool has_double_corners(const exact::ConvexCell& cell) {
  return std::all_of(cell.vertices().begin(), cell.vertices().end(),
                     [](const auto& p) { return exact::to_exact(exact::to_double_estimate(p)) == p; });
}

exact::ConvexCell box_in(const exact::ConvexCell& cell) {
  const scene::Point at = exact::to_double_estimate(cell.center());
  for (double half = 1024;; half /= 2) {
    std::vector<scene::Point> corners;
    for (unsigned i = 0; i < 8; ++i)
      corners.push_back({at[0] + ((i & 1) != 0 ? half : -half), at[1] + ((i & 2) != 0 ? half : -half),
                         at[2] + ((i & 4) != 0 ? half : -half)});
    if (std::all_of(corners.begin(), corners.end(), [&](const auto& p) { return cell.contains(exact::to_exact(p)); }))
      return exact::ConvexCell::from_doubles(corners);
  }
}

}  // namespace

std::vector<exact::ConvexCell> inner_cells_of(const exact::ConvexCell& cell) {
  std::vector<exact::ConvexCell> out;
  for (const auto& half : fuzz::halves_of(cell)) out.push_back(has_double_corners(half) ? half : box_in(half));
  return out;
}

}  // namespace clues::test
