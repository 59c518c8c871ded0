#pragma once

#include "fastpath/predicates/filter.h"
#include "scene/mesh/bounds.h"

namespace clues::fastpath {

using Box = scene::Bounds;

// A double in each coordinate, inside the box.
inline Point middle_of(const Box& b) {
  return {b.low[0] / 2 + b.high[0] / 2, b.low[1] / 2 + b.high[1] / 2, b.low[2] / 2 + b.high[2] / 2};
}

}  // namespace clues::fastpath
