// FIGS. 48A, 48B: will it be late? How long a viewer needs at least until he can be in a cell, as a proved lower bound; how
// long the data of the cell need; and what to do if that is longer: less detail, or less speed. All rational; roots are
// avoided by comparing squares.
//
// A viewer who moves at speed u comes, with acceleration a up to his limit v, at most as far as farthest_in(t): u t + a t^2
// / 2 until he has reached v, and v t less (v - u)^2 / (2 a) from then on. From rest at distance d that is t = sqrt(2 d / a)
// for d <= v^2 / (2 a), else d / v + v / (2 a). A time t is a lower bound of his arrival if farthest_in(t)^2 <= d^2.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"

namespace clues::reference {

// In units of the scene and seconds; both positive.
struct Agility {
  exact::FT speed_limit, acceleration;
};

// Speed from 0 to the limit.
exact::FT farthest_in(const exact::FT& time, const exact::FT& speed, const Agility& agility);

// Not more than the squared distance from the point to the cell (of dimension 3), by the planes of its sides: the distance
// itself where the nearest point lies inside of a side. 0: the point is in the cell.
exact::FT squared_distance_bound(const exact::Point3& from, const exact::ConvexCell& cell);

// The largest multiple of 2^-20 s in which nobody comes that far, at most 2^20 s.
exact::FT penetration_time(const exact::FT& squared_distance, const exact::FT& speed, const Agility& agility);

// So many bytes over a link: behind what waits there already, and then the way.
exact::FT transmit_time(std::uint64_t bytes, std::uint64_t waiting, std::uint64_t bytes_per_second,
                        const exact::FT& latency);

// FIG. 48A: of the same data in several sizes, the most detailed first, the first that is there in time; the last if none
// is. `late` is set then.
std::size_t detail_in_time(const std::vector<std::uint64_t>& sizes, std::uint64_t waiting,
                           std::uint64_t bytes_per_second, const exact::FT& latency, const exact::FT& penetration,
                           bool& late);

// FIG. 48B: the largest 1024th part of the speed limit at which that distance takes so long, or longer.
exact::FT speed_in_time(const exact::FT& squared_distance, const exact::FT& time, const exact::FT& speed_limit);

}  // namespace clues::reference
