// Looks for chains (chain.h) where the first-order map says "visible" and no sight line was found. It goes back from the point by the rules of D14: through
// the valid wedge piece that was crossed to just beside its source, or to just before the last surface crossed. What it goes back to is a limit, so it
// takes points nearby, nearer and nearer, until the way between them is free. It believes nothing: a chain is only returned when check_chain accepts it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"
#include "validate/certificates/chain.h"

namespace clues::validate {

class ChainSearch {
 public:
  // Keeps references: mesh and map must outlive it.
  ChainSearch(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map);
  ~ChainSearch();

  // A confirmed chain to p, a point of the region, for one of the input triangles that the region belongs to. Deterministic; a bounded number of
  // steps, then none.
  std::optional<Chain> find(std::uint32_t triangle, bool front, const reference::Region& region,
                            const exact::Point3& p) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// A confirmed chain for each of these input triangles (ascending) for which one is found at a few points of its visible regions.
std::vector<Chain> find_chains(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map,
                               const std::vector<std::uint32_t>& triangles);

}  // namespace clues::validate
