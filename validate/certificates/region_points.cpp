// The region is seen along a coordinate axis that its plane is not parallel to; in that view a constrained Delaunay
// triangulation of the rings is filled from outside, changing side at every ring.
#include "validate/certificates/region_points.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

#include "scene/messages/error.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Kernel;
using exact::Point2;
using exact::Point3;
using exact::Vector3;

constexpr int unset = -1;

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<const Point3*, Kernel>;
using FaceInfoBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfoBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

// The vector area of a closed polygon (twice): not zero for a ring with area, whatever its corners' collinearities.
Vector3 twice_vector_area(const std::vector<Point3>& ring) {
  Vector3 sum(0, 0, 0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum = sum + CGAL::cross_product(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return sum;
}

// A view along one axis that keeps the turning sense of `normal` (counter-clockwise about it stays so).
class View {
 public:
  explicit View(const Vector3& normal) {
    for (int axis = 0; axis < 3; ++axis) {
      if (normal[axis] != 0 && (axis_ == unset || CGAL::abs(normal[axis]) > CGAL::abs(normal[axis_]))) axis_ = axis;
    }
    if (axis_ == unset) throw scene::Error(scene::ErrorCode::internal, "a region of the map has no area");
    flip_ = normal[axis_] < 0;
  }
  Point2 operator()(const Point3& p) const {
    const FT u = p[(axis_ + 1) % 3];
    const FT w = p[(axis_ + 2) % 3];
    return flip_ ? Point2(w, u) : Point2(u, w);
  }

 private:
  int axis_ = unset;
  bool flip_ = false;
};

// Depth 0: outside; +1 at every constrained edge. Odd depth is the region.
void fill(Triangulation& triangulation) {
  for (auto face : triangulation.all_face_handles()) face->info() = unset;
  std::vector<Triangulation::Face_handle> now{triangulation.infinite_face()}, next;
  for (int depth = 0; !now.empty(); ++depth, now.swap(next)) {
    next.clear();
    while (!now.empty()) {
      const auto face = now.back();
      now.pop_back();
      if (face->info() != unset) continue;
      face->info() = depth;
      for (int i = 0; i < 3; ++i) {
        const auto other = face->neighbor(i);
        if (other->info() != unset) continue;
        (triangulation.is_constrained({face, i}) ? next : now).push_back(other);
      }
    }
  }
}

}  // namespace

std::vector<ExactTriangle> triangulate_region(const Rings& rings) {
  if (rings.empty()) return {};
  const View view(twice_vector_area(rings.front()));
  Triangulation triangulation;
  for (const auto& ring : rings) {
    std::vector<Triangulation::Vertex_handle> handles;
    for (const auto& corner : ring) {
      handles.push_back(triangulation.insert(view(corner)));
      handles.back()->info() = &corner;
    }
    for (std::size_t i = 0; i < handles.size(); ++i) {
      const auto a = handles[i], b = handles[(i + 1) % handles.size()];
      if (a != b) triangulation.insert_constraint(a, b);
    }
  }
  fill(triangulation);

  std::vector<std::pair<FT, ExactTriangle>> found;
  for (auto face : triangulation.finite_face_handles()) {
    if (face->info() % 2 == 0) continue;
    ExactTriangle triangle{*face->vertex(0)->info(), *face->vertex(1)->info(), *face->vertex(2)->info()};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    found.emplace_back(CGAL::area(view(triangle[0]), view(triangle[1]), view(triangle[2])), triangle);
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  std::vector<ExactTriangle> triangles;
  for (auto& [area, triangle] : found) triangles.push_back(triangle);
  return triangles;
}

std::vector<Point3> interior_points(const Rings& rings, std::size_t count) {
  const auto triangles = triangulate_region(rings);
  std::vector<Point3> points;
  if (triangles.empty()) return points;
  for (int round = 0; points.size() < count; ++round) {
    for (const auto& [a, b, c] : triangles) {
      if (points.size() == count) break;
      // Round 0 is the centroid; then weights (k+2, 1, 1), (1, k+2, 1), (1, 1, k+2) walk towards the corners.
      const int heavy = round == 0 ? 1 : (round - 1) / 3 + 2;
      const int corner = round == 0 ? 0 : (round - 1) % 3;
      points.push_back(exact::collapsed(CGAL::barycenter(a, FT(corner == 0 ? heavy : 1), b, FT(corner == 1 ? heavy : 1),
                                                         c, FT(corner == 2 ? heavy : 1))));
    }
  }
  return points;
}

}  // namespace clues::validate
