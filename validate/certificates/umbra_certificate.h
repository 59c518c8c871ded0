// T2, D18: is a list of oriented triangles the boundary of a region that nothing of the cell can see? A few lines of plain rationals that share nothing
// with the code that made the list.
//
// Let w(p) be the winding number of the facets around p. Checked is that
//   (a) each surface facet lies in the scene triangle that it names;
//   (b) each other facet has the cell on the closed inner side of its plane (the side its corners turn clockwise to);
//   (c) along every line, as many facets begin at each point as end there: the facets have no border, so w is a whole number and changes at facets only;
//   (d) no facet meets int V, and w is 0 there.
// Then no point p with w(p) > 0 is in E. Were it, an open part of int V would see p (D6), and in it some v
// that no triangle spoils (plain_sight.h). Let x be a point of (v,p) so near p that w(x) = w(p). It is not in
// S, and S is closed: so (v,x') is free for all x' of space near x. Choose x' such that the line from v to it
// passes no edge of a facet and lies in no facet's plane; as v is on no facet (d), finitely many planes
// through v are to be avoided. The line starts at w = 0 (d). It passes no facet of kind (a), which is a part
// of S: it lies in a triangle, and outside int V (d). Where it passes one of kind (b), it goes outward: it
// comes from the cell, on the closed inner side, and is not in the plane. There w falls by one. So w(p) =
// w(x') <= 0.
//
// This holds for cells of every dimension. Nothing is moved but x; a flat cell or a segment may lie in the
// plane of a facet of kind (b), which a line from v then leaves at v, on which there is no facet. For such
// cells all of the triangles is S (D3), and (d) asks more than is needed. The facets need not be free of
// intersections, nor have common vertices. The sides of an enclosing box are of kind (b) as soon as the box
// holds the cell, and need no rule of their own.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "scene/mesh/flagged_mesh.h"
#include "validate/windows/rational.h"

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

// D22: the same where some triangles do not block. A surface facet lies in one that does: the proof needs no more.
CertificateVerdict check_umbra_certificate(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell,
                                           const UmbraCertificate& facets);

// w(p) for facets without border; none when p lies on a facet. O(n).
std::optional<int> winding_number(const UmbraCertificate& facets, const RVector& p);

// Whether a certificate that is valid proves this side of a triangle hidden: no facet touches the open
// triangle from that side, and w > 0 beside it. Then w > 0 holds for all points just before the triangle, and
// a sight line to a point of it would have free sight lines to some of these. A side that no point of the
// cell is strictly in front of is hidden without proof. False for a triangle without area, and for one that
// has a point in the closed cell: that is visible (D3), whatever its sides. Whether the triangle itself blocks
// does not matter (D22): sight lines end on it. O(n).
bool proves_hidden(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const UmbraCertificate& facets,
                   std::uint32_t triangle, bool front);

}  // namespace clues::validate
