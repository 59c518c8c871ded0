// Small meshes that hit one kind of difficulty of motion bounds (D29) each, and closed ones to walk in. Pure functions of seed and number.
#pragma once

#include <cstdint>

#include "scene/motion/depth_mesh.h"

namespace clues::fuzz {

enum class MotionKind : std::uint8_t {
  random,      // depths from 1 to 4, angles up to 0.6
  small,       // the same, angles down to 0.003
  wall,        // the four in one plane, seen obliquely
  thin,        // a needle: one vertex next to the opposite edge, down to 2^-40 of its length
  near,        // the viewpoint next to a sample
  far,         // samples a million times farther than they are apart
  cocircular,  // seen on one circle, exactly: G = 0
  one_ulp,     // the same with one coordinate moved by one unit in the last place
  scaled,      // times 2^k, k from -300 to 300: products keep within what integers do not care about
  sky          // one to three of the four are directions
};
inline constexpr int motion_kinds = 10;

// Two triangles, 0 1 2 and 3 2 1, at the edge 1-2, with thresholds that the viewpoint keeps about half of the time. Triangle 0 faces the
// viewpoint strictly (needles and one ulp included); triangle 1 mostly.
struct MotionCase {
  scene::DepthMesh mesh;
  scene::MotionPoint viewpoint{};
  scene::MotionThresholds thresholds;
};
MotionCase motion_case(MotionKind kind, std::uint64_t seed, std::uint64_t index);

// A closed depth mesh around the origin, 8 n^2 triangles: the octahedron with edges cut into n, vertices at depths from 1 to 1 + relief.
// `sky`: the upper half stands at infinity.
scene::DepthMesh globe(int n, double relief, std::uint64_t seed, bool sky = false);

}  // namespace clues::fuzz
