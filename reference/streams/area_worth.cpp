#include "reference/streams/area_worth.h"

#include <bit>
#include <limits>

#include "exact/last_where.h"
#include "reference/streams/stream_server.h"
#include "scene/stream/packets.h"

namespace clues::reference {

using exact::FT;

std::optional<double> root_above(const FT& square) {
  if (square <= 0) return 0.0;
  const auto is_above = [&](std::uint64_t bits) {
    const FT x(std::bit_cast<double>(bits));
    return x * x >= square;
  };
  const auto most = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::max());
  if (!is_above(most)) return {};
  return std::bit_cast<double>(exact::last_where(0, most, [&](std::uint64_t bits) { return !is_above(bits); }) + 1);
}

const std::optional<FT>& AreaWorth::area_of_one(std::uint32_t triangle) const {
  Known& at = areas_[triangle];
  if (!at.known) {
    const auto& [a, b, c] = mesh_->triangles[triangle];
    const exact::Point3 o = exact::to_exact(mesh_->points[a]);
    const exact::Vector3 normal =
        CGAL::cross_product(exact::to_exact(mesh_->points[b]) - o, exact::to_exact(mesh_->points[c]) - o);
    if (const auto root = root_above(exact::collapsed(normal.squared_length() / 4))) at.area = FT(*root);
    at.known = true;
  }
  return at.area;
}

std::optional<FT> AreaWorth::area_of(const std::vector<std::uint32_t>& triangles) const {
  FT sum(0);
  for (const std::uint32_t t : triangles) {
    const auto& area = area_of_one(t);
    if (!area) return {};
    sum += *area;
  }
  return exact::collapsed(sum);
}

std::optional<FT> AreaWorth::area_of(const Delta& delta, SeenFrom seen) const {
  FT sum(0);
  for (const UnifiedRegion& r : delta.regions) {
    if (r.seen != seen) continue;
    const auto& area = area_of_one(r.side.triangle);
    if (!area) return {};
    sum += *area * r.area_fraction;
  }
  return exact::collapsed(sum);
}

std::uint64_t AreaWorth::bytes_of_plus(const std::vector<std::uint32_t>& triangles) const {
  return scene::to_packet(DisplayList(*mesh_).plus(triangles)).size();
}

std::uint64_t AreaWorth::bytes_of_minus(const std::vector<std::uint32_t>& triangles) const {
  DisplayList list(*mesh_);
  list.plus(triangles);
  return scene::to_packet(list.minus(triangles)).size();
}

bool AreaWorth::is_poor(const std::vector<std::uint32_t>& plus, const FT& area_of_a_byte) const {
  const auto area = area_of(plus);
  return area && *area < area_of_a_byte * FT(static_cast<double>(bytes_of_plus(plus)));
}

PlusTotals plus_totals(const AreaWorth& worth, const std::vector<std::vector<std::uint32_t>>& lists,
                       const std::vector<std::vector<std::uint32_t>>& neighbours) {
  PlusTotals totals;
  for (std::size_t a = 0; a < lists.size(); ++a) {
    for (const std::uint32_t b : neighbours[a]) {
      const auto plus = packets_of(lists[a], lists[b]).plus;
      if (plus.empty()) continue;
      ++totals.packets;
      totals.triangles += plus.size();
      totals.bytes += worth.bytes_of_plus(plus);
    }
  }
  return totals;
}

}  // namespace clues::reference
