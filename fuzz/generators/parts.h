// What the generators of small scenes have in common.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/mesh/mesh.h"

namespace clues::fuzz {

// Generator number `salt`'s own numbers.
Random random_of(std::uint64_t seed, std::uint64_t index, std::uint64_t salt);

// How strong the named degeneracy of a scene is, 0 to 7: `NAME:D` on the command line asks for one strength only.
inline constexpr int dials = 8;
inline int dial_of(std::uint64_t index) { return static_cast<int>(index % dials); }

template <class T>
auto& any(T& from, Random& random) {
  return from[static_cast<std::size_t>(random.between(0, static_cast<int>(from.size()) - 1))];
}

// x, or (every other time) a little beside it: dial 0 never, 1 one ulp, 2 to 7: 2^-40, 2^-34, ... 2^-10.
double off(Random& random, double x, int dial);

// One of the random scenes of at most 30 triangles, to be spoilt.
GeneratedScene base_scene(Random& random);

// Triangles with corners of their own.
void add(scene::TriangleMesh& mesh, const scene::Point& a, const scene::Point& b, const scene::Point& c);
void add_quad(scene::TriangleMesh& mesh, const scene::Point& a, const scene::Point& b, const scene::Point& c,
              const scene::Point& d);
// A wall far behind, so that shadows fall on something.
void add_receiver(scene::TriangleMesh& mesh, double x);

std::vector<scene::Point> box_of(const scene::Point& lo, const scene::Point& hi);  // its corners, x fastest
// Its sides as corners of box_of, counter-clockwise seen from outside.
inline constexpr std::array<std::array<std::uint32_t, 4>, 6> box_sides{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
// The closed box: two triangles for each of these sides, in their order; face_of is empty.
scene::TriangleMesh closed_box(const scene::Point& lo, const scene::Point& hi);
// The corners in order and each once, for boxes that are flat, segments or points.
std::vector<scene::Point> distinct_corners(const scene::Point& lo, const scene::Point& hi);

std::array<std::size_t, 3> shuffled_axes(Random& random);

// Whether each edge of the mesh is met once in each direction: closed and consistently oriented.
bool is_closed(const scene::TriangleMesh& mesh);

}  // namespace clues::fuzz
