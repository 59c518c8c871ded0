// The subject "levels": lists of cells in whole levels, given or made, as `clues bake` makes them (D22), searched by sight lines.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "fastpath/visibility/see_through.h"
#include "fuzz/trials/trial.h"

namespace clues::fuzz {

// What lists the triangles that count and may be seen from a cell; ascending.
using LevelLister = std::function<std::vector<std::uint32_t>(const fastpath::SeeThroughScene& scene,
                                                             const std::vector<scene::Point>& cell)>;

// Sight lines of one case, where nobody says how many.
inline constexpr std::uint64_t lines_of_a_level = 4096;

std::unique_ptr<Trial> make_levels_trial(std::uint64_t lines = lines_of_a_level);
// Of lists that are not ours: tests plant mistakes so.
std::unique_ptr<Trial> make_levels_trial(std::uint64_t lines, LevelLister lister);

}  // namespace clues::fuzz
