#include "scene/stream/route.h"

#include <algorithm>
#include <random>
#include <utility>

#include "scene/messages/error.h"

namespace clues::scene {
namespace {

std::pair<double, double> range_of(const std::vector<Point>& points, std::size_t axis) {
  const auto [lo, hi] = std::minmax_element(points.begin(), points.end(),
                                            [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
  return {(*lo)[axis], (*hi)[axis]};
}

bool is_box(const std::vector<Point>& points) {
  return points.size() <= 8 && std::all_of(points.begin(), points.end(), [&](const Point& p) {
           for (std::size_t axis = 0; axis < 3; ++axis) {
             const auto [lo, hi] = range_of(points, axis);
             if (p[axis] != lo && p[axis] != hi) return false;
           }
           return true;
         });
}

}  // namespace

bool may_follow(const std::vector<Point>& from, const std::vector<Point>& to) {
  std::size_t same = 0, touching = 0;
  bool inside = true, around = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = range_of(from, axis), b = range_of(to, axis);
    same += a == b;
    touching += a != b && (a.second == b.first || b.second == a.first);
    inside &= a.first <= b.first && b.second <= a.second;
    around &= b.first <= a.first && a.second <= b.second;
  }
  return (same == 2 && touching == 1) || inside || around;
}

std::vector<std::vector<std::uint32_t>> neighbours_of(const std::vector<CellSpec>& cells) {
  for (const CellSpec& cell : cells) {
    if (!is_box(cell.points))
      throw Error(ErrorCode::bad_cell, "cell " + cell.name + ": is no box; routes are for grids and boxes");
  }
  std::vector<std::vector<std::uint32_t>> out(cells.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    for (std::uint32_t j = 0; j < cells.size(); ++j) {
      if (i != j && may_follow(cells[i].points, cells[j].points)) out[i].push_back(j);
    }
  }
  return out;
}

std::vector<std::uint32_t> random_route(const std::vector<std::vector<std::uint32_t>>& neighbours, std::uint64_t steps,
                                        std::uint64_t seed, std::uint32_t first) {
  std::mt19937_64 random(seed);
  std::vector<std::uint32_t> route{first};
  for (std::uint64_t i = 0; i < steps && !neighbours[route.back()].empty(); ++i) {
    const auto& next = neighbours[route.back()];
    route.push_back(next[random() % next.size()]);
  }
  return route;
}

}  // namespace clues::scene
