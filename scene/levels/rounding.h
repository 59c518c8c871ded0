// D23: a convex polytope W between two with double vertices, W_in inside W inside W_out. What is returned is proved: each
// point of W_in satisfies every half space of W; every vertex of W lies in every half space of a facet of W_out's hull, or
// in a box whose corners are among the points of W_out.
#pragma once

#include <optional>
#include <vector>

#include "scene/levels/polytope.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

// For every vertex of the polytope a double point near it and in the polytope, the vertex itself where it is one. None
// where no such point is found: a sliver thinner than doubles are dense there. `grid`: where such a point is near, one whose
// coordinates are multiples of 2^-grid, but for those that are doubles in the vertex. O(vertices * faces).
std::optional<std::vector<Point>> inner_vertices(const Polytope& polytope, std::optional<int> grid = {});

// Distinct points with the polytope in their hull: its vertices where they are doubles, else points with those coordinates of
// the vertex that are. So a side across an axis, whose offset is a double, bounds them too. O(vertices^4) for up to 24 of them.
std::vector<Point> outer_points(const Polytope& polytope);

// Whether the points are in one plane, exactly.
bool are_coplanar(const std::vector<Point>& points);

}  // namespace clues::scene
