#include "app/maps/maps_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "app/maps/patch_colours.h"
#include "scene/mesh_io.h"
#include "scene/multires/image_triangles.h"
#include "scene/ply_text.h"

namespace clues::app {

std::string patches_to_ply(const scene::Hierarchy& h) {
  const scene::ImageTriangles base(h.base);
  scene::PlyText out(h.points.size(), h.pieces.size(), {.of_face = scene::ply_colour});
  for (const auto& p : h.points) out.vertex(reference::position_estimate(p.source, h.input));
  for (const auto& piece : h.pieces) {
    const auto [r, g, b] = patch_colour(base.of(piece, h.points));
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
    const auto colour = patch_colour(t);
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

std::string checker_to_ply(const reference::Remesh& remesh, const scene::TriangleMesh& input) {
  const auto& proof = remesh.proof;
  scene::PlyText out(proof.points.size(), proof.pieces.size(), {.of_face = scene::ply_colour});
  for (const auto& p : proof.points) out.vertex(reference::position_estimate(p.source, input));
  for (std::size_t t = 0; t < remesh.base.size(); ++t) {
    auto colour = patch_colour(remesh.base[t]);
    for (std::uint32_t& value : colour) value = remesh.turned[t] ? value / 4 : 128 + value / 2;
    for (std::size_t i = remesh.first_piece[t]; i < remesh.first_piece[t + 1]; ++i) {
      const auto& c = proof.pieces[i].corners;
      out.face({c[0], c[1], c[2]}, {colour[0], colour[1], colour[2]});
    }
  }
  return out.take();
}

}  // namespace clues::app
