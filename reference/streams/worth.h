// FIGS. 33 C, D: a packet that is hardly worth sending. Where little becomes visible from one cell to the next, the first
// cell is given it as well: nothing is sent on that way any more, and the client holds a little more than it sees.
//
// Hazard A-24: that changes what must be there in the first cell whichever way the viewer came, and so other packets,
// which may become worth sending, or not worth it. So lists are grown until no packet is dropped any more. They only grow,
// and end at the union of all; each holds what it held, so a stream of them is sound on every route.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace clues::reference {

struct Dropping {
  std::vector<std::vector<std::uint32_t>> lists;        // grown, ascending
  std::uint64_t packets_before = 0, packets_after = 0;  // transitions with a packet `+`
  std::uint64_t given_up = 0;                           // triangles that lists have more, over all cells
  std::uint64_t rounds = 0;
};

// Whether to drop the packet that has these triangles; asked again and again.
using NotWorthIt = std::function<bool(const std::vector<std::uint32_t>& plus)>;

// `lists`: of each cell, ascending. In a round all packets are asked about the lists as they were before it, so it does
// not matter how the cells are numbered. O(rounds * transitions * list).
Dropping without_poor_packets(std::vector<std::vector<std::uint32_t>> lists,
                              const std::vector<std::vector<std::uint32_t>>& neighbours, const NotWorthIt& poor);

}  // namespace clues::reference
