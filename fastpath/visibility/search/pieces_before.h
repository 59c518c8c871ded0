// What there was at the end of the round before. From round to round nearly all pieces stay, and a part of an edge that is cut makes parts of the piece that the whole edge made. What the pieces
// of one round did not meet, no part of them meets in the next: it is asked about the others alone.
#pragma once

#include <tuple>
#include <vector>

#include "fastpath/visibility/wedges/piece_set.h"

namespace clues::fastpath {

class PiecesBefore {
 public:
  // Those that are not a part of one piece that there was: closed sets of points in the same wedge. Needs RoundedUp in scope.
  std::vector<ValidPiece> others(const std::vector<ValidPiece>& pieces) const;
  // From here on it is these; whether all that there were are among them. O(n log n).
  bool replace(const std::vector<ValidPiece>& pieces);

 private:
  // What a piece is made of, which is kept from round to round: the wedge, what ends it, the near edge; and where it begins and ends there.
  using Strip = std::tuple<const OnWedge*, int, const ExactPoint*, const ExactPoint*>;
  using Name = std::tuple<Strip, const ExactPoint*, const ExactPoint*>;
  static Name name_of(const ValidPiece& p) { return {Strip(p.on, p.blocker, p.near0, p.near1), p.ray0, p.ray1}; }
  bool holds(const ValidPiece& p) const;

  std::vector<Name> names_;  // ascending
};

}  // namespace clues::fastpath
