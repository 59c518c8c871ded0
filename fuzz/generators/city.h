// A city of any size (D1): a grid of streets, box buildings of varying height, and some buildings with a room, a doorway
// and a window in walls of real thickness. Ground and buildings are one conforming, oriented surface: no T-junctions.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::fuzz {

// About `triangles` triangles (within 10 % from 200 on; the least city has 26). Coordinates are multiples of 1/4 metre, z is up.
// A pure function of its arguments. O(n log n).
scene::TriangleMesh make_city(std::uint32_t triangles, std::uint64_t seed);

// The eight corners of a box cell at eye height, close to a wall, in a street near the centre of make_city(triangles, seed).
// It touches nothing.
std::vector<scene::Point> street_cell(std::uint32_t triangles, std::uint64_t seed);

}  // namespace clues::fuzz
