// What the judges of motion ask of a mesh: which triangle is across which edge, which constraints there are, and whether one of them holds at a
// viewpoint. Exact; of its own, so that the reference and the judge can be wrong independently.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "exact/motion/constraints.h"
#include "scene/motion/constraint.h"

namespace clues::validate {

struct MeshPlaces {
  explicit MeshPlaces(const scene::DepthMesh& mesh);

  static constexpr std::uint32_t none = 0xffffffff;
  // Across the edge from corner k to the next: the vertex of the one other triangle there, or none.
  std::vector<std::array<std::uint32_t, 3>> across;
  // Directed edges without exactly one partner in the other direction. 0: the mesh is closed and oriented.
  std::uint64_t unpaired = 0;
  // The first edge that more than two triangles have, or two in the same direction, in words: nothing says which of them is across. Empty: none.
  std::string tangled;
};

// Throws Error bad_argument where the Delaunay property is asked for and it is not said across what: there `across` has none, as where the mesh
// ends, and the property would be taken for one that need not hold.
void require_one_across(const MeshPlaces& places, const scene::MotionThresholds& thresholds);

// The samples that a constraint is about, in the order in which the predicates take them: facing a, b, c; edge_length a, b; separation p and
// the edge a, b; delaunay a, b, c and d across.
struct PlaceSamples {
  std::array<std::uint32_t, 4> sample{};
  std::size_t count = 0;
};
PlaceSamples samples_at(const scene::DepthMesh& mesh, const MeshPlaces& places, const scene::ConstraintPlace& place);

// All constraints of one triangle, facing first; of a mesh that require_one_across lets through.
std::vector<scene::ConstraintPlace> constraints_of(const MeshPlaces& places, const scene::MotionThresholds& thresholds,
                                                   std::uint32_t triangle);

bool holds_at(scene::MotionConstraint constraint, const std::array<const exact::SightRow*, 4>& rows,
              const exact::ExactThresholds& thresholds);
bool holds_at(scene::MotionConstraint constraint, const std::array<const scene::DepthSample*, 4>& samples,
              const exact::ExactViewpoint& v, const exact::ExactThresholds& thresholds);

}  // namespace clues::validate
