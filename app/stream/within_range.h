// What works on scenes as they are, not moved into the standard range (exact/cell/standard_range.h), refuses those that the
// library's arrangements in it cannot take: from 2^340 on these ended in crashes, or lost what is visible.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"
#include "scene/messages/error.h"

namespace clues::app {

inline void require_within_range(const std::string& what, const std::vector<scene::Point>& points) {
  constexpr double most = 0x1p256;
  for (const auto& p : points) {
    if (std::any_of(p.begin(), p.end(), [](double x) { return std::fabs(x) > most; }))
      throw scene::Error(scene::ErrorCode::unsupported,
                         what +
                             ": has coordinates beyond 2^256 (about 1e77), which this command does not take; scale "
                             "scene and cells by a power of two");
  }
}

}  // namespace clues::app
