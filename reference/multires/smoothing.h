// A remesh made smoother by moving its parameters: each vertex goes where the weights of Loop's subdivision put it between its neighbours, in the plane
// that its star is laid out in (D32, z^a), and comes to lie on the input at the point that is there. A move is a map of the star to itself that
// is linear on its parts and is carried through the pieces, with every sign seen to; so what comes out is a homeomorphism of base domain and input as
// before (D33), linear on pieces, and its distance is bounded as before (D34). What a vertex stands for on the base domain stays: its image is another.
#pragma once

#include <functional>

#include "reference/multires/remesh.h"

namespace clues::reference {

struct SmoothingOptions {
  int rounds = 1;       // every vertex is moved once in each, in order
  bool single = false;  // as in RemeshOptions
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

// Vertices on features of the hierarchy, and those that it keeps, stay where they are, and so do vertices of the base domain on the boundary; others
// on the boundary stay on it. A move that some sign or the
// grid forbids is made half as far, or a quarter, or not at all. Returns the number of moves. The bounds of the remesh are those of what comes
// out; `reached` is no longer asked.
std::uint64_t smooth(Remesh& remesh, const scene::Hierarchy& hierarchy, const SmoothingOptions& options);

// Between the normals of neighbouring triangles, in degrees, by doubles; flat triangles are left out.
struct NeighbourAngles {
  double largest = 0, mean = 0;
};
NeighbourAngles neighbour_angles_estimate(const scene::TriangleMesh& mesh);

}  // namespace clues::reference
