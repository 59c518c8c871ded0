// FIG. 13: what overlaps what in the direction of the cell, as a directed graph, and its strong components (Tarjan). An arc from A to B says: B reaches
// into the shaft between A and the cell, so B ought to be visited first. Arcs can run in circles, and no cutting undoes every circle:
// two faces of a groove narrower than the cell lie wholly in each other's shafts (hazard B-13).
//
// That does not matter here. The traversal's result does not depend on the order of visits (traversal.h), so a circle needs no breaking: its
// members are visited in one step, as a cluster, and their regions are decided when all wedges of all of them exist. The condensed graph has no circles,
// so it has a member that nothing else overlaps: every step visits something, and there are finitely many steps. The order
// only keeps the traversal from visiting what turns out to be hidden.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "exact/scene_query.h"

namespace clues::reference {

struct OverlapGraph {
  std::vector<std::vector<std::uint32_t>> members;  // per node: pieces of the complex, ascending
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      arcs;                                            // from the overlapped node to the overlapping one; ascending
  std::vector<std::uint32_t> component;                // per node: strong component, by first member
  std::vector<std::vector<std::uint32_t>> components;  // nodes of each, ascending

  std::vector<std::uint32_t> in_front() const;  // components that no other component overlaps
  std::vector<std::uint32_t> cyclic() const;    // components of more than one node
};

// One node for each of these pieces. O(n) shafts and, at worst, n^2 triangle tests.
OverlapGraph overlap_of_pieces(const exact::SceneQuery& scene, const std::vector<std::uint32_t>& pieces);

// One node for each occluder: surfaces connected by edges that are no contour edges for the cell.
OverlapGraph overlap_of_occluders(const exact::SceneQuery& scene);

// For GraphViz: a box for each occluder, cycles framed and red. Names input triangles.
std::string to_graphviz(const OverlapGraph& graph, const exact::Complex& complex);

}  // namespace clues::reference
