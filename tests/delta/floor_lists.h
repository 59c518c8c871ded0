// A floor of squares, lists of discs on it, and stores of them, for the tests of files of lists.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "reference/streams/list_store.h"

namespace clues::test {

using RecordKind = scene::ListRecord::Kind;
using ManyLists = std::vector<std::vector<std::uint32_t>>;
using ListLevels = std::vector<std::vector<scene::ListPlace>>;

struct StoreScene {
  scene::TriangleMesh mesh;
  reference::EdgeUsers edges;
  reference::AreaWorth worth;

  explicit StoreScene(scene::TriangleMesh given) : mesh(std::move(given)), edges(mesh), worth(mesh) {}
};

// A square of 2 n^2 triangles, so that lists of them have contours.
inline scene::TriangleMesh floor_of(std::uint32_t n) {
  scene::TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) mesh.points.push_back({static_cast<double>(x), static_cast<double>(y), 0});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      for (const auto& t : {scene::Triangle{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}}) {
        mesh.face_of.push_back(mesh.triangles.size());
        mesh.triangles.push_back(t);
      }
    }
  }
  return mesh;
}

// All triangles of the floor whose square is within r of (x, y).
inline std::vector<std::uint32_t> disc(std::uint32_t n, double x, double y, double r) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const double dx = static_cast<double>(i % n) - x, dy = static_cast<double>(i / n) - y;
    if (dx * dx + dy * dy > r * r) continue;
    out.push_back(2 * i);
    out.push_back(2 * i + 1);
  }
  return out;
}

inline constexpr std::uint32_t floor_size = 24;

inline StoreScene& floor_scene() {
  static StoreScene scene(floor_of(floor_size));
  return scene;
}

// 16 cells in a row, in nodes of 4 and of 8, with discs that move on.
struct Row {
  ManyLists lists;
  reference::CellTree tree;
};
inline Row row_of_discs(double step, double r) {
  Row row;
  std::vector<std::vector<scene::Point>> corners;
  for (int c = 0; c < 16; ++c) {
    row.lists.push_back(disc(floor_size, 4 + step * c, 12, r));
    corners.push_back({{1.0 * c, 0, 0}, {1.0 * c + 1, 1, 1}});
  }
  row.tree = reference::cell_tree(corners, 4);
  return row;
}

inline ListLevels made(const Row& row, std::vector<std::size_t> levels, double give_up = 0) {
  StoreScene& s = floor_scene();
  return reference::made_levels(s.edges, s.worth, row.lists, row.tree, {std::move(levels), exact::FT(give_up)});
}

inline scene::ListFile file_with(ListLevels levels, std::uint64_t triangles) {
  scene::ListFile file;
  file.scene_sha256 = std::string(64, 'a');
  file.scene_triangles = triangles;
  file.question = "a row";
  for (std::size_t c = 0; c < levels.back().size(); ++c)
    file.cells.push_back({std::to_string(c), {{0.5 * static_cast<double>(c), -0.0, 0}, {1, 1, 1}}, {}});
  file.levels = std::move(levels);
  return file;
}

}  // namespace clues::test
