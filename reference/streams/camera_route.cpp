#include "reference/streams/camera_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using exact::FT;

// The part of a segment in a cell: from and to, 0 at its beginning and 1 at its end.
struct Stay {
  FT from, to;
};

std::optional<Stay> stay_in(const exact::ConvexCell& cell, const exact::Point3& p, const exact::Point3& q) {
  Stay stay{FT(0), FT(1)};
  for (const exact::CellFacet& side : cell.facets()) {
    const FT begins = exact::value_at(side.plane, p), ends = exact::value_at(side.plane, q);
    if (begins <= 0 && ends <= 0) continue;
    if (begins > 0 && ends > 0) return std::nullopt;
    const FT crosses = begins / (begins - ends);
    if (begins > 0) {
      stay.from = std::max(stay.from, crosses);
    } else {
      stay.to = std::min(stay.to, crosses);
    }
  }
  if (stay.from > stay.to) return std::nullopt;
  return stay;
}

// From neighbour to neighbour among cells that hold the point; `from` is not in the answer. The shortest way.
std::vector<std::uint32_t> way_at(const std::vector<exact::ConvexCell>& cells,
                                  const std::vector<std::vector<std::uint32_t>>& neighbours, const exact::Point3& at,
                                  std::uint32_t from, std::uint32_t to) {
  std::map<std::uint32_t, std::uint32_t> before{{from, from}};
  std::vector<std::uint32_t> queue{from};
  for (std::size_t i = 0; i < queue.size() && !before.contains(to); ++i) {
    for (const std::uint32_t n : neighbours[queue[i]]) {
      if (!before.contains(n) && cells[n].contains(at)) {
        before[n] = queue[i];
        queue.push_back(n);
      }
    }
  }
  if (!before.contains(to)) return {};
  std::vector<std::uint32_t> way;
  for (std::uint32_t c = to; c != from; c = before[c]) way.push_back(c);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace

std::vector<std::uint32_t> camera_route(const std::vector<exact::ConvexCell>& cells,
                                        const std::vector<std::vector<std::uint32_t>>& neighbours,
                                        const std::vector<exact::Point3>& path) {
  std::vector<std::uint32_t> route;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const exact::Point3 &p = path[i], &q = path[std::min(i + 1, path.size() - 1)];
    std::vector<std::pair<std::uint32_t, Stay>> stays;
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
      if (const auto stay = stay_in(cells[c], p, q)) stays.emplace_back(c, *stay);
    }
    FT now(0);
    const auto longest = [&]() -> const std::pair<std::uint32_t, Stay>* {
      const std::pair<std::uint32_t, Stay>* best = nullptr;
      for (const auto& one : stays) {
        if (one.second.from <= now && (best == nullptr || one.second.to > best->second.to)) best = &one;
      }
      return best;
    };
    while (true) {
      const auto here = std::find_if(stays.begin(), stays.end(),
                                     [&](const auto& one) { return !route.empty() && one.first == route.back(); });
      if (here != stays.end()) now = std::max(now, here->second.to);
      if (here != stays.end() && now == 1) break;
      const auto* next = longest();
      std::vector<std::uint32_t> way;
      if (next != nullptr && (route.empty() || next->second.to > now)) {
        const exact::Point3 at = p + (q - p) * now;
        way = route.empty() ? std::vector<std::uint32_t>{next->first}
                            : way_at(cells, neighbours, at, route.back(), next->first);
      }
      if (way.empty())
        throw scene::Error(scene::ErrorCode::bad_argument,
                           fmt::format("the path leaves the cells behind point {}, near {} {} {}", i,
                                       CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
      route.insert(route.end(), way.begin(), way.end());
    }
  }
  return route;
}

}  // namespace clues::reference
