// The judges, put to maps of random scenes: of the reference they find nothing, of a wrong one (tests/planted) they must.
#pragma once

#include <cstdint>

namespace clues::test {

// The number of contradictions, two walks included, over scenes of all kinds; stops at the first scene that has one.
std::uint64_t contradictions_in_random_scenes(std::uint64_t per_kind);

}  // namespace clues::test
