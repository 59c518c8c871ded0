// A face with corners that are doubles, inside of a given one; see umbra_slice.h. What is chosen does not matter to
// whether the result is right: it is proved to lie in the face, or not given.
#include <CGAL/Interval_nt.h>

#include <algorithm>

#include "reference/visibility/hidden/umbra_slice.h"
#include "reference/visibility/planar/flat_set.h"

namespace clues::reference {

using exact::FT;
using exact::Point2;

namespace {

// A double not above x and one not below, as near as intervals have them; one number where x is a double.
std::pair<FT, FT> neighbours(const FT& x) {
  const auto [lo, hi] = CGAL::to_interval(exact::collapsed(x));
  return {FT(lo), FT(hi)};
}

// Corners at `at` that are doubles, from the nearest on: first the four around the point, then those around points a
// little further inside.
std::vector<Point2> candidates(const Point2& before, const Point2& at, const Point2& after) {
  std::vector<Point2> out;
  const auto around = [&out](const Point2& p) {
    const auto [x0, x1] = neighbours(p.x());
    const auto [y0, y1] = neighbours(p.y());
    for (const FT& x : {x0, x1}) {
      for (const FT& y : {y0, y1}) out.emplace_back(x, y);
    }
  };
  around(at);
  FT step = FT(1) / FT(std::uint64_t{1} << 40);
  for (int i = 0; i < 4; ++i, step *= FT(256)) around(at + step * ((before - at) + (after - at)));
  return out;
}

// One corner of the new ring, on the inner side of both sides at the old one.
std::optional<Point2> rounded_corner(const Point2& before, const Point2& at, const Point2& after) {
  for (const Point2& p : candidates(before, at, after)) {
    if (!CGAL::right_turn(before, at, p) && !CGAL::right_turn(at, after, p)) return p;
  }
  return std::nullopt;
}

// No two sides meet but where one follows the other.
bool are_apart(const std::vector<Ring2>& rings) {
  std::vector<exact::Kernel::Segment_2> sides;
  for (const Ring2& ring : rings) {
    if (ring.size() < 3) return false;
    for (std::size_t i = 0; i < ring.size(); ++i) sides.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].is_degenerate()) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if (!CGAL::do_intersect(sides[i], sides[j])) continue;
      const bool follow = sides[i].source() == sides[j].target() || sides[i].target() == sides[j].source();
      const bool fold = CGAL::collinear(sides[i].source(), sides[i].target(), sides[j].source()) &&
                        CGAL::collinear(sides[i].source(), sides[i].target(), sides[j].target()) &&
                        CGAL::is_negative(sides[i].to_vector() * sides[j].to_vector());
      if (!follow || fold) return false;
    }
  }
  return true;
}

FT area_of(const std::vector<Ring2>& rings) {
  FT sum(0);
  for (const Ring2& ring : rings) sum += twice_area(ring);
  return sum;
}

}  // namespace

std::optional<std::vector<Ring2>> rounded_inwards(const std::vector<Ring2>& face) {
  std::vector<Ring2> rings;
  for (const Ring2& ring : face) {
    rings.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto corner =
          rounded_corner(ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]);
      if (!corner) return std::nullopt;
      rings.back().push_back(*corner);
    }
    Ring2& made = rings.back();
    made.erase(std::unique(made.begin(), made.end()), made.end());
  }
  if (!are_apart(rings) || !CGAL::is_positive(area_of(rings))) return std::nullopt;
  const FT whole = area_of(face) + area_of(rings) + FT(1);  // more than either set has
  if (!subtract(FlatSet(whole, {rings}), FlatSet(whole, {face})).empty()) return std::nullopt;
  return rings;
}

}  // namespace clues::reference
