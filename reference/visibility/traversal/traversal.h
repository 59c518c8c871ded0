// The front-to-back traversal (FIGS. 14-16, 19, 20A) on exact numbers: the same map as the plain formulation, found outward from what is visible.
//
// A pass takes the surfaces visited so far for the whole scene and finds all wedges of that scene (fixpoint.h): contour edges that are not seen make
// none, and each wedge is followed over visited surfaces only (the on-wedge traversal). Then the rest of the scene is asked whether it is dark there
// (darkness.h). What may be lit is looked at: along sight lines, which show it, or what stands nearer (the jump of step 20.3), and from there over the
// surfaces that hang together (spread.h, the flood of step 20.1). What no sight line reaches waits (suspended) until all that overlaps it in the
// direction of the cell has been visited and it is still not dark (overlap.h). The next pass begins (re-initiation), until the rest is all dark.
//
// Why the result is right (T). Let S be all surfaces and K the visited ones. The fewer surfaces, the larger Omega: Omega(S) lies in Omega(K). At the
// end no surface outside K has a point in Omega(K), hence none in Omega(S). A chain of D9 in S stops only at points of Omega(S), so at surfaces of K:
// it is a chain in K, and the other way round. So Omega(S) = Omega(K). Nothing here depends on the order of visits, on seeds or
// on what else K holds; those decide the amount of work alone (hazards B-11, B-14, B-15, B-28).
//
// Where wedges end without meeting a surface there is the sky: a wedge without a blocker is unbounded, and what stands free in lit space and meets no
// wedge is found because it is not dark. So no enclosing mesh is needed (B-15, B-19, B-31). A wedge starts beyond its edge or vertex (B-18).
//
// With every surface those that share a corner with it are visited too (but not those of these), and so is every surface at a visible edge or corner: they decide
// which wedges start there. They make the wedges of K those of S.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "exact/complex/complex.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/search/fixpoint.h"
#include "reference/visibility/search/options.h"

namespace clues::reference {

struct Traversal {
  std::unique_ptr<exact::Complex> part;      // K, numbered as the whole
  std::unique_ptr<exact::SceneQuery> scene;  // of it
  Fixpoint fixpoint;
  std::vector<bool> visited;  // per piece; pieces inside the cell count as visited
};

// `seeds`: pieces to look at first; empty: what is seen from the cell's centre in 26 directions. At most one pass for each piece; a few in practice.
Traversal traverse(const exact::SceneQuery& whole, const Options& options, Statistics& statistics,
                   const std::vector<std::uint32_t>& seeds = {});

// The complex with the occluders that are not in `occluders` taken away: same numbers, but edges and points know the others only.
exact::Complex part_of(const exact::Complex& complex, const std::vector<bool>& occluders);

}  // namespace clues::reference
