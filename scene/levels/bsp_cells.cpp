// D23: the leaves as convex cells. The tree is walked from the world's bounds; at each node the polytope is cut in two, exactly.
#include <algorithm>
#include <utility>

#include "scene/levels/bsp_bounds.h"
#include "scene/levels/bsp_scene.h"
#include "scene/levels/bsp_solids.h"
#include "scene/levels/rounding.h"

namespace clues::scene {

namespace {

std::array<Point, 2> box_of_world(const BspFile& level) {
  const auto& world = level.models[0];
  Point low = world.low, high = world.high;
  for (std::uint32_t f = 0; f < world.faces.count; ++f) {
    const auto& vertices = level.faces[world.faces.first + f].vertices;
    for (std::uint32_t i = 0; i < vertices.count; ++i) {
      const Point& p = level.points[vertices.first + i];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
  return {low, high};
}

}  // namespace

Polytope bounds_of_level(const BspFile& level) {
  const auto [low, high] = box_of_world(level);
  return box_polytope(to_rational(low), to_rational(high));
}

Polytope bounds_of_brushes(const BspFile& level) {
  constexpr double around = 65536;  // no level of this family is as large
  auto [low, high] = box_of_world(level);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] -= around;
    high[axis] += around;
  }
  return box_polytope(to_rational(low), to_rational(high));
}

std::vector<LevelCell> cells_of_level(const BspFile& level) {
  std::vector<std::pair<std::int32_t, Polytope>> open;
  open.emplace_back(0, bounds_of_level(level));
  std::vector<LevelCell> cells;
  const auto add_cell = [&](std::uint32_t leaf, const std::optional<Polytope>& polytope) {
    LevelCell cell{leaf, static_cast<std::uint32_t>(level.leaves[leaf].cluster), {}, {}};
    if (polytope) {
      cell.outer = outer_points(*polytope);
      if (auto inner = inner_vertices(*polytope); inner && !are_coplanar(*inner)) {
        std::sort(inner->begin(), inner->end());
        inner->erase(std::unique(inner->begin(), inner->end()), inner->end());
        cell.inner = std::move(*inner);
      }
    }
    cells.push_back(std::move(cell));
  };
  std::vector<bool> reached(level.leaves.size());
  while (!open.empty()) {
    const auto [at, polytope] = std::move(open.back());
    open.pop_back();
    if (at < 0) {
      const auto leaf = static_cast<std::uint32_t>(-1 - at);
      reached[leaf] = true;
      if (level.leaves[leaf].cluster >= 0) add_cell(leaf, polytope);
      continue;
    }
    const auto& node = level.nodes[static_cast<std::size_t>(at)];
    const HalfSpace behind = half_space_of(level.planes[node.plane]);
    if (auto part = intersection(polytope, behind)) open.emplace_back(node.children[1], std::move(*part));
    if (auto part = intersection(polytope, behind.opposite())) open.emplace_back(node.children[0], std::move(*part));
  }
  for (const auto leaf : level.leaves_of_tree) {  // of whose half spaces nothing is left
    if (!reached[leaf] && level.leaves[leaf].cluster >= 0) add_cell(leaf, std::nullopt);
  }
  std::sort(cells.begin(), cells.end(), [](const LevelCell& a, const LevelCell& b) { return a.leaf < b.leaf; });
  return cells;
}

}  // namespace clues::scene
