// D1: coordinates are exact rationals, of any size that a double has; engines work where products of
// coordinates are doubles, too. So a scene and its cell are moved into a standard range on entering an
// engine, by one power of two, and answers are moved back. What D1-D21 define does not depend on the unit of
// length. Both ways are exact: a coordinate that cannot be moved exactly is refused, with its name, before
// any work.
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh/mesh.h"

namespace clues::exact {

class StandardRange {
 public:
  StandardRange() = default;  // moves nothing

  // For a scene (vertices that no triangle uses do not count) and a cell. Nothing is moved if the largest
  // coordinate is about 2^-64 to 2^64; else it becomes 1 to 2, or more where small coordinates allow no more.
  // Throws scene::Error unsupported, with the vertex, where it would stay beyond 2^128. O(n).
  StandardRange(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell);
  StandardRange(const scene::TriangleMesh& mesh, const ConvexCell& cell);

  bool moves() const { return exponent_ != 0; }

  // Into the range, exactly. Vertices that no triangle uses may become anything finite.
  scene::TriangleMesh moved_in(const scene::TriangleMesh& mesh) const;
  std::vector<scene::Point> moved_in(const std::vector<scene::Point>& cell) const;
  ConvexCell moved_in(const ConvexCell& cell) const;
  Point3 moved_in(const Point3& p) const { return scaled(p, -exponent_); }

  // And back.
  Point3 moved_back(const Point3& p) const { return scaled(p, exponent_); }
  Plane3 moved_back(const Plane3& h) const;
  ConvexCell moved_back(const ConvexCell& cell) const { return scaled(cell, exponent_); }
  scene::Point estimate_moved_back(const scene::Point& p) const;  // nearest doubles
  // Areas are estimates: past the range of doubles they are infinite, or 0.
  double area_moved_in(double area) const;
  double area_moved_back(double area) const;

 private:
  static FT scaled(const FT& x, int exponent);
  static Point3 scaled(const Point3& p, int exponent);
  static ConvexCell scaled(const ConvexCell& cell, int exponent);

  int exponent_ = 0;  // coordinates in the range times 2^exponent are those of the scene
};

}  // namespace clues::exact
