// D1: a scene is a finite list of closed triangles in input order, with coordinates that are IEEE
// doubles read as exact rationals. Nothing here rounds, merges, reorders or repairs.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace clues::scene {

using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Point> points;           // finite doubles, bit for bit as in the file (-0.0 included)
  std::vector<Triangle> triangles;     // triangle i is the i-th triangle of the file (D1)
  std::vector<std::uint32_t> face_of;  // per triangle: the number of the input face it was fanned from
};

// Triangles whose three corners are collinear or coincide, decided exactly; ascending ids. They keep
// their ids but are no surface. O(n).
std::vector<std::uint32_t> degenerate_triangles(const TriangleMesh& mesh);

}  // namespace clues::scene
