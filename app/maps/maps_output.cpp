#include "app/maps/maps_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/ply_text.h"

namespace clues::app {
namespace {

// Neighbouring numbers get colours far apart.
std::array<std::uint32_t, 3> colour_of(std::uint32_t number) {
  const double hue = std::fmod(0.618033988749895 * number, 1.0) * 6,
               shade = number % 3 == 0 ? 1.0 : (number % 3 == 1 ? 0.8 : 0.6);
  const double x = 1 - std::abs(std::fmod(hue, 2.0) - 1);
  const std::array<std::array<double, 3>, 6> wheel{{{1, x, 0}, {x, 1, 0}, {0, 1, x}, {0, x, 1}, {x, 0, 1}, {1, 0, x}}};
  std::array<std::uint32_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = static_cast<std::uint32_t>(255 * shade * (0.25 + 0.75 * wheel[static_cast<std::size_t>(hue) % 6][i]));
  }
  return out;
}

// The base triangle that a piece lies in; no_vertex for a file that was not verified.
std::uint32_t base_of(const std::map<scene::Triangle, std::uint32_t>& base, const scene::Hierarchy& h,
                      const scene::OverlayTriangle& piece) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t p : piece.corners) {
    const auto& image = h.points[p].image;
    corners.insert(corners.end(), image.corner.begin(),
                   image.corner.begin() + static_cast<std::ptrdiff_t>(image.size()));
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto found = corners.size() == 3 ? base.find({corners[0], corners[1], corners[2]}) : base.end();
  return found == base.end() ? scene::no_vertex : found->second;
}

}  // namespace

std::string patches_to_ply(const scene::Hierarchy& h) {
  std::map<scene::Triangle, std::uint32_t> base;
  for (std::uint32_t t = 0; t < h.base.size(); ++t) {
    auto corners = h.base[t];
    std::sort(corners.begin(), corners.end());
    base.emplace(corners, t);
  }
  scene::PlyText out(h.points.size(), h.pieces.size(), {.of_face = scene::ply_colour});
  for (const auto& p : h.points) out.vertex(reference::position_estimate(p.source, h.input));
  for (const auto& piece : h.pieces) {
    const auto [r, g, b] = colour_of(base_of(base, h, piece));
    out.face({piece.corners[0], piece.corners[1], piece.corners[2]}, {r, g, b});
  }
  return out.take();
}

std::string base_to_svg(const scene::Hierarchy& h) {
  constexpr double size = 760, margin = 20;
  scene::Point low{}, high{};
  bool first = true;
  for (const auto& t : h.base) {
    for (const std::uint32_t v : t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = h.input.points[v][i];
        low[i] = first ? x : std::min(low[i], x);
        high[i] = first ? x : std::max(high[i], x);
      }
      first = false;
    }
  }
  // Halves, so that the difference of huge coordinates is finite.
  const double extent = std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2);
  const auto at = [&](std::uint32_t v, std::size_t i) {
    const double part = extent > 0 ? (h.input.points[v][i] / 2 - low[i] / 2) / extent : 0.5;
    return margin + size * (i == 1 ? 1 - part : part);
  };
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t t = 0; t < h.base.size(); ++t) {
    double depth = 0;
    for (const std::uint32_t v : h.base[t]) depth += h.input.points[v][2] / 3;
    order.emplace_back(depth, t);
  }
  std::sort(order.begin(), order.end());
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(
      to,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 800\">\n<title>base domain: {} triangles</title>\n",
      h.base.size());
  for (const auto& [depth, t] : order) {
    const auto colour = colour_of(t);
    const auto& c = h.base[t];
    fmt::format_to(to,
                   "<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}L{:.2f} {:.2f}Z\" fill=\"#{:02x}{:02x}{:02x}\" "
                   "stroke=\"#222\" stroke-width=\"0.8\"/>\n",
                   at(c[0], 0), at(c[0], 1), at(c[1], 0), at(c[1], 1), at(c[2], 0), at(c[2], 1), colour[0], colour[1],
                   colour[2]);
  }
  fmt::format_to(to, "</svg>\n");
  return fmt::to_string(out);
}

std::string base_to_off(const scene::Hierarchy& h) {
  std::vector<std::uint32_t> number(h.input.points.size(), scene::no_vertex);
  scene::TriangleMesh mesh;
  for (const auto& t : h.base) {
    for (const std::uint32_t v : t) number[v] = 0;
  }
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == scene::no_vertex) continue;
    number[v] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(h.input.points[v]);
  }
  for (const auto& t : h.base) mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return scene::to_off_text(mesh);
}

void require_remesh_format(const std::string& file) {
  const std::string extension = scene::lower_case_extension(file);
  if (extension != ".ply" && extension != ".obj" && extension != ".off") {
    throw scene::Error(scene::ErrorCode::unsupported,
                       fmt::format("--remesh {}: meshes are written as .ply, .obj or .off", file));
  }
}

std::string remesh_to_file(const reference::Remesh& remesh, const std::string& file) {
  const std::string extension = scene::lower_case_extension(file);
  if (extension == ".off") return scene::to_off_text(remesh.mesh);
  const auto& mesh = remesh.mesh;
  if (extension == ".obj") {
    fmt::memory_buffer out;
    auto to = std::back_inserter(out);
    for (const auto& p : mesh.points) fmt::format_to(to, "v {} {} {}\n", p[0], p[1], p[2]);
    for (const auto& t : mesh.triangles) fmt::format_to(to, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return fmt::to_string(out);
  }
  scene::PlyText out(mesh.points.size(), mesh.triangles.size(), {.of_face = scene::ply_colour});
  for (const auto& p : mesh.points) out.vertex(p);
  for (std::size_t k = 0; k < remesh.base.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const auto [r, g, b] = colour_of(remesh.base[k]);
    out.face({t[0], t[1], t[2]}, {r, g, b});
  }
  return out.take();
}

}  // namespace clues::app
