// The exact half of section.h: polygons that solids cut out of a plane, and the rim of their union.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fastpath/solids/section.h"

namespace clues::fastpath::solids {

// Two rational coordinates, made when they are first asked for: doubles with a bound on their error tell most spots apart. Serves many threads at once.
class LazyRationals {
 public:
  using Pair = std::array<mpq_class, 2>;
  explicit LazyRationals(std::function<Pair()> make) : make_(std::move(make)) {}
  explicit LazyRationals(Pair pair) : pair_(std::move(pair)) {}
  const Pair& get() const;

 private:
  mutable std::once_flag made_;
  mutable std::function<Pair()> make_;  // none once they are there
  mutable Pair pair_;
};

// A point of the plane.
struct ExactSpot {
  double x = 0, y = 0;
  std::array<double, 2> off{};  // x and y are wrong by no more; 0: not at all
  bool is_brief = true;         // both exact, and determinants of such spots, too: multiples of 2^-6 below 2^17
  std::shared_ptr<const LazyRationals> exact;  // none: x and y are
  std::array<std::uint32_t, 2> between{};  // of a section: the corners of the solid that it lies between, or one twice
  // Of the edge of a section from here to the next corner; -1: not known.
  std::int32_t side = -1;   // of the solid, in whose plane it lies,
  std::int32_t plane = -1;  // and Side::plane of that

  LazyRationals::Pair rationals() const;
};

ExactSpot exact_spot(double x, double y);
using ExactPolygon = std::vector<ExactSpot>;  // strictly convex, counter-clockwise
using ExactSegment = std::array<ExactSpot, 2>;

// 1 where a, b, c turn left.
int sign_of_turn(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c);

// Whether they are the same point.
bool are_equal(const ExactSpot& a, const ExactSpot& b);

// One or more spots are in it, exactly.
Rectangle rectangle_around(std::span<const ExactSpot> spots);

// The corners of the hull, none on an edge; fewer than three if it is flat.
ExactPolygon convex_hull(std::vector<ExactSpot> points);

// Which of a solid is cut out of a plane: what is in its interior, or what has its interior just above, where the plane's normal points.
enum class Cutting : std::uint8_t { across, just_above };

// None where there is nothing with an area. `dropped` is the axis that is left out of the coordinates. The solid has to outlive the polygon, and what is made of that: its rationals are not made yet.
std::optional<ExactPolygon> section_of(const Solid& solid, const SectionPlane& plane, std::size_t dropped,
                                       Cutting cutting);

// A part of an edge of one of some polygons.
struct RimPart {
  ExactSegment segment;
  std::uint32_t polygon = 0, edge = 0;  // from corner number `edge` to the next
};

// What of the polygons' edges borders their union, as a closed set without whiskers: where the outer side of an edge is in no polygon.
std::vector<RimPart> rim_of_union(const std::vector<ExactPolygon>& polygons);

// Whether the segment has a point in the interior of all of the polygons.
bool enters_interior(const ExactSegment& segment, const std::vector<ExactPolygon>& polygons);

}  // namespace clues::fastpath::solids
