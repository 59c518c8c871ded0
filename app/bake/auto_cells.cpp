// A triangle is cut into columns of the grid, in doubles: a box more or less at a rim does no harm, since what is missing has no list rather than a wrong one.
#include "app/bake/auto_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scene/mesh/bounds.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

using scene::Point;
using Polygon = std::vector<Point>;

constexpr double most_boxes = 1e7;
constexpr double most_index = 0x1p52;  // beyond, doubles next to each other are in different boxes

Polygon below(const Polygon& polygon, std::size_t axis, double sign, double bound) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = sign * (a[axis] - bound), at_b = sign * (b[axis] - bound);
    if (at_a <= 0) part.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const double s = at_a / (at_a - at_b);
      part.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])});
    }
  }
  return part;
}

bool is_walkable(const std::array<Point, 3>& t, std::size_t up) {
  Point u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = t[1][i] - t[0][i];
    v[i] = t[2][i] - t[0][i];
  }
  const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  double all = 0;
  for (const double x : n) all += x * x;
  return all > 0 && 2 * n[up] * n[up] >= all;  // either side may be the floor
}

}  // namespace

AutoCells auto_cells(const scene::FlaggedMesh& scene, double size, double height, char up) {
  const std::size_t z = up == 'y' ? 1 : 2, x = up == 'y' ? 2 : 0, y = up == 'y' ? 0 : 1;
  AutoCells out;
  using Index = std::array<std::int64_t, 3>;  // slowest axis first, so that they come out in order
  std::set<Index> marked;
  const auto box_of = [&](double value) { return static_cast<std::int64_t>(std::floor(value / size)); };
  const auto& triangles = scene.mesh.triangles;
  if (triangles.empty())
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--cells auto:{}: the scene has no triangles to walk on", size));
  const Point& any = scene.mesh.points[triangles[0][0]];
  scene::Bounds around{any, any};
  for (const auto& corners : triangles) {
    for (const auto c : corners) around = scene::hull_of(around, {scene.mesh.points[c], scene.mesh.points[c]});
  }
  auto& [low, high] = around;
  high[z] += height;  // which may be far above the scene
  double boxes = 1;
  bool are_counted = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const double first = std::floor(low[i] / size), last = std::floor(high[i] / size);
    are_counted = are_counted && first >= -most_index && last <= most_index;
    boxes *= last - first + 1;
  }
  if (!are_counted || !(boxes <= most_boxes))
    throw scene::Error(scene::ErrorCode::bad_argument,
                       are_counted ? fmt::format("--cells auto:{}: would make a grid of {:.3g} boxes; take larger ones "
                                                 "or a lower height",
                                                 size, boxes)
                                   : fmt::format("--cells auto:{}: the scene, with the height above it, is too many "
                                                 "boxes away from the origin; take larger ones",
                                                 size));
  out.boxes = static_cast<std::uint64_t>(boxes);
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (!scene.blocking(t)) continue;
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = scene.mesh.points[scene.mesh.triangles[t][i]];
    if (!is_walkable(corners, z)) {
      ++out.steep;
      continue;
    }
    ++out.walkable;
    const auto [x0, x1] = std::minmax({corners[0][x], corners[1][x], corners[2][x]});
    for (auto i = box_of(x0); i <= box_of(x1); ++i) {
      const auto strip = below(below({corners.begin(), corners.end()}, x, -1, static_cast<double>(i) * size), x, 1,
                               static_cast<double>(i + 1) * size);
      if (strip.empty()) continue;
      const auto by_y = [y](const Point& a, const Point& b) { return a[y] < b[y]; };
      const auto [y0, y1] = std::minmax_element(strip.begin(), strip.end(), by_y);
      for (auto j = box_of((*y0)[y]); j <= box_of((*y1)[y]); ++j) {
        const auto column =
            below(below(strip, y, -1, static_cast<double>(j) * size), y, 1, static_cast<double>(j + 1) * size);
        if (column.empty()) continue;
        const auto by_z = [z](const Point& a, const Point& b) { return a[z] < b[z]; };
        const auto [z0, z1] = std::minmax_element(column.begin(), column.end(), by_z);
        for (auto k = box_of((*z0)[z]); k <= box_of((*z1)[z] + height); ++k) {
          Index index{};
          index[2 - x] = i;
          index[2 - y] = j;
          index[2 - z] = k;
          marked.insert(index);
        }
      }
    }
  }
  for (const auto& [k, j, i] : marked) {
    scene::BakePlace cell;
    cell.name = fmt::format("{},{},{}", i, j, k);
    for (unsigned corner = 0; corner < 8; ++corner) {
      cell.points.push_back({static_cast<double>(i + (corner & 1U)) * size,
                             static_cast<double>(j + (corner >> 1U & 1U)) * size,
                             static_cast<double>(k + (corner >> 2U & 1U)) * size});
    }
    out.cells.push_back(std::move(cell));
  }
  if (out.cells.empty())
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--cells auto:{}: nothing that blocks is flat enough to walk on", size));
  return out;
}

}  // namespace clues::app
