// Real meshes come simplified (edge collapse) and snapped to a grid of 1/1024, which keeps the exact numbers short; what the
// snapping makes intersect is refined like anything else (D16).
#include "app/demo/demo_scene.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fuzz/generators/city.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

using Double = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Double::Point_3>;
using scene::Point;
using scene::TriangleMesh;

constexpr double grid = 1024;

std::vector<Point> box_corners(const Point& lo, const Point& hi) {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]});
  }
  return corners;
}

void append(TriangleMesh& scene, const TriangleMesh& part) {
  const auto first = static_cast<std::uint32_t>(scene.points.size());
  scene.points.insert(scene.points.end(), part.points.begin(), part.points.end());
  for (const auto& [a, b, c] : part.triangles) {
    scene.face_of.push_back(static_cast<std::uint32_t>(scene.triangles.size()));
    scene.triangles.push_back({first + a, first + b, first + c});
  }
}

TriangleMesh box(const Point& lo, const Point& hi) {
  TriangleMesh mesh;
  mesh.points = box_corners(lo, hi);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh simplified(const TriangleMesh& mesh, std::uint32_t triangles) {
  SurfaceMesh surface;
  for (const auto& p : mesh.points) surface.add_vertex({p[0], p[1], p[2]});
  for (const auto& [a, b, c] : mesh.triangles) {
    surface.add_face(SurfaceMesh::Vertex_index(a), SurfaceMesh::Vertex_index(b), SurfaceMesh::Vertex_index(c));
  }
  namespace simplification = CGAL::Surface_mesh_simplification;
  const std::size_t edges = std::size_t{triangles} * 3 / 2;  // of a closed mesh
  simplification::edge_collapse(surface, simplification::Count_stop_predicate<SurfaceMesh>(edges));
  surface.collect_garbage();
  TriangleMesh result;
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    result.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : surface.faces()) {
    scene::Triangle triangle{};
    int i = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) triangle[i++] = v;
    result.triangles.push_back(triangle);
  }
  return result;
}

// Turns y-up into z-up, scales to `length` along x, and stands the mesh on the ground at (x, y).
void stand(TriangleMesh& mesh, double length, double x, double y) {
  for (auto& p : mesh.points) p = {p[0], -p[2], p[1]};
  Point lo = mesh.points.front(), hi = lo;
  for (const auto& p : mesh.points) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  const double scale = length / (hi[0] - lo[0]);
  const Point base{(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2, lo[2]}, place{x, y, 0};
  for (auto& p : mesh.points) {
    for (int i = 0; i < 3; ++i) p[i] = std::round(((p[i] - base[i]) * scale + place[i]) * grid) / grid;
  }
}

}  // namespace

DemoScene animals_scene(const std::filesystem::path& mesh_dir, std::uint32_t triangles_each) {
  struct Animal {
    const char* file;
    double length, x, y;
  };
  DemoScene demo{"animals", "an elephant, a cow and a bull behind a wall with a doorway", {}, {}};
  auto& mesh = demo.mesh;
  mesh.points = {{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_of = {0, 1};
  append(mesh, box({-7, -3, 0}, {-1, -2.75, 3}));  // the wall to the street, left and right of the doorway
  append(mesh, box({1, -3, 0}, {7, -2.75, 3}));
  append(mesh, box({-7, 6, 0}, {7, 6.25, 3}));  // the wall at the back
  for (const auto& animal :
       {Animal{"elephant.off", 3, -1.5, 2.5}, Animal{"cow.off", 2.5, 0.75, 0}, Animal{"bull.off", 2.5, 3.5, 3.5}}) {
    const auto path = mesh_dir / animal.file;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
      throw scene::Error(
          scene::ErrorCode::file_not_found,
          path.string() +
              ": no such mesh; `./run demo` extracts it from the Debian package libcgal-demo, or give --mesh-dir");
    }
    auto part = simplified(scene::read_mesh(path), triangles_each);
    stand(part, animal.length, animal.x, animal.y);
    append(mesh, part);
  }
  demo.cell = box_corners({-1, -6, 1.25}, {0.5, -5.5, 1.75});
  return demo;
}

DemoScene city_scene(std::uint32_t triangles, std::uint64_t seed) {
  return {"city", "a generated city block: streets, houses, doorways and windows", fuzz::make_city(triangles, seed),
          fuzz::street_cell(triangles, seed)};
}

std::string box_spec(const std::vector<Point>& corners) {
  Point lo = corners.front(), hi = lo;
  for (const auto& p : corners) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  return fmt::format("box:{},{},{},{},{},{}", lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
}

}  // namespace clues::app
