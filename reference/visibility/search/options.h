// What the search for first-order visibility is told (D4, D17), and what it counts.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "exact/dials.h"
#include "reference/visibility/wedges/wedge.h"

namespace clues::reference {

enum class Mode { sheet, solid };  // D4

// Two ways to one map. plain looks at the whole scene at once; traversal (traversal/traversal.h) goes outward from what is visible and
// never looks at what is hidden behind what it has met, beyond asking whether it is dark.
enum class Formulation { plain, traversal };

// Told from time to time; stages "refine", "wedges", "regions". Called from one thread at a time.
using Progress = std::function<void(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

struct Options {
  Mode mode = Mode::sheet;
  Formulation formulation = Formulation::plain;
  int threads = 0;  // 0: as many as the machine has; the result does not depend on it
  bool check_two_walks =
      true;  // D14: walk twice, from two independent v, and count disagreements (a debug build stops at one)
  Progress progress;
  exact::Dials dials;  // the limits of D17, and what else only tests turn
};

struct Statistics {
  std::uint64_t sv_me = 0, se_me = 0, se_mv = 0;  // wedges with a valid piece
  std::uint64_t csv = 0;                          // compound silhouette vertices made
  std::uint64_t inside_corners = 0;               // SE-MV wedges at mesh vertices
  int generations = 0;                            // highest generation of a wedge
  std::uint64_t parallel_edges = 0;  // contour edges whose supporting plane touches V along an edge or facet
  std::uint64_t refined_triangles = 0;
  std::uint64_t regions_visible = 0, regions_hidden = 0;
  std::uint64_t walks = 0;
  std::uint64_t walk_disagreements = 0;  // D14; must stay 0 (not counted where something counts as visible: fixpoint.h)
  std::uint64_t rounds = 0;
  std::uint64_t conservative_fallbacks = 0;  // D17
  std::uint64_t wedges_built = 0;            // wedges whose valid part was looked for
  // Of the traversal alone:
  std::uint64_t surfaces_visited = 0;  // pieces that blocked anything, of all passes
  std::uint64_t surfaces_seen = 0;     // those of them that a sight line reached
  std::uint64_t sight_lines = 0;
  std::uint64_t shaft_tests = 0;  // boxes and surfaces asked for whether they are dark
  std::uint64_t passes = 0;
  std::uint64_t by_order = 0;  // passes in which no sight line helped, and the overlap order decided
  std::uint64_t cycles = 0;    // overlap cycles met by it
  std::uint64_t clusters = 0;  // those that trimming did not break
};

}  // namespace clues::reference
