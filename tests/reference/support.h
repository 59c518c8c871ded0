// Small scenes built by hand, and the questions that the tests of reference/ ask of a map.
#pragma once

#include <array>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"

namespace clues::test {

class SceneBuilder {
 public:
  // The id of the first triangle added.
  std::uint32_t triangle(const scene::Point& a, const scene::Point& b, const scene::Point& c);
  std::uint32_t quad(const scene::Point& a, const scene::Point& b, const scene::Point& c, const scene::Point& d);
  // The rectangle [x0,x1] x [y0,y1] at height z, front side up.
  std::uint32_t plate(double x0, double y0, double x1, double y1, double z);
  std::uint32_t box(const scene::Point& lo, const scene::Point& hi);  // closed, outward: 12 triangles
  // A polygon of the plane z = 0, counter-clockwise, extruded to |z| <= h: sides first (two triangles each), then the caps, for which
  // `cap` lists corner triples.
  std::uint32_t prism(const std::vector<std::array<double, 2>>& polygon, double h,
                      const std::vector<std::array<int, 3>>& cap);

  const scene::TriangleMesh& mesh() const { return mesh_; }

 private:
  std::uint32_t point(const scene::Point& p);
  scene::TriangleMesh mesh_;
};

exact::ConvexCell box_cell(double x0, double y0, double z0, double x1, double y1, double z1);

reference::VisibilityMap map_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                const reference::Options& options = {});

// The exact area of the hidden regions on one side of the triangles first, first+1, ..., first+count-1, which lie in planes z = constant.
exact::FT hidden_area(const reference::VisibilityMap& map, const scene::TriangleMesh& mesh, std::uint32_t first,
                      std::uint32_t count, bool front);

// Whether the region of triangle t's side that contains x (a point of the triangle in no segment of the map) is visible.
bool is_visible(const reference::VisibilityMap& map, std::uint32_t t, bool front, const scene::Point& x);

// The same on whichever of the two triangles of a quad holds x.
bool quad_visible(const reference::VisibilityMap& map, std::uint32_t quad, bool front, const scene::Point& x);

}  // namespace clues::test
