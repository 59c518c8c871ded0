// A mesh under construction on an integer grid (D1: triangles in the order they are added). Equal grid points are one
// vertex; polygons are cut into triangles without new vertices, so that neighbours which share edges conform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::fuzz {

using GridPoint = std::array<int, 3>;
using GridPoint2 = std::array<int, 2>;

// Ear clipping in integers. The polygon is counter-clockwise and simple, but vertices may lie on straight edges and a hole may
// be joined to the outline by a doubled edge. Returns corner indices; no triangle is degenerate, and no vertex of the polygon lies
// on the edge of a triangle it is not a corner of. O(n^3).
std::vector<std::array<std::size_t, 3>> triangulate(const std::vector<GridPoint2>& polygon);

// Six times that of the tetrahedron abcd; positive where abc turns left seen from d.
std::int64_t volume(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);

bool collinear(const GridPoint& a, const GridPoint& b, const GridPoint& c);

class GridMesh {
 public:
  // Grid point (i,j,k) becomes (i,j,k) / units; units is a power of two.
  explicit GridMesh(int units) : units_(units) {}

  void triangle(const GridPoint& a, const GridPoint& b, const GridPoint& c);

  // A planar polygon given in space and in two coordinates of its own, in which it is counter-clockwise seen from the front.
  void polygon(const std::vector<GridPoint>& corners, const std::vector<GridPoint2>& flat);
  void quad(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);  // convex, from the front

  // Outward-facing closed box with lo < hi in every coordinate.
  void box(const GridPoint& lo, const GridPoint& hi);

  std::size_t size() const { return mesh_.triangles.size(); }
  GridPoint lowest() const;  // of all vertices; at least one triangle
  GridPoint highest() const;
  scene::TriangleMesh take() && { return std::move(mesh_); }
  scene::Point scaled(const GridPoint& p) const;

 private:
  std::uint32_t vertex(const GridPoint& p);

  int units_;
  std::uint32_t faces_ = 0;
  scene::TriangleMesh mesh_;
  std::map<GridPoint, std::uint32_t> index_;
};

// The eight corners of a box, x fastest.
std::vector<GridPoint> box_corners(const GridPoint& lo, const GridPoint& hi);

}  // namespace clues::fuzz
