// How much of every side is known to be seen, and how much is not known to be hidden (D21's sandwich), as convex polygons in doubles. Estimates, for
// reports, for pictures and for when to stop; whether a triangle is listed never depends on them.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "fastpath/visibility/map/local_map.h"

namespace clues::fastpath {

class AreaBounds {
 public:
  // The visible regions of the first-order map are in doubt, its hidden ones are settled.
  explicit AreaBounds(std::vector<LocalRegion> first_order);

  // What visible regions of the map of a point of the cell cover is in doubt no more: it is seen.
  void witness(const std::vector<LocalRegion>& seen);
  // What no visible region of these covers is hidden, on the triangles wanted.
  void restrict_to(const std::vector<const std::vector<LocalRegion>*>& parts, const std::vector<bool>& wanted);

  double witnessed() const;
  double in_doubt() const;
  double refined() const { return witnessed() + in_doubt(); }
  double first_order() const { return first_order_; }
  // Whether more of the triangle is in doubt than roundings account for.
  bool in_doubt(std::uint32_t triangle) const;
  // What is in doubt, on these triangles.
  std::vector<LocalRegion> doubtful(const std::vector<bool>& wanted) const;
  // Whether a visible region of these has more than that in common with what is in doubt.
  bool reach_doubt(const std::vector<LocalRegion>& regions) const;

  // Convex parts of all sides; visible: seen or in doubt. By triangle, front first.
  std::vector<LocalRegion> regions() const;

 private:
  using Polygon = std::vector<Point>;
  using Polygons = std::vector<Polygon>;
  struct Side {
    Polygons seen, doubt, hidden;
    double area = 0;  // of all three
  };
  using Key = std::pair<std::uint32_t, bool>;  // triangle, back

  static Key key_of(const LocalRegion& r) { return {r.triangle, !r.front}; }
  static double area_of(const Polygons& polygons);
  static bool matters(double area, const Side& side);

  std::map<Key, Side> sides_;
  double first_order_ = 0;
};

}  // namespace clues::fastpath
