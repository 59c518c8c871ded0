#include "validate/multires/level_replay.h"

#include <algorithm>

namespace clues::validate {
namespace {

scene::Triangle from_lowest(scene::Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

TriangleSet::TriangleSet(const std::vector<scene::Triangle>& triangles, std::size_t vertices)
    : count_(vertices, 0), edges_(vertices) {
  for (const auto& t : triangles) insert(t);
}

bool TriangleSet::has(const scene::Triangle& oriented) const { return triangles_.count(from_lowest(oriented)) != 0; }

bool TriangleSet::has_vertices(scene::Triangle corners) const {
  return has(corners) || has({corners[0], corners[2], corners[1]});
}

void TriangleSet::insert(const scene::Triangle& oriented) {
  if (triangles_.insert(from_lowest(oriented)).second) count(oriented, 1);
}

void TriangleSet::erase(const scene::Triangle& oriented) {
  if (triangles_.erase(from_lowest(oriented)) != 0) count(oriented, -1);
}

void TriangleSet::count(const scene::Triangle& t, int by) {
  for (std::size_t k = 0; k < 3; ++k) {
    count_[t[k]] += static_cast<std::size_t>(by);
    for (const std::uint32_t other : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
      int& uses = edges_[t[k]][other];
      uses += by;
      if (uses == 0) edges_[t[k]].erase(other);
    }
  }
}

std::vector<scene::Triangle> TriangleSet::all() const { return {triangles_.begin(), triangles_.end()}; }

bool has_free_triangulation(const std::vector<std::uint32_t>& polygon, const TriangleSet& surface) {
  const std::size_t n = polygon.size();
  std::vector<bool> closes(n * n, false);
  for (std::size_t i = 0; i + 1 < n; ++i) closes[i * n + i + 1] = true;
  for (std::size_t width = 2; width < n; ++width) {
    for (std::size_t i = 0; i + width < n; ++i) {
      const std::size_t j = i + width;
      if (width + 1 < n && surface.has_edge(polygon[i], polygon[j])) continue;
      for (std::size_t k = i + 1; k < j; ++k) {
        if (closes[i * n + k] && closes[k * n + j] && !surface.has_vertices({polygon[i], polygon[k], polygon[j]})) {
          closes[i * n + j] = true;
        }
      }
    }
  }
  return n >= 3 && closes[n - 1];
}

}  // namespace clues::validate
