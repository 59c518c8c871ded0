// Quadratic Bezier curves in both directions, at dyadic parameters; de Casteljau's construction, whose steps are halves and quarters.
#include "scene/levels/bsp_patch.h"

#include "scene/levels/bsp_scene.h"

namespace clues::scene {
namespace {

Point mixed(const Point& a, const Point& b, double share) {
  Point p;
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = (1 - share) * a[axis] + share * b[axis];
  return p;
}

Point on_curve(const Point& a, const Point& b, const Point& c, double share) {
  return mixed(mixed(a, b, share), mixed(b, c, share), share);
}

}  // namespace

std::vector<std::array<Point, 3>> triangles_of_patch(const BspFile& level, const BspFile::Face& patch) {
  const std::uint32_t columns = patch.controls[0], rows = patch.controls[1];
  const auto control = [&](std::uint32_t x, std::uint32_t y) -> const Point& {
    return level.points[patch.vertices.first + y * columns + x];
  };
  const std::uint32_t across = (columns - 1) / 2 * patch_steps, down = (rows - 1) / 2 * patch_steps;
  const auto point = [&](std::uint32_t i, std::uint32_t j) {
    // A point on the rim of two patches belongs to the first of them, and is the shared control point's curve in both.
    const std::uint32_t x = 2 * (i == across ? i / patch_steps - 1 : i / patch_steps);
    const std::uint32_t y = 2 * (j == down ? j / patch_steps - 1 : j / patch_steps);
    const double u = (i - x / 2 * patch_steps) / static_cast<double>(patch_steps);
    const double v = (j - y / 2 * patch_steps) / static_cast<double>(patch_steps);
    std::array<Point, 3> curve;
    for (std::uint32_t k = 0; k < 3; ++k)
      curve[k] = on_curve(control(x, y + k), control(x + 1, y + k), control(x + 2, y + k), u);
    return on_curve(curve[0], curve[1], curve[2], v);
  };
  std::vector<std::array<Point, 3>> triangles;
  std::vector<Point> above, below;
  for (std::uint32_t j = 0; j <= down; ++j) {
    below.clear();
    for (std::uint32_t i = 0; i <= across; ++i) below.push_back(point(i, j));
    for (std::uint32_t i = 0; i < across && j > 0; ++i) {
      triangles.push_back({above[i], below[i], above[i + 1]});
      triangles.push_back({above[i + 1], below[i], below[i + 1]});
    }
    above.swap(below);
  }
  return triangles;
}

}  // namespace clues::scene
