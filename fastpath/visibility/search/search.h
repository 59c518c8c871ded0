// D17, D17a: all valid wedge pieces of a scene and cell. Only visible sources make wedges, and valid pieces make CSVs, which make wedges. Within a
// round the contour edges are cut at a fixed set of points, and labels only turn from hidden to visible. At its end the CSVs met
// become cuts and the next round starts over; when no new cut appears every part of an edge has one label (D13a). Envelopes, walks and local
// pictures of contour vertices are kept from round to round.
//
// Where a walk does not end its source counts as visible, as do the sectors of a contour vertex that is too intricate, and what its wedges light with it. A walk from elsewhere may still call the same space hidden: where only
// doubt says that both sides of a wedge are visible, the wedge has to stay. So each round lights what is visible first, with all that follows from it, and then what counts as
// visible, from which nothing follows that a wedge may be left out for (Probe::doubtful). By induction the first part lights nothing outside of Omega. So a wedge is
// left out only where both of its sides are in Omega, every border of Omega has its pieces, and no walk that ends calls a point of Omega hidden.
#pragma once

#include <memory>
#include <vector>

#include "fastpath/visibility/labels/left_out.h"
#include "fastpath/visibility/labels/walker.h"
#include "fastpath/visibility/search/options.h"
#include "fastpath/visibility/wedges/piece_set.h"
#include "fastpath/visibility/wedges/workers.h"

namespace clues::fastpath {

class Search {
 public:
  // `bounds`: of all that will be asked about. Keeps references.
  Search(const LocalScene& scene, const IntervalBox& bounds, const LocalMapOptions& options, LocalMapCounts& counts,
         Workers& workers);
  ~Search();
  // On all threads of the arena; the result is the same for any number. Afterwards pieces() is complete, but for what left_out() says.
  void run();
  // After run(), once: from here on pieces() are only those of light that is there whatever is in doubt or left out (D17b).
  void keep_known();

  const PieceSet& pieces() const;
  const Walker& walker() const;
  // Where a limit of D17 left out wedges; what that means for labels is in one_label.h.
  const LeftOut& left_out() const;

 private:
  class Work;
  const LocalScene& scene_;
  const IntervalBox& bounds_;
  const LocalMapOptions& options_;
  LocalMapCounts& counts_;
  Workers& workers_;
  std::unique_ptr<Work> work_;
};

}  // namespace clues::fastpath
