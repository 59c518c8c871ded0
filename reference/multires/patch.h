// A triangle of parameters (part of a triangle of the base domain) with the pieces of the overlay in it, exactly: cut into four at the
// middles of its edges, or into two. The pieces are cut with it, so that each lies in one part and stays linear on both sides.
#pragma once

#include <array>
#include <vector>

#include "reference/multires/stars/star_pieces.h"

namespace clues::reference {

struct Patch {
  std::uint32_t base = 0;                      // number of the base triangle
  scene::Triangle triangle{};                  // its corners
  std::array<scene::CarrierPoint, 3> corners;  // of the patch, in parameters, counter-clockwise
  int level = 0;                               // 4^level of them make up a base triangle
  StarPieces pieces;                           // `flat` is in units of 2^-84 along two edges of the base triangle
};

// Patches cannot be cut more often: their corners lie on the grid of 2^-24.
inline constexpr int most_levels = 20;

// The same input, base domain and pieces with coarser parameters: those of a point are moved to the grid of 2^-30 where all pieces around it stay
// positive, in order. Any such overlay is a homeomorphism, and what lies on a line by symmetry lies on it again, not 2^-60 beside it.
scene::Hierarchy with_coarse_parameters(const scene::Hierarchy& hierarchy);

// The base triangles with their pieces.
std::vector<Patch> base_patches(const scene::Hierarchy& hierarchy);

scene::CarrierPoint middle_of(const scene::CarrierPoint& a, const scene::CarrierPoint& b);  // of corners of a patch

// Into the three at the corners and the one between, or at the middle of the edge from corner `edge` to the next. Where the pieces cannot be
// carried on the grids: Error unsupported.
std::vector<Patch> cut_in_four(const Patch& patch, const scene::Hierarchy& hierarchy);
std::vector<Patch> cut_in_two(const Patch& patch, std::size_t edge, const scene::Hierarchy& hierarchy);

// Where the surface is at a corner of the patch.
scene::CarrierPoint source_at(const Patch& patch, const scene::CarrierPoint& corner);

}  // namespace clues::reference
