// The pieces of one star while it is flattened (D33): their points by numbers of their own, laid out in the disk.
#pragma once

#include <vector>

#include "exact/multires/grid.h"

namespace clues::reference {

struct StarPoint {
  std::uint32_t number = scene::no_vertex;  // in the overlay; no_vertex: introduced here
  bool of_input = false;
  scene::OverlayVertex at;
  exact::FlatPoint flat;
};

struct StarPiece {
  std::array<std::uint32_t, 3> corners{};  // points of this star
  std::uint32_t input = 0;
  bool cut = false;  // its source is new
};

struct StarPieces {
  std::vector<StarPoint> points;
  std::vector<StarPiece> pieces;
};

// A new edge across the disk, between two ring vertices.
struct Diagonal {
  std::uint32_t a = 0, b = 0;
  exact::DiskPoint at_a{}, at_b{};
};

// Cuts the pieces along the diagonal. Where an edge crosses it, a point is introduced, at the grid point of the diagonal below the
// crossing. False: the grid has none strictly between the ends, or none between the ends of the source.
bool cut_along(const Diagonal& diagonal, StarPieces& star);

// Takes out what points it can that are not of the input and lie inside of `triangle`, of which these are all pieces: such a point is moved onto a
// neighbour (along the input edge that it lies on), if all pieces that are left keep both orientations.
void simplify(const scene::Triangle& triangle, const std::vector<scene::Triangle>& input, const StarPieces& star,
              std::vector<StarPiece>& pieces);
// The same for all triangles at a vertex, by triangle, with points on the edges from it: these move along the edge.
void simplify_star(const std::vector<scene::Triangle>& triangles, std::uint32_t hub,
                   const std::vector<scene::Triangle>& input, const StarPieces& star,
                   std::vector<std::vector<StarPiece>>& pieces);

}  // namespace clues::reference
