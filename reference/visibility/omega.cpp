#include "reference/visibility/omega.h"

#include <algorithm>

#include "reference/visibility/anticone.h"

namespace clues::reference {

using exact::Point3;

SpaceLabels::SpaceLabels(const Omega& omega, const CGAL::Bbox_3& bounds)
    : omega_(&omega), walker_(omega.scene(), true), wedges_(omega.scene(), bounds + omega.scene().bounds()) {
  wedges_.add(omega.fixpoint().wedges.pieces());
}

Walker::Label SpaceLabels::operator()(const Point3& p) const {
  constexpr std::uint64_t kSpaceSeed = 0x2f;
  const auto holds = [&](const ValidPiece& piece) {
    return piece.wedge.plane.oriented_side(p) == CGAL::ON_ORIENTED_BOUNDARY && covers(piece, p) != Meets::no;
  };
  if (std::any_of(wedges_.pieces().begin(), wedges_.pieces().end(), holds)) return {true, false};
  const Walker::Label label = walker_.label({p, std::nullopt, nullptr}, wedges_, kSpaceSeed);
  if (label.visible) return label;
  // D17: what the wedges left out by the generation limit could show lies in the anti-cones of their apexes.
  const std::vector<Point3>& left_out = omega_->fixpoint().beyond_limit;
  const bool beyond = std::any_of(left_out.begin(), left_out.end(), [&](const Point3& x) {
    const std::vector<AnticoneFacet> facets = anticone_facets(x, omega_->map().cell);
    return std::none_of(facets.begin(), facets.end(),
                        [&](const AnticoneFacet& f) { return f.plane.oriented_side(p) == CGAL::ON_NEGATIVE_SIDE; });
  });
  return {beyond, beyond};
}

}  // namespace clues::reference
