// What a list denies, looked for by sight lines in a scene with flags (D22) of any size. Each line is decided exactly; what one shows is a claim that
// exact/sight/witness.h confirms in rationals against all that blocks, or a contradiction.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fastpath/visibility/see_through.h"
#include "fuzz/findings/finding.h"
#include "fuzz/generators/random.h"
#include "validate/verdicts/judge.h"

namespace clues::fuzz {

struct DeniedSight {
  std::uint32_t triangle = 0;
  std::optional<validate::Witness> witness;  // none: it meets the cell (D3)
  std::string aim;                           // where the line was aimed at
};

// A triangle that counts, is not in `list` (ascending), and is visible from the cell. First those that meet the cell; then `lines` sight lines from inner points of the cell: through vertices of what is
// denied, beside its edges and to inner points of it, and beside edges of what is listed, off by nothing, an ulp or 2^-10 to 2^-40. Triangles that share a vertex with a listed one are
// aimed at more often. Counts what it does. O(lines log n); a claim O(n).
std::optional<DeniedSight> find_denied_sight(const fastpath::SeeThroughScene& scene,
                                             const std::vector<scene::Point>& cell,
                                             const std::vector<std::uint32_t>& list, std::uint64_t lines, Random random,
                                             Outcome& outcome);

}  // namespace clues::fuzz
