#include "reference/link/penetration.h"

#include <algorithm>

namespace clues::reference {

using exact::FT;

namespace {

// The largest i from 0 to `most` for which it holds; it holds for 0, and for no i behind one for which it does not.
template <class Holds>
std::uint64_t last_that(std::uint64_t most, const Holds& holds) {
  std::uint64_t low = 0, high = most;
  while (low < high) {
    const std::uint64_t middle = high - (high - low) / 2;
    if (holds(FT(static_cast<double>(middle)))) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

}  // namespace

FT farthest_in(const FT& time, const FT& speed, const Agility& agility) {
  const FT until_limit = (agility.speed_limit - speed) / agility.acceleration;
  if (time <= until_limit) return time * (speed + agility.acceleration * time / 2);
  return until_limit * (speed + agility.speed_limit) / 2 + (time - until_limit) * agility.speed_limit;
}

FT squared_distance_bound(const exact::Point3& from, const exact::ConvexCell& cell) {
  FT most(0);
  for (const exact::CellFacet& side : cell.facets()) {
    const FT outside = exact::value_at(side.plane, from);
    if (outside > 0) most = std::max(most, FT(outside * outside / side.plane.orthogonal_vector().squared_length()));
  }
  return exact::collapsed(most);
}

FT penetration_time(const FT& squared_distance, const FT& speed, const Agility& agility) {
  constexpr std::uint64_t ticks = std::uint64_t{1} << 20;  // of a second
  const std::uint64_t last = last_that(ticks * ticks, [&](const FT& i) {
    const FT far = exact::collapsed(farthest_in(i / FT(static_cast<double>(ticks)), speed, agility));
    return far * far <= squared_distance;
  });
  return FT(static_cast<double>(last)) / FT(static_cast<double>(ticks));
}

FT transmit_time(std::uint64_t bytes, std::uint64_t waiting, std::uint64_t bytes_per_second, const FT& latency) {
  return FT(static_cast<double>(bytes + waiting)) / FT(static_cast<double>(bytes_per_second)) + latency;
}

std::size_t detail_in_time(const std::vector<std::uint64_t>& sizes, std::uint64_t waiting,
                           std::uint64_t bytes_per_second, const FT& latency, const FT& penetration, bool& late) {
  const auto at = std::find_if(sizes.begin(), sizes.end(), [&](std::uint64_t bytes) {
    return transmit_time(bytes, waiting, bytes_per_second, latency) <= penetration;
  });
  late = at == sizes.end();
  return late ? sizes.size() - 1 : static_cast<std::size_t>(at - sizes.begin());
}

FT speed_in_time(const FT& squared_distance, const FT& time, const FT& speed_limit) {
  constexpr std::uint64_t parts = 1024;
  const FT part = speed_limit / FT(static_cast<double>(parts));
  const std::uint64_t last = last_that(parts, [&](const FT& i) {
    const FT far = i * part * time;
    return far * far <= squared_distance;
  });
  return FT(static_cast<double>(last)) * part;
}

}  // namespace clues::reference
