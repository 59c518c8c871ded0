#include "fuzz/generators/skew_edges.h"

#include <array>

#include "fuzz/generators/parts.h"

namespace clues::fuzz {
namespace {

// Covers n . x >= g at height z, as far as 8; n has entries -1, 0, 1.
void add_half_plane(scene::TriangleMesh& mesh, double nx, double ny, double g, double z) {
  constexpr double r = 8;
  const double s = nx * nx + ny * ny, x = nx * g / s, y = ny * g / s;
  add_quad(mesh, {x + r * ny, y - r * nx, z}, {x + r * (ny + nx), y + r * (ny - nx), z},
           {x + r * (nx - ny), y + r * (ny + nx), z}, {x - r * ny, y + r * nx, z});
}

void add_receiver_above(scene::TriangleMesh& mesh, double r, double z) {
  add_quad(mesh, {-r, -r, z}, {r, -r, z}, {r, r, z}, {-r, r, z});
}

}  // namespace

GeneratedScene two_slits() {
  GeneratedScene scene{"two-slits", {}, box_of({-1, -1, 0}, {1, 1, 0.5}), false};
  add_half_plane(scene.mesh, 0, 1, 1 / 8., 2);
  add_half_plane(scene.mesh, 0, -1, 1 / 8., 2);
  add_half_plane(scene.mesh, 1, 1, 1 / 8., 4);
  add_half_plane(scene.mesh, -1, -1, 1 / 8., 4);
  add_receiver_above(scene.mesh, 8, 6);
  return scene;
}

GeneratedScene three_skew_edges() {
  GeneratedScene scene{"three-skew-edges", {}, box_of({-1, -1, 0}, {1, 1, 0.5}), false};
  add_half_plane(scene.mesh, 0, 1, 1 / 4., 2);
  add_half_plane(scene.mesh, 1, -1, 1 / 4., 3);
  add_half_plane(scene.mesh, -1, -1, 1 / 4., 4);
  add_receiver_above(scene.mesh, 8, 6);
  return scene;
}

GeneratedScene keyhole() {
  GeneratedScene scene{"keyhole", {}, box_of({-0.5, -0.5, -1}, {0.5, 0.5, 0}), false};
  for (const auto& [nx, ny, z] : {std::array<double, 3>{1, 0, 1}, {0, 1, 2}, {1, 1, 3}, {1, -1, 4}}) {
    add_half_plane(scene.mesh, nx, ny, 1 / 16., z);
    add_half_plane(scene.mesh, -nx, -ny, 1 / 16., z);
  }
  add_receiver_above(scene.mesh, 4, 6);
  return scene;
}

}  // namespace clues::fuzz
