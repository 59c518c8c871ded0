// A surface meshed anew over its base domain (D34): every triangle of the base in parts of 4^level, or as fine as an error asks for. What comes out is connected
// like the base domain, subdivided; every vertex is a point of one input triangle, with exact weights; and how far input and remesh are
// apart is bounded, both ways.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>

#include "reference/multires/remesh_error.h"
#include "scene/multires/remesh_proof.h"

namespace clues::reference {

struct RemeshOptions {
  int level = 0;  // every base triangle in 4^level
  double error =
      std::numeric_limits<double>::infinity();  // then finer where the bound is above that, in units of the mesh
  int most = 8;                                 // but no finer than 4^most
  bool single = false;                          // positions are rounded to floats, as formats of floats do
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

struct Remesh {
  scene::TriangleMesh mesh;                  // positions are those of `sources`, rounded
  std::vector<scene::CarrierPoint> sources;  // of each vertex, on the input
  std::vector<std::uint32_t> base;           // of each triangle
  std::vector<std::size_t> first_piece;      // of each triangle; and their number at the end
  std::vector<bool> turned;                  // of each triangle: half of those of a base triangle stand on their heads
  scene::RemeshProof proof;                  // parameters, pieces, and the bounds of the rounded mesh
  bool reached = true;                       // the error that was asked for
  double error() const { return std::max(proof.to_remesh, proof.to_input); }  // bounds the Hausdorff distance
};

// The map may be another one than that of the overlay, in base triangles that are crowded (room.h), and by that the proof's.
// Neighbours differ by at most one level, and a triangle whose neighbour is finer is cut in two, so that edges meet whole edges. `hierarchy` has
// to be a verified one. Where the grids are too coarse for an error that is asked for, parts are larger; for `level`: throws Error unsupported, bad_argument for a level above `most` or most_levels.
Remesh remeshed(const scene::Hierarchy& hierarchy, const RemeshOptions& options);

// Parts of it: where a vertex lies; and the bounds of a triangle of the remesh, added to those of the proof, with the triangles that its pieces are near to.
scene::Point remesh_position(const scene::CarrierPoint& source, const scene::TriangleMesh& input, bool single);
void add_error(const Patch& patch, const scene::TriangleMesh& mesh, const scene::Triangle& t,
               const scene::TriangleMesh& input, scene::RemeshProof& proof);

}  // namespace clues::reference
