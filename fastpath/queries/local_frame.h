// Stage 1 works in floats on coordinates that are moved and scaled so that the scene fills [-1,1]^3: the unit of all its error bounds.
// Scenes far from the origin, huge or tiny, look the same to it.
#pragma once

#include <algorithm>
#include <cmath>

#include "fastpath/predicates/filter.h"

namespace clues::fastpath {

// u of float and double: half the distance from 1 to the next number.
inline constexpr double kFloatUnit = 0x1p-24, kDoubleUnit = 0x1p-53;

// x -> (x - center) * scale, scale a power of two. Exact local coordinates of points of the scene's box are in [-1,1].
struct LocalFrame {
  Point center{};
  double scale = 1;

  // Rounded twice: one relative 2^-53 by the difference; the product is exact unless it underflows, which costs 2^-1075 at most. So
  // |to_local(x) - exact| <= 2^-53 |exact| + 2^-1074.
  double to_local(double x, std::size_t axis) const { return (x - center[axis]) * scale; }

  // lowest, highest: the box of the scene, finite.
  static LocalFrame of_box(const Point& lowest, const Point& highest) {
    LocalFrame frame;
    double extent = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      frame.center[i] = lowest[i] / 2 + highest[i] / 2;
      extent = std::fmax(extent, std::fmax(highest[i] - frame.center[i], frame.center[i] - lowest[i]));
    }
    // ilogb(extent) < 1024, and 2^-1025 is still a (subnormal) double. Scenes below 2^-1023 stay smaller than 1: then stage 1 decides
    // nothing. The rounded extent may be 2^-53 too small, so one more binary digit is left free.
    if (extent > 0) frame.scale = std::ldexp(1.0, std::min(1023, -std::ilogb(extent) - 1));
    return frame;
  }
};

// The largest float <= x, the least float >= x; x in the range of float.
inline float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafter(f, -INFINITY);
}
inline float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) >= x ? f : std::nextafter(f, INFINITY);
}

}  // namespace clues::fastpath
