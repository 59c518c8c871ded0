// A colour for each base triangle, the same in all pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace clues::app {

// Red, green, blue, from 0 to 255. Neighbouring numbers get colours far apart.
inline std::array<std::uint32_t, 3> patch_colour(std::uint32_t number) {
  const double hue = std::fmod(0.618033988749895 * number, 1.0) * 6,
               shade = number % 3 == 0 ? 1.0 : (number % 3 == 1 ? 0.8 : 0.6);
  const double x = 1 - std::abs(std::fmod(hue, 2.0) - 1);
  const std::array<std::array<double, 3>, 6> wheel{{{1, x, 0}, {x, 1, 0}, {0, 1, x}, {0, x, 1}, {x, 0, 1}, {1, 0, x}}};
  std::array<std::uint32_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = static_cast<std::uint32_t>(255 * shade * (0.25 + 0.75 * wheel[static_cast<std::size_t>(hue) % 6][i]));
  }
  return out;
}

}  // namespace clues::app
