// FIG. 13: what overlaps what in the direction of the cell, as a directed graph, and its strong components (Tarjan). An arc from A to B says: B reaches
// into the shaft between A and the cell, so B ought to be visited first. Arcs can run in circles, and no cutting undoes every circle:
// two faces of a groove narrower than the cell lie wholly in each other's shafts (hazard B-13).
//
// So circles are broken where that can be done, by trimming: each member is cut by the shafts of those that it overlaps (13.5), and the parts are put in order
// anew. All planes that cut belong to shafts of whole surfaces, and each shaft cuts a surface once: trimming ends. A circle of parts that is left is one cluster:
// its members are visited in one step, and their regions are decided when all wedges of all of them exist.
//
// The condensed graph has no circles, so it has a member that nothing else overlaps: every step visits something, and there are finitely many surfaces.
// The traversal's result does not depend on the order of visits (traversal.h, T5); the order only keeps it from visiting what turns out to be hidden.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exact/sight/scene_query.h"

namespace clues::reference {

struct OverlapGraph {
  std::vector<std::vector<std::uint32_t>>
      members;  // per node: pieces of the complex, ascending; of a part: the piece it is a part of
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

// Trimming (13.5): the members of one component, cut by each other's shafts, in order. Nodes are parts; those of one member of `graph` do not
// overlap each other. Empty where that makes more than kMostParts parts.
inline constexpr std::size_t kMostParts = 256;
std::optional<OverlapGraph> trimmed(const exact::SceneQuery& scene, const OverlapGraph& graph, std::uint32_t component);

// What to visit next: the pieces in front, those of a cycle by their trimmed parts.
struct Front {
  std::vector<std::uint32_t> pieces;  // ascending; not empty, unless the graph is
  std::uint64_t cycles = 0;           // among them
  std::uint64_t clusters = 0;         // those of the cycles that trimming does not break
};
Front pieces_in_front(const exact::SceneQuery& scene, const OverlapGraph& graph);

// For GraphViz: a box for each occluder, cycles framed and red, with what trimming does to them. Names input triangles.
std::string to_graphviz(const OverlapGraph& graph, const exact::SceneQuery& scene);

}  // namespace clues::reference
