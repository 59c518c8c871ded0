// Surfaces for hierarchies (D31): of known genus and number of boundaries, with everything that makes a map hard. Pure functions.
#pragma once

#include <cstdint>

#include "scene/mesh/mesh.h"

namespace clues::fuzz {

// An octahedron whose edges are cut into n, on a sphere: 8 n^2 triangles.
scene::TriangleMesh ball(int n);
// The boundary of a slab of unit cubes with so many holes through it, each square cut into 2 n^2 triangles: genus `holes`.
scene::TriangleMesh frame(int holes, int n);
// n times n squares, flat, each cut in two: a disc. n >= 1.
scene::TriangleMesh sheet(int n);
// A fan of n triangles around vertex 0, closed or open.
scene::TriangleMesh fan(int n, bool closed);
// A strip of n squares with a half turn (n odd or even): no orientation exists.
scene::TriangleMesh moebius(int n);

struct SurfaceCase {
  scene::TriangleMesh mesh;
  int genus = 0, boundaries = 0;
};
// A ball, frame or sheet with edges flipped at random (degrees from 3 up), discs cut out, vertices renumbered, and, by the index: left as it is,
// shaken, folded (neighbours at random places), with slivers (coordinates pressed to a line), or with many vertices in one place.
SurfaceCase surface_case(std::uint64_t seed, std::uint64_t index);

}  // namespace clues::fuzz
