// T15: what solids cut out of a plane, fused. Where walls abut their sections do, too, and what crosses the plane between them is stopped as if they were one.
//
// The union of the sections of all solids in a plane is found exactly; what is kept of it is its rim, rounded. A set of crossing points that is connected, keeps clear of the rim and has one point in
// the union lies in the union.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fastpath/solids/plane_shapes.h"
#include "fastpath/solids/solid.h"

namespace clues::fastpath::solids {

// How large lengths are, for the solids of a scene and whoever asks about it: a power of two that no coordinate of what is asked about exceeds. Errors of rounding are far below `margin`
// where planes are crossed between points that are `clearance` from them or more (docs/solids.md has the sum).
struct Scale {
  double largest = 1;
  double margin() const { return largest * 0x1p-22; }
  double clearance() const { return largest * 0x1p-17; }
  double depth() const { return largest * 0x1p-15; }  // how far behind a side of a solid its section is taken
  static Scale of(const Bounds& bounds);
};

// Whether no point of the piece, as it would be if it were not rounded, is outside; with certainty.
bool is_inside(const Side& side, const Piece& piece, const Scale& scale);

// All x with normal * x = distance, exactly as these doubles are.
struct SectionPlane {
  std::array<double, 3> normal{};
  double distance = 0;
};

class Section {
 public:
  // Of solids with corners on both sides of the plane; they must outlive it. With n of them O(n^2) for boxes, and as many exact steps as their sections have neighbours.
  Section(const SectionPlane& plane, std::span<const Solid> solids, const Scale& scale);

  // Whether every segment from one piece to the other crosses the plane in the union, but for a set of measure 0. False if they are not on different sides of it, and whenever that is in doubt.
  bool covers(const Piece& from, const Piece& to) const;

  std::size_t polygons() const { return polygons_.size(); }

 private:
  // What may be in a part of the plane, by squares of a grid.
  struct Entry {
    Rectangle box;
    std::uint32_t id;
  };
  struct Grid {
    std::vector<std::uint32_t> first;
    std::vector<Entry> entries;
  };
  std::size_t square(double x, std::size_t axis) const;
  Grid grid_of(const std::vector<Rectangle>& boxes) const;
  // Whether the point is in one of the sections, and not within a rounding of its border.
  bool holds(const Spot& spot) const;
  // Whether it is further away from all of them than the margin.
  bool misses(const Spot& spot) const;

  // Whether some of the rim is within the margin of the window, a convex polygon, and may be inside of what crosses the plane.
  bool rim_meets(const std::vector<Spot>& window, const Piece& from, const Piece& to) const;

  SectionPlane plane_;
  Scale scale_;
  std::size_t dropped_ = 0, u_ = 1,
              v_ = 2;  // the axis that is left out in the plane, along which its normal is longest; the others
  std::vector<std::vector<Spot>> polygons_;  // counter-clockwise
  struct Rim {
    Spot a, b;
    const Side* side;  // in whose plane it lies; none: not known
  };
  std::vector<Rim> rim_;
  Rectangle all_;
  std::size_t squares_ = 1;  // along each axis
  Grid polygons_at_, rim_at_;
};

}  // namespace clues::fastpath::solids
