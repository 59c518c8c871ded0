// What the bits of a shader say, as far as the question is what light passes.
#pragma once

#include <cstdint>

#include "scene/levels/bsp_file.h"

namespace clues::scene {

namespace bsp_surface {
inline constexpr std::uint32_t no_draw = 0x80, hint = 0x100, skip = 0x200, non_solid = 0x4000, light_filter = 0x8000,
                               alpha_shadow = 0x10000;
}
namespace bsp_contents {
inline constexpr std::uint32_t solid = 0x1, detail = 0x8000000, translucent = 0x20000000;
}

inline bool is_drawn(const BspFile::Shader& shader) {
  return (shader.surface & (bsp_surface::no_draw | bsp_surface::hint | bsp_surface::skip)) == 0;
}

// D22: known to be opaque. Solid, and none of the bits by which a mapper says that light passes.
inline bool is_opaque(const BspFile::Shader& shader) {
  return (shader.contents & bsp_contents::solid) != 0 && (shader.contents & bsp_contents::translucent) == 0 &&
         (shader.surface & (bsp_surface::non_solid | bsp_surface::light_filter | bsp_surface::alpha_shadow)) == 0;
}

// A brush that the compiler of the level took for a wall when it made its visibility: opaque and not marked as detail.
inline bool is_structural(const BspFile::Shader& shader) {
  return is_opaque(shader) && (shader.contents & bsp_contents::detail) == 0;
}

}  // namespace clues::scene
