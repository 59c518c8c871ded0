// A wedge piece: the part of an event surface (D10-D12) that is valid in the sense of D13, as one radial strip.
//
// All three kinds are planar and radial: seen from a centre c in the wedge's plane they fill an angular interval, from
// a near bound to the first blocker. For SV-ME and SE-ME (D10, D11) c is the touching cell vertex (SVV) and the near bound is
// the mesh edge; for SE-MV (D12) c is the contour vertex itself and the near bound is c.
//
//            ray0 ____ far0
//           near0/    |
//    c . . . . . /    |  far bound: the first blocker (or none: unbounded)
//           near1\____|
//            ray1     far1
#pragma once

#include <cstdint>

#include "exact/kernel.h"

namespace clues::reference {

enum class WedgeKind : std::uint8_t { sv_me, se_me, se_mv };

struct Wedge {
  WedgeKind kind = WedgeKind::sv_me;
  int generation = 0;          // 0: from a mesh edge or vertex; n+1: from a CSV of a wedge of generation n
  exact::Plane3 plane;         // V lies in its closed negative side H+; its positive side is H-, the visible side
  exact::Point3 center;        // c
  exact::Point3 near0, near1;  // SE-MV: both equal c
  exact::Point3 on_ray0,
      on_ray1;  // points of the two rays; c, on_ray0, on_ray1 turn counter-clockwise about plane's normal
  bool unbounded = false;
  exact::Point3 far0, far1;   // when bounded: on ray0 and ray1
  std::uint32_t blocker = 0;  // when bounded: the piece that ends it
};

}  // namespace clues::reference
