// T15: what solids cut out of a plane, fused. Where walls abut their sections do, too, and what crosses the plane between them is stopped as if they were one.
//
// The union of the sections of all solids in a plane is found exactly, once it is needed; what is kept of it is its rim, rounded. A set of crossing points that is connected, keeps clear of the rim and has one point in
// the union lies in the union.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
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
  // Of solids with corners on both sides of the plane; they must outlive it. O(n) steps in doubles for n of them.
  Section(const SectionPlane& plane, std::span<const Solid> solids, const Scale& scale);

  // Whether every segment from one piece to the other crosses the plane in the union, but for a set of measure 0. False if they are not on different sides of it, and whenever that is in doubt. The
  // first time that this is not clear at once the sections are computed exactly: O(n^2) for boxes, and as many exact steps as they have neighbours.
  bool covers(const Piece& from, const Piece& to) const;

  std::size_t polygons() const { return of_.size(); }

 private:
  using Polygon = std::vector<Spot>;  // counter-clockwise
  // What may be in a part of the plane, by squares of a grid.
  struct Entry {
    Rectangle box;
    std::uint32_t id;
  };
  struct Grid {
    std::vector<std::uint32_t> first;
    std::vector<Entry> entries;
  };
  struct Polygons {
    std::vector<Spot> corners;            // counter-clockwise, polygon by polygon,
    std::vector<std::uint32_t> first{0};  // which begin here; one more at the end
    std::size_t size() const { return first.size() - 1; }
    void add(std::span<const Spot> polygon) {
      corners.insert(corners.end(), polygon.begin(), polygon.end());
      first.push_back(static_cast<std::uint32_t>(corners.size()));
    }
  };
  struct Rim {
    Spot a, b;
    const Side* side;  // in whose plane it lies; none: not known
  };
  struct Exact {
    Polygons polygons;
    std::vector<Rim> rim;
    Grid polygons_at, rim_at;
  };
  std::size_t square(double x, std::size_t axis) const;
  Grid grid_of(const std::vector<Rectangle>& boxes) const;
  void make_exact() const;
  // Whether the point is in one of the polygons, as deep as that, or outside by less if it is negative.
  bool is_in_one(const Polygons& polygons, const Grid& at, const Spot& spot, double depth) const;
  // Whether the point is in one of the sections, and further from its border than crossings may be off.
  bool holds(const Spot& spot) const;
  // Whether it seems to be further away from all of them than the margin.
  bool misses(const Spot& spot) const;
  // Whether some of the rim is within the margin of the window, a convex polygon, and may be inside of what crosses the plane.
  bool rim_meets(const Polygon& window, const Piece& from, const Piece& to) const;

  SectionPlane plane_;
  Scale scale_;
  std::size_t dropped_ = 0, u_ = 1,
              v_ = 2;  // the axis that is left out in the plane, along which its normal is longest; the others
  std::vector<const Solid*> of_;
  Polygons polygons_;  // of these, in doubles, for guesses
  Rectangle all_;
  std::size_t squares_ = 1;  // along each axis
  Grid polygons_at_;
  mutable std::once_flag exact_made_;
  mutable Exact exact_;  // the same, exactly but for a rounding at last
};

}  // namespace clues::fastpath::solids
