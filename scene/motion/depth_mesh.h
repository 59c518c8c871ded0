// A depth mesh (D28): a triangulated sphere around a viewpoint, whose vertices are samples of a scene. No algorithm, only the shapes that
// the reference, the fast path and the judges of motion bounds share.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace clues::scene {

using MotionPoint = std::array<double, 3>;  // world coordinates, taken exactly

// How far from the origin a viewpoint may be, in each coordinate.
inline constexpr double farthest_viewpoint = 0x1p90;

// A vertex of the mesh. A `point` sample stands at `at`. A `direction` (sky, or a vertex of the icosahedral base) stands at infinity: it is
// seen in direction `at` from everywhere, which needs no unit length.
struct DepthSample {
  MotionPoint at{};
  bool is_direction = false;
  bool is_base = false;  // a vertex of the base mesh; kept when samples are deleted

  bool operator==(const DepthSample&) const = default;
};

// Triangles are counter-clockwise as the viewpoint sees them from inside: det(a - v, b - v, c - v) > 0 where all is well.
struct DepthMesh {
  std::vector<DepthSample> samples;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool operator==(const DepthMesh&) const = default;
};

// D29: thresholds are numbers, never angles. Doubles, taken exactly.
struct MotionThresholds {
  double kappa = 2000;   // cot(phi): phi is the least projected length of an edge, 5e-4 rad
  double sigma = 4e-14;  // sin^2(eps): eps is the least projected distance of a vertex from the opposite edge, 2e-7 rad
  bool delaunay = false;  // whether edges have to be locally Delaunay too

  bool operator==(const MotionThresholds&) const = default;
};

}  // namespace clues::scene
