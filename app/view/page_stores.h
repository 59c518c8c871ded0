// Of files that are read as a whole, what a page needs and cannot find out by itself: the lists of a bake, and how long the bounds of a walk last.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/bakes/bake_store.h"

namespace clues::app {

// A finished bake as JSON ("clues-bake-page/1", docs/viewer.md). `sha256` of its scene is compared by the caller. Throws Error as FinishedBake. O(cells * triangles).
nlohmann::json bake_for_page(const scene::FinishedBake& bake);

// A list as lengths of runs, first of those that are not in it: numbers of 7 bits a byte, the lowest first, 128 added where another follows; base64.
std::string run_lengths(const std::vector<std::uint32_t>& list, std::uint32_t triangles);

// Of every frame one byte for each triangle, in order, in base64: how much of its bound (D29; facing, edges and separations, as the fast path has them, computed where it
// was used up or the triangle is new) is left at this viewpoint, as the least b below 7 with bound < step * 4^(b - 1), or 7; 64 is added where it had been used up by the
// way. `step`: the mean of all steps. Throws Error as WalkReader; malformed for a walk without frames. O(size of all frames).
nlohmann::json walk_for_page(const std::filesystem::path& file);

}  // namespace clues::app
