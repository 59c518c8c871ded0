// T15: what solids fill of a plane that a facet of the cell, or a triangle, lies in. For instance where a facet is open. Most facets of a level's leaves lie on walls; a sight line that meets one there is stopped at once, so that only what is left, doors for instance, is looked through.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fastpath/solids/exact_sections.h"
#include "fastpath/solids/solid.h"

namespace clues::fastpath::solids {

// The solids that lie on the far side of the plane, or reach there through it: what they fill of it, exactly. They have to outlive it.
class FilledPlane {
 public:
  FilledPlane(const FacetPlane& plane, std::span<const Solid> solids);

  // Convex polygons in the plane that have in their union all of the facet that is not filled; none narrower than `smallest` are told apart from what is between them. The facet's corners lie in the
  // plane. Lines that leave the cell through the rest meet a solid there: its interior lies just behind.
  std::vector<Piece> open_parts(const std::vector<Point>& facet, double smallest) const;

  // Whether all of a convex polygon in the plane is filled, but for a set without area. False if it has no area.
  bool fills(const std::vector<Point>& polygon) const;

 private:
  ExactPolygon in_plane(const std::vector<Point>& polygon) const;

  FacetPlane plane_;
  std::size_t u_, v_;
  std::vector<ExactPolygon> polygons_;
  std::vector<RimPart> rim_;
};

}  // namespace clues::fastpath::solids
