// One side of a piece of the complex from the set of what is visible on it, and back.
#pragma once

#include <cstdint>

#include "reference/visibility/map/side_faces.h"
#include "reference/visibility/planar/flat_set.h"

namespace clues::reference {

SideFaces side_faces(const FlatSet& visible, const TriangleFrame& frame, std::uint32_t piece, bool front);

// A region of the piece, laid flat.
Face2 flat_face(const Region& region, const TriangleFrame& frame);

// All of the triangle.
FlatSet whole_of(const TriangleFrame& frame);

}  // namespace clues::reference
