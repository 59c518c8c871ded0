// Where a viewer stands who looks for light next to a point: beside the nearest point of V. A walk (D14) that runs towards a place where surfaces meet upon V, or beside it, looks the same from leg to leg,
// only smaller; sight lines from all of V then miss ever more surely what little of V sees the place. A proposal, in doubles: the caller decides exactly what is seen.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::exact {

// So many times (or none) positive weights of the vertices of V, for points of int V about as far from the one nearest to x as x is, from an eighth to twice that, in directions that go by `seed`. None where
// x is no farther from V than doubles tell, or farther than V is large, and of a point. O(n^3) for n vertices.
std::vector<std::vector<double>> weights_beside_nearest(const std::vector<scene::Point>& vertices,
                                                        const scene::Point& x, std::uint64_t seed, std::size_t count);

}  // namespace clues::exact
