// Uses the installed package as a stranger would: a screen before a wall, seen from a point.
#include <cstdio>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/first_order.h"

int main() {
  clues::scene::TriangleMesh mesh;
  mesh.points = {{-4, -4, 1}, {4, -4, 1},  {0, 4, 1},   {-1, -1, 2}, {1, -1, 2},
                 {0, 1, 2},   {-9, -9, 2}, {-8, -9, 2}, {-9, -8, 2}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  mesh.face_of = {0, 1, 2};
  const auto cell = clues::exact::ConvexCell::from_doubles({{0, 0, 0}});
  const auto map = clues::reference::first_order_visibility(mesh, cell, {});
  const bool right = map.visible == std::vector<std::uint32_t>{0, 2};
  std::puts(right ? "consumer: the hidden triangle is hidden" : "consumer: wrong answer");
  return right ? 0 : 1;
}
