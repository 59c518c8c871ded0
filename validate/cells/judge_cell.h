// D19, D23 for one cell of many: which triangles are missing from a list that somebody baked? The fast kernel says what may be seen: what is in its list and not in the other is
// in question, and nothing else is. A triangle in question is a *hole* only with a sight line that exact/sight/witness.h has confirmed against all that blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fastpath/visibility/see_through.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

struct CellJudgement {
  std::vector<std::uint32_t> may_be_seen;  // counting triangles in the fast kernel's list for this cell, ascending
  std::uint64_t listed = 0;                // by the list that is judged
  std::uint64_t witnessed = 0;             // of those that may be seen: with a free sight line, decided exactly
  std::vector<Witness> holes;              // missing and visible, ascending by triangle
  std::vector<std::uint32_t> undecided;    // missing, and no sight line was confirmed, ascending
  // Missing, and a sight line was confirmed that is longer than the far plane is away, while no shorter one was found, not even a doubtful one; ascending by triangle.
  std::vector<Witness> beyond;
  std::vector<Witness> contradictions;  // hidden, says the kernel, and yet with a confirmed sight line. Must stay empty
  std::uint64_t sight_lines = 0;        // decided exactly
  std::uint64_t fallbacks = 0;          // of the kernel
  bool by_lines_alone = false;          // nobody knows what else may be seen
};

// What a sight line that accuses somebody has to pass besides.
struct Accuser {
  std::function<bool(const Witness&)> accuses;  // asked before the witness checker, from any thread; none: nothing else
  double far_plane = 0;  // the list does not claim to hold what is farther away; 0: it does. Longer lines accuse nobody
};

// `list` is ascending. The cell is W_in: who is accused of a hole has one. The same answer in every run and for any number of threads of the current arena.
CellJudgement judge_cell(const fastpath::SeeThroughScene& scene, const std::vector<scene::Point>& cell,
                         const std::vector<std::uint32_t>& list, const Accuser& accuser = {});

// Without the kernel: what sight lines find, from neighbour to neighbour, is witnessed, and what of it is not listed in question. Much faster; it finds most holes, and proves nothing where
// it finds none. Undecided is what was found and not confirmed. Lines begin in the cell but for roundings, and only what is missing is confirmed: of a flat cell that is tilted, or one of some ulps,
// a triangle may be witnessed that is listed and not visible. Contradictions are not looked for.
CellJudgement search_cell(const fastpath::SeeThroughScene& scene, const std::vector<scene::Point>& cell,
                          const std::vector<std::uint32_t>& list, const Accuser& accuser = {});

}  // namespace clues::validate
