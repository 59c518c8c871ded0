// The shaft tests of the traversal, for all unvisited surfaces at once: which of them may have a point in Omega of the scene of the visited ones?
//
// Space falls into parts of one label, between visited surfaces and valid wedge pieces. So a box that neither meets has one label, and one walk (D14) tells
// it; where it is dark, all that lies in the box is, however much. Otherwise the halves of the box are asked. At the end stands a single surface;
// its inside meets no other surface (D16), so it is dark when no wedge piece meets it and one of its points is dark.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/labels/walk.h"
#include "reference/visibility/search/fixpoint.h"

namespace clues::reference {

class Darkness {
 public:
  explicit Darkness(const exact::Complex& complex);  // a tree over all occluders, O(n log n)

  // The unvisited pieces that are not dark, ascending. `part` is the scene of the visited ones, with all its wedges in `fixpoint`. Adds to
  // the count of shaft tests.
  std::vector<std::uint32_t> not_dark(const exact::SceneQuery& part, const Walker& walker, const Fixpoint& fixpoint,
                                      const std::vector<bool>& visited, std::uint64_t& shaft_tests) const;

 private:
  struct Node {
    CGAL::Bbox_3 box;
    std::uint32_t begin = 0, end = 0, right = 0;  // right == 0: a leaf; the left child follows its parent
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<CGAL::Bbox_3> boxes_;  // per piece
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;

  friend class DarknessQuery;
};

}  // namespace clues::reference
