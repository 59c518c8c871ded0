// What is still open after a map of K, where little comes into K, and what has to be mapped to tell.
//
// Theorem (locality). Let P be a part of K that holds every triangle of K with a point in the hull of V and a triangle t. Then Omega(P) and Omega(K) have the same points on t.
// Proof. Let x on t be in Omega(K), outside of V. Along a chain of D9 it came from a point y of Omega(K) with x in C(y,v), so y is on the segment from v to x, and so in the hull of V and t, as
// the segment is; and so on down the chain. No triangle of P meets these segments, as none of K does: x is in Omega(P). Of a chain in P all segments are in the hull, too, where K has nothing
// but what P has: x is in Omega(K).
//
// Let the map of a part be made, of which all is dark that is neither in the part nor came into it since: K is what light met there, and what came. Of K that is known to be visible which a free sight line
// reaches, in the map or not. All else is open: what came, and what the map lists though it lacked what came, and what is dark beside it. The map of what meets the hulls of V and of the open ones says of each of these what the map of K would.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "fastpath/predicates/cell.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/closure/closure.h"

namespace clues::fastpath {

struct OpenPart {
  std::vector<std::uint32_t> visible;  // reached by a free sight line; ascending
  std::vector<std::uint32_t> open;     // ascending
  ScenePart part;                      // of K and of what is dark beside it; all open ones are in it
};

// Of a scene: for each triangle whether it is in K, and whether it is dark and beside K.
struct Marked {
  std::span<const std::uint8_t> in_part, is_dark;
};

// Rays that met a triangle first, from a point of int V.
using FirstRays = std::unordered_map<std::uint32_t, Segment>;

// `asked`: of K, ascending. `tries`: sight lines to each that its ray does not reach. None if more than `most` triangles of K would have to be mapped. O(asked * (tries + what meets a hull)).
std::optional<OpenPart> open_part(const Bvh& bvh, const Cell& cell, const Marked& marked,
                                  const std::vector<std::uint32_t>& asked, const FirstRays& rays, int tries,
                                  std::size_t most);

// What is marked, as a part.
ScenePart marked_part(const Bvh& bvh, const Marked& marked);

}  // namespace clues::fastpath
