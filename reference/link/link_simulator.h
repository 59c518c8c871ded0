// FIG. 50B and the faults of D25: a stream over a link with a bandwidth, a latency and connections that are lost, as it
// is seen by a viewer who walks: when does what he needs arrive, and how long does he stand on the face to the next
// cell? He never goes on without it, so there are stalls and no holes. Server and client are the real ones; only the
// clock is not. All in whole microseconds, and the same for the same seed.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/kernel.h"
#include "reference/streams/stream_server.h"

namespace clues::reference {

struct Link {
  std::uint64_t bytes_per_second = 1000000;  // to the client; requests are short
  std::uint64_t latency_us = 0;              // one way
  std::uint32_t losses_per_million = 0;      // packets with which the connection is lost; they do not arrive
  std::uint64_t outage_us = 0;               // from then until there is another
  std::uint64_t seed = 1;
};

// When the viewer gets to a cell if he never has to wait; ascending.
struct TimedStep {
  std::uint64_t reached_us = 0;
  std::uint32_t cell = 0;
  std::uint64_t stays_us = 0;  // in this cell at least, as far as the server can know (penetration.h)
};

struct LinkReport {
  std::vector<scene::StreamMessage> messages;  // as they arrived
  std::uint64_t stalls = 0, stalled_us = 0, longest_us = 0;
  std::uint64_t packets = 0, bytes = 0, losses = 0;  // sent, lost ones included
  // FIG. 48B: had he walked at this part of his speed from where he asked on, he would not have stood still on any face
  // but the first. In 1024ths, rounded down. 0: he asks on the face, where there is no way left to go slower on.
  exact::FT slowest{1};
  // With Pace::regulated: steps on which he was slowed down, the least part of his speed, and how much longer it took.
  std::uint64_t slowed = 0, slowed_us = 0;
  exact::FT least_speed{1};
  std::vector<std::uint64_t> steps_on_level;  // of the tree of cells
  std::uint64_t held = 0, seen = 0;           // triangles after each step, and of them those that the cell lists
};

// How much a server with a tree of cells sends in advance.
enum class NodeChoice : std::uint8_t { coarsest, in_time };

// FIG. 48B. When he asks for a cell the server knows when its data will be there if no packet is lost. Where that is after
// he would get to the face, it tells him, and from when he hears of it he walks at the 1024th part of his speed, rounded
// down, at which he gets there with them. So he stands still only where packets are lost, or where he hears of it at the
// face or later.
enum class Pace : std::uint8_t { steady, regulated };

// He asks for a cell `ahead_us` before he gets there. That is sound where he is then no more steps behind than the
// horizon of the store has: what he sees from the cell that he is still in stays. Between two connections the server
// forgets everything.
//
// FIG. 48A and the small packets of the text: with NodeChoice::in_time the server takes of the nodes around a cell, the
// coarsest first, the first whose data are sent before the viewer can ask for another cell; else the cell with what its
// horizon needs, which may be late.
LinkReport walk_over(const StreamStore& store, const std::vector<TimedStep>& steps, const Link& link,
                     std::uint64_t ahead_us, NodeChoice choice = NodeChoice::coarsest, Pace pace = Pace::steady);

}  // namespace clues::reference
