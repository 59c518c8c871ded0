// D17: the outline of a piece that runs over an edge in its plane changes the label along that edge. Outlines are parts of rays: what a ray meets before the near edge,
// or beyond what ends the piece there, the piece does not touch.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "fastpath/visibility/wedges/piece_set.h"
#include "fastpath/visibility/wedges/workers.h"

namespace clues::fastpath {

class CoplanarCuts {
 public:
  // Keeps references; `is_contour`: by edge, the others are not cut.
  CoplanarCuts(const LocalScene& scene, const std::vector<bool>& is_contour, Workers& workers)
      : scene_(scene), is_contour_(is_contour), workers_(workers) {}

  // Edges and points inside them, some more than once; the pools of the workers keep the points, and the same outline and edge have the same one in every round.
  // The same for any number of threads. Needs RoundedUp in scope. O(coplanar edges of all pieces).
  std::vector<std::pair<std::uint32_t, const ExactPoint*>> of(const std::vector<ValidPiece>& pieces);

 private:
  const LocalScene& scene_;
  const std::vector<bool>& is_contour_;
  Workers& workers_;
  std::map<std::tuple<const OnWedge*, const ExactPoint*, std::uint32_t>, const ExactPoint*> known_;
};

}  // namespace clues::fastpath
