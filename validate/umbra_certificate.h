// T2, D18: is a list of oriented triangles the boundary of a region that nothing of the cell can see? A few lines of plain rationals that share nothing
// with the code that made the list.
//
// Let w(p) be the winding number of the facets around p. Checked is that
//   (a) each surface facet lies in the scene triangle that it names;
//   (b) each other facet has the cell on the closed inner side of its plane (the side its corners turn clockwise to);
//   (c) along every line, as many facets begin at each point as end there: the facets have no border, so w is a whole number and changes at facets only;
//   (d) no facet meets int V, and w is 0 there.
// A free sight line starts at w = 0. It passes no facet of kind (a); where it passes one of kind (b), it goes outward, for it comes from the
// cell and meets the plane once: w falls by one. So it never gets to a point with w > 0. The facets need not be free of
// intersections, nor have common vertices. The sides of an enclosing box are of kind (b) as soon as the box holds the cell, and need no rule of
// their own. (A sight line through an edge, or within a plane, has others beside it that end beside the same point.)
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact/convex_cell.h"
#include "scene/mesh.h"
#include "validate/rational.h"

namespace clues::validate {

struct CertificateFacet {
  std::optional<std::uint32_t>
      triangle;                    // the scene triangle that it lies in; none: a wedge, or a side of the enclosing box
  std::array<RVector, 3> corners;  // counter-clockwise from outside
};
using UmbraCertificate = std::vector<CertificateFacet>;

struct CertificateVerdict {
  bool valid = false;
  std::string reason;  // when not valid: which condition fails, and where
};

// O(n log n) for n facets.
CertificateVerdict check_umbra_certificate(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                           const UmbraCertificate& facets);

// w(p) for facets without border; none when p lies on a facet. O(n).
std::optional<int> winding_number(const UmbraCertificate& facets, const RVector& p);

// Whether a certificate that is valid proves this side of a triangle hidden: no facet touches the open triangle from that side, and w > 0 beside it. A
// side that no point of the cell is strictly in front of is hidden without proof. False for a triangle without area. O(n).
bool proves_hidden(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const UmbraCertificate& facets,
                   std::uint32_t triangle, bool front);

}  // namespace clues::validate
