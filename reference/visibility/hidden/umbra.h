// FIG. 26: the polyhedral aggregate umbra, the part of space outside Omega (D9), as a closed polyhedral complex.
//
// Its boundary consists of umbra boundary polygons (UBPs: parts of wedges with hidden space on the H+ side and visible space on the other), of parts of surfaces with
// hidden space on one side, and of parts of a box that ends what is unbounded. Every plane that holds a wedge piece or a surface is cut by all that
// crosses it there; a part so made has one label on each side (D14), taken at a point beside it, so near that nothing lies between; on the H- side of a
// valid wedge piece it is known to be visible. So no arrangement in space is needed. Neighbours share edges, but not always vertices: a facet's corner may lie inside an edge of the next one.
//
// T2 says why the region holds nothing visible; validate/certificates/umbra_certificate.h checks that without the code here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/map/omega.h"

namespace clues::reference {

enum class UmbraFacetKind : std::uint8_t { surface, wedge, bound };

// A triangle of the boundary, counter-clockwise seen from outside: the umbra lies behind it.
struct UmbraFacet {
  UmbraFacetKind kind = UmbraFacetKind::wedge;
  std::uint32_t triangle = 0;  // surface: the first input triangle that covers it
  std::array<exact::Point3, 3> corners;
};

struct Box {
  exact::Point3 lo, hi;
};

struct Umbra {
  Box bounds;
  std::vector<UmbraFacet> facets;  // plane by plane
  std::uint64_t planes = 0;
  std::uint64_t parts = 0;      // of planes, with one label on each side
  std::uint64_t fallbacks = 0;  // labels that are visible only by a limit (D17): the boundary may be open there
};

// The part of the umbra within `bounds`, which must contain the cell (Error bad_argument); without bounds, a box with three times the extent of scene and cell.
// Bounds and umbra are in the coordinates of the scene, whatever the range of omega.
// The result does not depend on `threads` (0: as many as the machine has). For w wedge pieces and n triangles: O((w + n) log(w + n)) box tests, an arrangement in
// each of O(w + n) planes, and two walks for each part.
Umbra build_umbra(const Omega& omega, const std::optional<Box>& bounds, int threads);

}  // namespace clues::reference
