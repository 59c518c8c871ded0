// A part as percent, for tables.
#pragma once

#include <string>

namespace clues::scene {

// 100 * part / whole with so many decimals; "-" where that is no number (areas past the range of doubles).
std::string percent(double part, double whole, int decimals);

}  // namespace clues::scene
