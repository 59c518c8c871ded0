// D17, D17a: all valid wedge pieces of a scene and cell.
//
// Only valid sources make wedges, and valid wedges make CSVs, which make wedges. Within a round the contour edges are cut at a fixed set
// of points and the work runs until nothing new appears; every label only ever turns from hidden to visible. At its end the
// CSVs met become cuts, and the next round starts over with them: a piece of an edge then has one label (D13a). When a round
// makes no new cut, every label was taken with all event surfaces in place. Wedge geometry and walks are kept between rounds.
//
// Where a walk does not end its source counts as visible, and what its wedges light with it. A walk from elsewhere may still call the same space hidden: where only
// doubt says that both sides of a wedge are visible, the wedge has to stay. So each round lights what is visible first, with all that follows from it, and then what counts as
// visible, from which nothing follows that a wedge may be left out for (Probe::doubtful). By induction the first part lights nothing outside of Omega. So a wedge is
// left out only where both of its sides are in Omega, every border of Omega has its pieces, and no walk that ends calls a point of Omega hidden.
//
// Nor does the last leg of a walk light a source that ends in a groove or a corner: it is no part of a sight line, and light that it comes into it may leave again (walk.h). The walk is made anew, with more legs
// before it may end like that. They come ever nearer to where it is dark, so the light begins on one of them; if none says so the source is in doubt.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/search/options.h"
#include "reference/visibility/wedges/anticone.h"
#include "reference/visibility/wedges/wedge_set.h"

namespace clues::reference {

struct Fixpoint {
  WedgeSet wedges;
  LeftOut left_out;  // by the limits of D17
  // Something counts as visible: of what that lights, and of nothing else, walks may say different things. So in this map they are not held against each other.
  bool in_doubt = false;
  // Edges and points of the complex at which a visible source lies or a valid wedge piece arrives.
  std::vector<std::uint32_t> lit_edges, lit_points;
  // Where something is in doubt or left out: finds the pieces that light Omega whatever is true of that (D17b); once. Empty: all of them do.
  std::function<WedgeSet()> find_known;
};

// The answer's find_known() refers to `scene`.
Fixpoint find_wedges(const exact::SceneQuery& scene, const Options& options, Statistics& statistics);

}  // namespace clues::reference
