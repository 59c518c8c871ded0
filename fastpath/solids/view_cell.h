// T15: the cell, the parts of its facets through which sight lines may leave it, and the solids that the viewer may be in.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/solids/solids.h"

namespace clues::fastpath::solids {

// A facet of the cell, and where of it sight lines may leave the cell.
struct Window {
  std::vector<Point> facet;
  Side side;
  std::vector<Piece> open;  // parts of the facet
};

struct Opening {
  std::uint32_t window = 0, part = 0;
};

// The cell as the proofs need it. Where it is flat it is one window, without a side.
class ViewCell {
 public:
  // The solids must outlive it.
  ViewCell(const std::vector<Point>& points, const Solids& solids);
  ViewCell(const ViewCell&) = delete;
  ViewCell& operator=(const ViewCell&) = delete;

  const std::vector<Window>& windows() const { return windows_; }
  std::vector<Opening> openings() const;

  // Whether T15 may be used: it has no point in common with the target, and the target is out of all solids that the viewer may be in.
  bool may_be_hidden(const std::vector<Point>& target) const;
  // Whether lines to the target may go through the window, if they are apart.
  bool may_be_left_through(const Window& window, const std::vector<Point>& target) const;
  // Whether it is on the inside of one of these planes.
  bool is_behind(const std::vector<Side>& backs) const;

 private:
  bool is_apart_from(const std::vector<Point>& target) const;
  bool is_out_of_solids_around(const std::vector<Point>& target) const;
  bool is_outside(const Solid& solid) const;

  std::vector<Point> corners_;
  Bounds bounds_;
  bool solid_ = false;
  std::vector<Window> windows_;
  std::vector<const Solid*> around_;
};

}  // namespace clues::fastpath::solids
