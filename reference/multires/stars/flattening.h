// A star laid out in a disk (D32): z^a where it works, something plainer where rounding it fails. Each proposal is certified by signs:
// every sector turns counter-clockwise about the vertex, and together they go round once (an open star, or each side of
// a feature: half round). Then star and polygon are homeomorphic, linear on each triangle, whatever the radii are.
#pragma once

#include <vector>

#include "exact/multires/star_rules.h"
#include "reference/multires/stars/star_complex.h"

namespace clues::reference {

struct FlatStar {
  std::vector<exact::DiskPoint> ring;
};

// What the star looks like: its ring, and for a feature where the second tagged edge leaves (ring.vertices[0] is the first).
struct StarShape {
  scene::StarKind kind = scene::StarKind::interior;
  Ring ring;
  std::uint32_t across = 0;  // feature: the place in the ring
};

// Whether the flattened star is embedded, by exact signs.
bool is_certified(const StarShape& shape, const FlatStar& flat);

// In the order in which they are to be tried, only certified ones: z^a; its angles with equal radii; equal angles and radii. None where a side is a single
// triangle, which z^a makes flat. `points` as from exact::points_for_estimates().
std::vector<FlatStar> flattenings(const StarShape& shape, std::uint32_t vertex,
                                  const std::vector<scene::Point>& points);

}  // namespace clues::reference
