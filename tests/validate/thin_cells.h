// A second, plain way to what the checkers of certificates (D18) decide for cells without an interior: a
// point, a segment, a convex polygon. Everything is solved on the cell itself, in rationals: the shadow of a
// triangle from p is an interval of the segment, or a few half planes of the polygon's plane, and what the
// shadows leave is computed. No sight line is tried, and nothing of exact/ or validate/ is used but vectors.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "validate/windows/rational.h"

namespace clues::validate::thin {

using Triangle = std::array<RVector, 3>;  // with area

struct Cell {
  std::vector<RVector> corners;  // one, two different ones, or those of a strictly convex polygon in order
  int dimension() const { return corners.size() < 3 ? static_cast<int>(corners.size()) - 1 : 2; }
};

RVector normal_of(const Triangle& t);

// The points from + s d, s in [low, high], that the triangle holds.
struct Part {
  Rational low, high;
};
std::optional<Part> part_of_line(const Triangle& t, const RVector& from, const RVector& d);

bool holds(const Triangle& t, const RVector& x);
bool blocks(const Triangle& t, const RVector& v, const RVector& p);  // D5: the open segment

bool contains(const Cell& cell, const RVector& x);           // the closed V
bool interior_contains(const Cell& cell, const RVector& x);  // int V
bool meets(const Cell& cell, const Triangle& t);             // D3: the closed V

// On a segment a b: the closure of the v = a + s (b - a) from which the triangle stops the line to p. An end
// that is missing is infinite.
struct Interval {
  std::optional<Rational> low, high;
};
std::optional<Interval> shadow_on_segment(const Cell& segment, const Triangle& t, const RVector& p);

// Where the triangle's section with the plane of p and the segment has its corners: x = p + r (a - p) + u (b
// - a).
struct Place {
  Rational r, u;
};
std::vector<Place> section(const Cell& segment, const Triangle& t, const RVector& p);

// On a polygon: the same, as convex sets, each given by closed half planes normal . (v - at) >= 0.
struct Half {
  RVector normal, at;
};
std::vector<std::vector<Half>> shadows_on_polygon(const Cell& polygon, const Triangle& t, const RVector& p);

// Whether v lies in the shadow of one of the triangles.
bool is_shaded(const Cell& cell, const std::vector<Triangle>& soup, const RVector& p, const RVector& v);

// D18: whether the shadows cover all v of int V with side . (v - p) > 0. p outside V.
bool is_occluded(const Cell& cell, const std::vector<Triangle>& soup, const RVector& p,
                 const std::optional<RVector>& side);

}  // namespace clues::validate::thin
