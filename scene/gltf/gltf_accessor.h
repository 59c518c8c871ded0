// The numbers that an accessor names: positions, which are floats and become doubles without rounding, and indices.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf/gltf_document.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

// More than so many points or indices are refused: a few bytes can ask for any number of them.
inline constexpr std::uint64_t most_elements = std::uint64_t{1} << 26;
inline constexpr std::uint64_t most_unbacked_elements = std::uint64_t{1}
                                                        << 20;  // without bytes of their own: zeros, or sparse values

// Sparse values are put in. Throws Error: malformed (another type, past the end of its buffer view), non_finite, unsupported (quantized).
std::vector<Point> read_positions(GltfDocument& document, std::uint32_t accessor);
std::vector<std::uint32_t> read_indices(GltfDocument& document, std::uint32_t accessor);

// How many elements an accessor says it has; within the limits above.
std::uint64_t element_count(const GltfDocument& document, std::uint32_t accessor);

}  // namespace clues::scene
