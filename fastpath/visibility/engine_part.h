// The closure (closure.h) with the engine (local_map.h) as the maker of its maps.
#pragma once

#include <span>
#include <vector>

#include "exact/complex/cut_memory.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/closure/closure.h"
#include "fastpath/visibility/map/local_map.h"

namespace clues::fastpath {

struct ClosedScene {
  Closure closure;

  const LocalMap* map() const;      // none: all were given up
  std::uint64_t fallbacks() const;  // what is unproved are some, too
};

// The box of the scene, widened by far more than what boxes and points of the closure may be off.
Box outside_of(const Bvh& bvh);

// `outside`: all places that the map will be asked about. `memory`: of the tree's scene, without a cell.
ClosedScene close_by_engine(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                            const Box& outside, exact::CutMemory& memory, std::span<const std::uint32_t> guess = {},
                            std::span<const std::uint8_t> counting = {}, Wanted wanted = Wanted::map);

}  // namespace clues::fastpath
