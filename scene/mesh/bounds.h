// The axis-aligned box around points: closed, low <= high.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

struct Bounds {
  Point low{}, high{};
};

inline Bounds hull_of(const Bounds& a, const Bounds& b) {
  Bounds out = a;
  for (std::size_t i = 0; i < 3; ++i) {
    out.low[i] = std::min(a.low[i], b.low[i]);
    out.high[i] = std::max(a.high[i], b.high[i]);
  }
  return out;
}

// Of one point or more.
inline Bounds bounds_of(std::span<const Point> points) {
  Bounds out{points[0], points[0]};
  for (const Point& p : points) out = hull_of(out, {p, p});
  return out;
}

// Number i of 8, x fastest.
inline Point corner_of(const Bounds& b, unsigned i) {
  return {(i & 1U) != 0 ? b.high[0] : b.low[0], (i & 2U) != 0 ? b.high[1] : b.low[1],
          (i & 4U) != 0 ? b.high[2] : b.low[2]};
}

// Distinct, ascending: eight of a solid box, fewer of a flat one.
inline std::vector<Point> corners_of(const Bounds& b) {
  std::vector<Point> corners;
  for (unsigned i = 0; i < 8; ++i) corners.push_back(corner_of(b, i));
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

inline bool touch(const Bounds& a, const Bounds& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.high[i] < b.low[i] || b.high[i] < a.low[i]) return false;
  }
  return true;
}

}  // namespace clues::scene
