#pragma once

#include <cstdint>

namespace clues::fastpath {

// What is known of a whole set of points (one_label.h). visible: or counted as such. elsewhere: nothing, as a wedge piece may touch the place where it was asked.
enum class SetLabel : std::uint8_t { hidden, visible, elsewhere };

}  // namespace clues::fastpath
