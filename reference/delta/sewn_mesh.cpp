#include "reference/delta/sewn_mesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "exact/box_tree.h"
#include "reference/visibility/planar/plane_frame.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::Kernel;
using exact::Point2;
using exact::Point3;
using exact::Vector3;

namespace {

using Index = std::uint64_t;
using Side = std::pair<Index, Index>;  // the smaller first
using IndexRing = std::vector<Index>;

enum class Where : std::uint8_t { unknown, outside, inside };

using SewnVertices = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using SewnFaces =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<Where, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<SewnVertices, SewnFaces>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

// Twice the area of the rings, as a vector: it points to where they turn counter-clockwise.
Vector3 area_vector(const Rings3& rings) {
  Vector3 sum(0, 0, 0);
  for (const auto& ring : rings) {
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
      sum += CGAL::cross_product(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return sum;
}

// Of the plane, only its direction counts.
PlaneFrame frame_of(const Vector3& normal) { return PlaneFrame(exact::Plane3(normal.x(), normal.y(), normal.z(), 0)); }

// The points inside of sides.
class Cuts {
 public:
  explicit Cuts(const std::vector<Point3>& points) : points_(points) {
    std::vector<CGAL::Bbox_3> boxes;
    for (const Point3& p : points) boxes.push_back(p.bbox());
    tree_ = exact::BoxTree(std::move(boxes));
  }

  // In the order from the first end to the second, which along a line is the lexicographic one.
  const std::vector<Index>& of(const Side& side) {
    const auto [at, fresh] = known_.try_emplace(side);
    if (!fresh) return at->second;
    const Point3 &a = points_[side.first], &b = points_[side.second];
    for (const std::uint32_t i : tree_.candidates(exact::SegmentBoxTest(a, b))) {
      if (i <= side.first || i >= side.second) continue;
      if (CGAL::collinear(a, points_[i], b)) at->second.push_back(i);
    }
    return at->second;
  }

 private:
  const std::vector<Point3>& points_;
  exact::BoxTree tree_;
  std::map<Side, std::vector<Index>> known_;
};

IndexRing with_cuts(const IndexRing& ring, Cuts& cuts) {
  IndexRing out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index a = ring[i], b = ring[(i + 1) % ring.size()];
    out.push_back(a);
    const std::vector<Index>& between = cuts.of(std::minmax(a, b));
    if (a < b) {
      out.insert(out.end(), between.begin(), between.end());
    } else {
      out.insert(out.end(), between.rbegin(), between.rend());
    }
  }
  return out;
}

// The sides that separate inside from outside: those that are walked an odd number of times.
std::vector<Side> borders_of(const std::vector<IndexRing>& rings) {
  std::set<Side> odd;
  for (const IndexRing& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Side side = std::minmax(ring[i], ring[(i + 1) % ring.size()]);
      if (side.first == side.second) continue;
      if (const auto [at, fresh] = odd.insert(side); !fresh) odd.erase(at);
    }
  }
  return {odd.begin(), odd.end()};
}

// Every border that is crossed on the way from outside changes the side.
void mark_inside(Triangulation& t) {
  std::vector<Triangulation::Face_handle> open{t.infinite_face()};
  t.infinite_face()->info() = Where::outside;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() != Where::unknown) continue;
      const bool crosses = t.is_constrained({face, i});
      next->info() = (face->info() == Where::inside) != crosses ? Where::inside : Where::outside;
      open.push_back(next);
    }
  }
}

void triangulate(const std::vector<Side>& borders, const PlaneFrame& flat, Index region, SewnMesh& mesh) {
  Triangulation t;
  std::map<Index, Triangulation::Vertex_handle> corners;
  for (const auto& [a, b] : borders) {
    corners.try_emplace(a);
    corners.try_emplace(b);
  }
  for (auto& [i, handle] : corners) {
    handle = t.insert(flat(mesh.points[i]));
    handle->info() = i;
  }
  for (const auto& [a, b] : borders) t.insert_constraint(corners.at(a), corners.at(b));
  for (auto f = t.all_faces_begin(); f != t.all_faces_end(); ++f) f->info() = Where::unknown;
  mark_inside(t);
  const std::size_t first = mesh.triangles.size();
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    if (f->info() != Where::inside) continue;
    SewnMesh::Triangle triangle{{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()}, region};
    std::rotate(triangle.corners.begin(), std::min_element(triangle.corners.begin(), triangle.corners.end()),
                triangle.corners.end());
    mesh.triangles.push_back(triangle);
  }
  if (mesh.triangles.size() == first)
    throw scene::Error(scene::ErrorCode::internal, "sewn mesh: a region without an area");
  std::sort(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first), mesh.triangles.end(),
            [](const SewnMesh::Triangle& a, const SewnMesh::Triangle& b) { return a.corners < b.corners; });
}

}  // namespace

SewnMesh sew(const std::vector<Rings3>& regions) {
  SewnMesh mesh;
  std::map<Point3, Index> number;
  for (const Rings3& rings : regions) {
    for (const auto& ring : rings) {
      for (const Point3& p : ring) number.emplace(p, 0);
    }
  }
  for (auto& [p, i] : number) {
    i = mesh.points.size();
    mesh.points.push_back(p);
  }
  Cuts cuts(mesh.points);
  for (Index r = 0; r < regions.size(); ++r) {
    std::vector<IndexRing> rings;
    for (const auto& ring : regions[r]) {
      IndexRing indices;
      for (const Point3& p : ring) indices.push_back(number.at(p));
      rings.push_back(with_cuts(indices, cuts));
    }
    triangulate(borders_of(rings), frame_of(area_vector(regions[r])), r, mesh);
  }
  return mesh;
}

}  // namespace clues::reference
