// What wedges start from (D13, D13a): pieces of contour edges between neighbouring cuts, and mesh vertices seen from the cell. Each has one
// label, found by one walk (D14); only the visible ones make wedges (D17a).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/labels/walk.h"
#include "reference/visibility/wedges/apex.h"
#include "reference/visibility/wedges/contour.h"

namespace clues::reference {

inline constexpr std::uint64_t kSourceSeed = 0x51;  // of the first walk of a source

inline bool before(const exact::Point3& a, const exact::Point3& b) { return CGAL::lexicographically_xyz_smaller(a, b); }

// A piece of a contour edge between two neighbouring cuts, seen from one supporting plane: one source, one label (D13a).
struct Source {
  std::size_t contour = 0;
  exact::Point3 lo, hi, y;  // along the edge; y is a short point between them
  std::uint64_t seed = kSourceSeed;
  Walk walk;
  bool lit = false;
  std::size_t least = 0;  // legs of its walk before one out of the dark
  bool keeps_out = true;  // of the anti-cones of all that was left out: so it has one label, as a whole
};

// A mesh vertex seen from v in int V: a source of SE-MV wedges even where no contour edge ends (a corner whose edges all point away
// from the cell).
struct VertexSource {
  std::uint32_t point = 0;
  exact::Point3 x;
  exact::Vector3 towards;  // from x into int V
  exact::Point3 v;         // there, or beside it in the same part
  Probe probe;
  Walk walk;
  bool lit = false;
  bool separates = false;  // its wedges do nothing else (T10): in doubt it is lit, and nothing is lost by it
  std::size_t least = 0;   // legs of its walk before one out of the dark
};

inline Start start_of(const Source& s, const std::vector<ContourEdge>& contours) {
  return {s.y, std::nullopt, &contours[s.contour]};
}
inline Start start_of(const VertexSource& s) { return {s.x, std::nullopt, nullptr, s.v}; }

// The sources of all contour edges cut at `cuts` (per edge of the complex, in lexicographic order), unlit. A walk of `known` is kept where the piece
// of the edge is still the same; the others are walked. Adds their number to `walks`.
std::vector<Source> edge_sources(const exact::SceneQuery& scene, const Walker& walker,
                                 const std::vector<ContourEdge>& contours,
                                 const std::vector<std::vector<exact::Point3>>& cuts, std::vector<Source> known,
                                 std::uint64_t& walks);

// The same piece of an edge, asked at another point: the first may be in special position with all that is seen from it.
void ask_elsewhere(Source& s, int attempt);

inline constexpr int kViews = 12;  // of a vertex in one direction

// Looks from another v, beside the direction in which x is seen and in the same part of V: the better, the lower the attempt is; 0 is the direction itself. False if that sight line
// is in special position: then all is as it was.
bool look_again(const exact::SceneQuery& scene, const Apex& apex, VertexSource& s, int attempt);

// Every mesh vertex, once for each sight line from near a cell vertex that arrives in a local face where a sector starts,
// and once for every other part of V that is seen from such a face (Apex::into_cell). A vertex in a plane with all of V and with a piece at it is lit. `corner` gives the apex of a point. Walked; adds their number to `walks`.
std::vector<VertexSource> vertex_sources(const exact::SceneQuery& scene, const Walker& walker,
                                         const std::function<const Apex&(std::uint32_t)>& corner, std::uint64_t& walks);

}  // namespace clues::reference
