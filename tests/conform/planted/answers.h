// Wrong (and two right) ways to a potentially visible set, as people really write them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validate/conform/protocol.h"

namespace clues::planted {

using Ids = std::vector<std::uint32_t>;

// Modes: reference, everything-visible, everything-hidden, hides-one, from-centre, random-rays, float32, cell-shrunk, drops-small. Throws
// std::invalid_argument for any other.
Ids answer(const std::string& mode, const validate::Request& request);
bool is_method(const std::string& mode);

}  // namespace clues::planted
