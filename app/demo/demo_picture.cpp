// Every region of the map is cut into triangles exactly and then rounded for drawing.
#include "app/demo/demo_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reference/visibility/map/sides.h"
#include "scene/ply_text.h"
#include "validate/certificates/region_points.h"

namespace clues::app {
namespace {

using scene::Point;

enum class Paint { away, hidden, seen };

const std::array<std::array<std::uint32_t, 3>, 3> colours{{{150, 150, 150}, {120, 20, 25}, {60, 175, 75}}};

struct Fragment {
  Paint paint = Paint::away;
  std::array<Point, 3> corners;
  Point normal;  // unit, on the side that is drawn
};

Point unit_normal(const exact::Plane3& plane, bool front) {
  const Point n{CGAL::to_double(plane.a()), CGAL::to_double(plane.b()), CGAL::to_double(plane.c())};
  const double length = std::hypot(n[0], n[1], n[2]) * (front ? 1 : -1);
  return {n[0] / length, n[1] / length, n[2] / length};
}

std::vector<Fragment> fragments(const reference::VisibilityMap& map) {
  std::vector<Fragment> all;
  for (const auto& region : map.regions) {
    const bool facing = reference::faces_cell(map.complex, map.cell, region.piece, region.front);
    const Paint paint = region.visible ? Paint::seen : facing ? Paint::hidden : Paint::away;
    const Point normal = unit_normal(map.complex.planes[region.piece], region.front);
    for (const auto& triangle : validate::triangulate_region(region.rings)) {
      Fragment fragment{paint, {}, normal};
      for (int i = 0; i < 3; ++i) fragment.corners[i] = exact::to_double_estimate(triangle[i]);
      const auto& [a, b, c] = fragment.corners;
      const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, w{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const double turn = normal[0] * (u[1] * w[2] - u[2] * w[1]) + normal[1] * (u[2] * w[0] - u[0] * w[2]) +
                          normal[2] * (u[0] * w[1] - u[1] * w[0]);
      if (turn < 0) std::swap(fragment.corners[1], fragment.corners[2]);
      all.push_back(fragment);
    }
  }
  return all;
}

struct Bounds {
  Point lo, hi;
};

Bounds bounds_of(const reference::VisibilityMap& map) {
  Bounds bounds{exact::to_double_estimate(map.cell.center()), exact::to_double_estimate(map.cell.center())};
  const auto include = [&](const exact::Point3& exact_point) {
    const auto p = exact::to_double_estimate(exact_point);
    for (int i = 0; i < 3; ++i) {
      bounds.lo[i] = std::min(bounds.lo[i], p[i]);
      bounds.hi[i] = std::max(bounds.hi[i], p[i]);
    }
  };
  for (const auto& p : map.complex.points) include(p);
  for (const auto& p : map.cell.vertices()) include(p);
  return bounds;
}

std::string hex_colour(Paint paint) {
  const auto& [r, g, b] = colours[static_cast<std::size_t>(paint)];
  return fmt::format("#{:02x}{:02x}{:02x}", r, g, b);
}

}  // namespace

std::string to_ply_text(const reference::VisibilityMap& map) {
  const auto all = fragments(map);
  const auto [lo, hi] = bounds_of(map);
  const double hair = 1.0 / 8192 * std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
  scene::PlyText text(3 * all.size(), all.size(),
                      {.comment = "green: seen from the cell; dark red: hidden; grey: faces away",
                       .of_vertex = scene::ply_colour,
                       .of_face = scene::ply_colour,
                       .floats = true});
  for (const auto& fragment : all) {
    const auto& [r, g, b] = colours[static_cast<std::size_t>(fragment.paint)];
    for (const auto& p : fragment.corners) {
      const auto& n = fragment.normal;
      text.vertex({p[0] + hair * n[0], p[1] + hair * n[1], p[2] + hair * n[2]}, {r, g, b});
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [r, g, b] = colours[static_cast<std::size_t>(all[i].paint)];
    text.face({3 * i, 3 * i + 1, 3 * i + 2}, {r, g, b});
  }
  return text.take();
}

std::string to_svg_text(const reference::VisibilityMap& map, const std::string& title) {
  auto all = fragments(map);
  const auto [lo, hi] = bounds_of(map);
  constexpr double width = 900, margin = 20, caption = 30;
  const double scale = width / std::max(hi[0] - lo[0], hi[1] - lo[1]);
  const auto x = [&, left = lo[0]](double value) { return margin + (value - left) * scale; };
  const auto y = [&, top = hi[1]](double value) { return margin + (top - value) * scale; };
  const double full_width = 2 * margin + (hi[0] - lo[0]) * scale;
  const double full_height = 2 * margin + caption + (hi[1] - lo[1]) * scale;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.1f} {1:.1f}\" width=\"{0:.1f}\" "
      "height=\"{1:.1f}\">\n"
      "<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      full_width, full_height, title);

  // From low to high; what faces down is not seen from above. Upright faces come last, seen over hidden over away.
  constexpr double upright = 1.0 / 1024;
  const auto height = [](const Fragment& f) { return f.corners[0][2] + f.corners[1][2] + f.corners[2][2]; };
  std::erase_if(all, [&](const Fragment& f) { return f.normal[2] < -upright; });
  std::stable_sort(all.begin(), all.end(), [&](const Fragment& a, const Fragment& b) {
    const bool a_upright = a.normal[2] < upright, b_upright = b.normal[2] < upright;
    if (a_upright != b_upright) return b_upright;
    return a_upright ? a.paint < b.paint : height(a) < height(b);
  });
  for (const auto& f : all) {
    const bool stroke_only = f.normal[2] < upright;
    if (stroke_only && f.paint == Paint::away) continue;
    const auto colour = hex_colour(f.paint);
    text += fmt::format(
        "<polygon points=\"{:.2f},{:.2f} {:.2f},{:.2f} {:.2f},{:.2f}\" fill=\"{}\" stroke=\"{}\" "
        "stroke-width=\"{}\"/>\n",
        x(f.corners[0][0]), y(f.corners[0][1]), x(f.corners[1][0]), y(f.corners[1][1]), x(f.corners[2][0]),
        y(f.corners[2][1]), stroke_only ? "none" : colour, colour, stroke_only ? 2.5 : 0.3);
  }
  for (const auto& edge : map.cell.edges()) {
    const auto a = exact::to_double_estimate(map.cell.vertices()[edge[0]]);
    const auto b = exact::to_double_estimate(map.cell.vertices()[edge[1]]);
    text += fmt::format(
        "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"#1f4fd8\" stroke-width=\"3\"/>\n",
        x(a[0]), y(a[1]), x(b[0]), y(b[1]));
  }
  text += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"15\">{} - blue: view cell; green: "
      "seen; dark red: hidden; grey: faces away</text>\n</svg>\n",
      margin, full_height - margin, title);
  return text;
}

}  // namespace clues::app
