// Triangles and interior points of a planar region with holes, exactly: for pictures, and as places to look for witnesses.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact/kernel.h"

namespace clues::validate {

using Rings = std::vector<std::vector<exact::Point3>>;  // outer boundary first, then holes; all in one plane
using ExactTriangle = std::array<exact::Point3, 3>;

// Cuts the region into triangles (constrained Delaunay triangulation of the rings), the largest first; ties by coordinates, so
// the order depends on the region alone. The triangles turn as the outer ring does. O(n log n) expected.
std::vector<ExactTriangle> triangulate_region(const Rings& rings);

// `count` different points of the region's interior: centroids of its triangles first, then off-centre points.
std::vector<exact::Point3> interior_points(const Rings& rings, std::size_t count);

}  // namespace clues::validate
