#include "fuzz/generators/given_scenes.h"

#include <algorithm>
#include <cmath>

#include "fuzz/generators/parts.h"

namespace clues::fuzz {
namespace {

using scene::Point;
using scene::TriangleMesh;

struct Box {
  Point lo, hi;
};

Box box_around(const TriangleMesh& mesh) {
  Box box{mesh.points.front(), mesh.points.front()};
  for (const auto& p : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[i] = std::min(box.lo[i], p[i]);
      box.hi[i] = std::max(box.hi[i], p[i]);
    }
  }
  return box;
}

// `wanted` triangles around `start`, each with a corner in common with an earlier one. The points keep their coordinates.
TriangleMesh patch(const TriangleMesh& mesh, std::size_t start, std::size_t wanted) {
  TriangleMesh out;
  std::vector<std::uint32_t> corners;  // of the mesh; out.points has them in this order
  std::vector<bool> taken(mesh.triangles.size());
  const auto take = [&](std::size_t t) {
    taken[t] = true;
    scene::Triangle mine;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = std::find(corners.begin(), corners.end(), mesh.triangles[t][i]);
      mine[i] = static_cast<std::uint32_t>(at - corners.begin());
      if (at != corners.end()) continue;
      corners.push_back(mesh.triangles[t][i]);
      out.points.push_back(mesh.points[corners.back()]);
    }
    out.face_of.push_back(static_cast<std::uint32_t>(out.triangles.size()));
    out.triangles.push_back(mine);
  };
  take(start);
  for (bool more = true; more && out.triangles.size() < wanted;) {
    more = false;
    const std::vector<std::uint32_t> known = corners;
    for (std::size_t t = 0; t < mesh.triangles.size() && out.triangles.size() < wanted; ++t) {
      const auto& corner = mesh.triangles[t];
      const bool beside = std::any_of(corner.begin(), corner.end(), [&](std::uint32_t c) {
        return std::find(known.begin(), known.end(), c) != known.end();
      });
      if (taken[t] || !beside) continue;
      take(t);
      more = true;
    }
  }
  return out;
}

void append(TriangleMesh& to, const TriangleMesh& part, const Point& offset) {
  const auto first = static_cast<std::uint32_t>(to.points.size());
  for (const Point& p : part.points) to.points.push_back({p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]});
  for (const auto& t : part.triangles) {
    to.face_of.push_back(static_cast<std::uint32_t>(to.triangles.size()));
    to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void drop(TriangleMesh& mesh, std::size_t t) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
  mesh.face_of.pop_back();
}

std::size_t any_triangle(const TriangleMesh& mesh, Random& random) {
  return static_cast<std::size_t>(random.between(0, static_cast<int>(mesh.triangles.size()) - 1));
}

// A box of a part of the extent of the scene, somewhere around it or in it.
std::vector<Point> cell_near(const TriangleMesh& mesh, Random& random) {
  const Box box = box_around(mesh);
  Point lo, hi;
  for (std::size_t i = 0; i < 3; ++i) {
    const double extent = box.hi[i] - box.lo[i], size = std::max(extent, 1e-6) * random.between(1, 16) / 32;
    lo[i] = box.lo[i] + extent * random.between(-16, 24) / 16;
    hi[i] = lo[i] + size;
  }
  return box_of(lo, hi);
}

void mutate(GeneratedScene& scene, Random& random) {
  auto& mesh = scene.mesh;
  auto& points = random.one_in(6) ? scene.cell : mesh.points;
  Point& p = any(points, random);
  const auto axis = static_cast<std::size_t>(random.between(0, 2));
  switch (random.between(0, 8)) {
    case 0:
      p[axis] = std::nextafter(p[axis], random.one_in(2) ? HUGE_VAL : -HUGE_VAL);
      return;
    case 1:
      p[axis] += random.between(-32, 32) / 16.0;
      return;
    case 2:
      p[axis] = any(random.one_in(2) ? mesh.points : scene.cell, random)[axis];  // in one plane with it
      return;
    case 3:
      p = any(mesh.points, random);
      return;
    case 4: {
      const Point &a = any(mesh.points, random), &b = any(mesh.points, random);
      for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] / 2 + b[i] / 2;
      return;
    }
    case 5:
      if (mesh.triangles.size() > 2) drop(mesh, any_triangle(mesh, random));
      return;
    case 6:
    case 7: {
      scene::Triangle t = mesh.triangles[any_triangle(mesh, random)];
      if (random.one_in(2)) std::swap(t[0], t[1]);
      if (random.one_in(2))
        t[2] = static_cast<std::uint32_t>(random.between(0, static_cast<int>(mesh.points.size()) - 1));
      mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
      mesh.triangles.push_back(t);
      return;
    }
    default: {
      auto& t = mesh.triangles[any_triangle(mesh, random)];
      std::swap(t[0], t[1]);
      return;
    }
  }
}

}  // namespace

GeneratedScene mesh_pieces(const std::vector<GivenScene>& meshes, std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 30);
  GeneratedScene scene;
  const int pieces = random.between(2, 3);
  for (int i = 0; i < pieces; ++i) {
    const TriangleMesh& mesh = any(meshes, random).mesh;
    TriangleMesh part =
        patch(mesh, any_triangle(mesh, random), static_cast<std::size_t>(random.between(4, 40 / pieces)));
    for (std::size_t t = part.triangles.size(); t-- > 1;) {
      if (random.between(0, 14) < dial_of(index)) drop(part, t);
    }
    // Beside or behind the others, at about the distance of its own size; where it came from only its shape is kept, and the last bits of it.
    const Box box = box_around(part);
    const double size = std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
    Point offset;
    for (std::size_t k = 0; k < 3; ++k) offset[k] = -box.lo[k] + size * random.between(-12, 12) / 16;
    offset[0] += i * size;
    append(scene.mesh, part, offset);
  }
  scene.cell = cell_near(scene.mesh, random);
  return scene;
}

GeneratedScene mutations(const std::vector<GivenScene>& scenes, std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 31);
  GeneratedScene scene;
  if (scenes.empty()) {
    scene = base_scene(random);
  } else {
    const GivenScene& given = any(scenes, random);
    scene.mesh = given.mesh;
    scene.cell = given.cell.empty() ? cell_near(given.mesh, random) : given.cell;
  }
  for (int n = 1 + dial_of(index); n > 0; --n) mutate(scene, random);
  return scene;
}

}  // namespace clues::fuzz
