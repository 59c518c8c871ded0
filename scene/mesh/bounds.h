// The axis-aligned box around points: closed, low <= high.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

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

inline bool touch(const Bounds& a, const Bounds& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.high[i] < b.low[i] || b.high[i] < a.low[i]) return false;
  }
  return true;
}

}  // namespace clues::scene
