// D34: how far a triangle of a remesh and the part of the surface that it stands for are from each other, both ways, bounded from above.
//
// Both are linear on each piece of the patch. The distance to a triangle is a convex function, so that on the piece it is largest at a corner: what
// the corners of a piece are away from the remesh triangle bounds all of the piece's source, and what the same corners, taken on the remesh
// triangle, are away from its input triangle (or any other one) bounds that part of the remesh. Distances are bounded by naming a near point and
// computing the distance to it in intervals, which encloses rounding.
#pragma once

#include <array>
#include <limits>

#include "reference/multires/patch.h"

namespace clues::reference {

struct PatchError {
  double to_remesh = 0;  // every point of the surface in the patch is that near to the remesh triangle
  double to_input = 0;   // every point of the remesh triangle is that near to the surface
  double worst() const { return to_remesh > to_input ? to_remesh : to_input; }
};

// `triangle`: the corners of the patch in the remesh. Coordinates below 2^500, or the bound is infinite. `near`, where it is given: for each piece an
// input triangle that its part of the remesh triangle is within to_input of. Where one of the two is above `enough`, what is returned is one above it.
PatchError error_bound(const Patch& patch, const std::array<scene::Point, 3>& triangle,
                       const scene::TriangleMesh& input, std::vector<std::uint32_t>* near = nullptr,
                       double enough = std::numeric_limits<double>::infinity());

// Where a point of the input surface lies, rounded; not beyond the corners that it lies between.
scene::Point position_estimate(const scene::CarrierPoint& source, const scene::TriangleMesh& input);

}  // namespace clues::reference
