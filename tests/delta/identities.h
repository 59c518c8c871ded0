// What must hold between any two cells (D24): of a scene, by the judge that knows nothing but files.
#pragma once

#include <cstdint>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/search/options.h"
#include "scene/mesh/mesh.h"
#include "validate/stream/delta_file.h"

namespace clues::test {

struct TransitionSums {
  std::uint64_t transitions = 0, sides = 0, exposed = 0, occluded = 0, packets = 0;
};

// The maps, both transitions between them, made independently, and what must hold of them: failures of the test. Returns
// the transition from a to b.
validate::DeltaRecord expect_identities(const scene::TriangleMesh& mesh, const exact::ConvexCell& a,
                                        const exact::ConvexCell& b, const reference::Options& options,
                                        TransitionSums& sums);

// Of the two halves of the cell; of every fourth, the first half with the whole cell too.
void expect_identities_of_halves(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                 const reference::Options& options, TransitionSums& sums);

// Prints the sums; a test of nothing fails.
void expect_seen_something(const TransitionSums& sums);

}  // namespace clues::test
