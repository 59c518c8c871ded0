#include "reference/visibility/map/omega.h"

#include <algorithm>

namespace clues::reference {

using exact::Point3;

SpaceLabels::SpaceLabels(const Omega& omega, const CGAL::Bbox_3& bounds)
    : omega_(&omega), walker_(omega.scene()), wedges_(omega.scene(), bounds + omega.scene().bounds()) {
  wedges_.add(omega.fixpoint().wedges.pieces());
}

Walker::Label SpaceLabels::operator()(const Point3& p) const { return (*this)(p, {p}); }

Walker::Label SpaceLabels::operator()(const Point3& p, const std::vector<Point3>& corners) const {
  constexpr std::uint64_t kSpaceSeed = 0x2f;
  const auto holds = [&](const ValidPiece& piece) {
    return !piece.holds_cell && piece.wedge.plane.oriented_side(p) == CGAL::ON_ORIENTED_BOUNDARY &&
           covers(piece, p) != Meets::no;
  };
  if (std::any_of(wedges_.pieces().begin(), wedges_.pieces().end(), holds)) return {true, false};
  const Walker::Label label =
      walker_.label({p, std::nullopt, nullptr}, wedges_, omega_->fixpoint().left_out, kSpaceSeed);
  if (label.visible) return label;
  const bool limited = omega_->fixpoint().left_out.may_reach(corners);
  return {limited, limited};
}

}  // namespace clues::reference
