// The seed of random tests. Whoever wants other scenes changes it here.
#pragma once

#include <cstdint>

namespace clues {

inline constexpr std::uint64_t kSeed = 20261121;

}  // namespace clues
