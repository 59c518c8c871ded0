// The way of a viewpoint, frame by frame: a file, a circle or a way along corners.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/motion/depth_mesh.h"

namespace clues::scene {

// `spec` is one of
//   orbit:x,y,z,r[,turns]   around x,y,z at distance r, in the plane across the z axis, from +x on; turns: 1, or any number
//   walk:x,y,z:x,y,z[:...]  along these corners, equally far in each frame
//   FILE                    x y z a line, # comments
// The viewpoints: the first, and one more for each frame. `frames`: of a circle or corners 600 if not given; of a file all of its lines, or the first so many.
// Throws Error: bad_argument for what cannot be meant, malformed and non_finite with file and line, file_not_found, file_unreadable.
std::vector<MotionPoint> read_view_path(const std::string& spec, std::optional<std::uint64_t> frames);

}  // namespace clues::scene
