// Lengths of time as people write them: `90` and `90s` are seconds, `10m` minutes, `2h` hours; decimals are fine.
#pragma once

#include <chrono>
#include <string>

namespace clues::scene {

// Rounded up to a whole millisecond. Throws Error bad_argument, beginning with the name of the option, for anything else, for 0, and for more than `most`.
std::chrono::milliseconds parse_duration(const std::string& option, const std::string& text,
                                         std::chrono::hours most = std::chrono::hours(24 * 365));

}  // namespace clues::scene
