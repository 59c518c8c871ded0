// Any bytes as a small scene with its cell, for coverage-guided fuzzing: a short change of the bytes is a small change of the scene.
//
//   1 byte    points of the mesh, 3 to 12
//   1 byte    triangles, 1 to 4
//   1 byte    points of the cell, 1 to 8
//   6 each    all these points: three 16-bit numbers, low byte first, in sixteenths
//   3 each    the triangles: corners, modulo the number of points
//   2 each    to the end: a coordinate (modulo their number) that is moved by so many ulps (signed)
//
// What is missing at the end counts as 0.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fuzz/findings/finding.h"

namespace clues::fuzz {

Case scene_of_bytes(std::string_view bytes);

// Bytes of a scene within these bounds whose coordinates are sixteenths below 2048; else none.
std::optional<std::string> bytes_of_scene(const Case& scene);

}  // namespace clues::fuzz
