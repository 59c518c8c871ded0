// The three kinds of wedges, as definition.md numbers them.
#pragma once

#include <cstdint>

namespace clues::fastpath {

enum class PieceKind : std::uint8_t { sv_me, se_me, se_mv };  // D10, D11, D12

}  // namespace clues::fastpath
