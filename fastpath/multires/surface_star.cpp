#include "fastpath/multires/surface_star.h"

#include <algorithm>

#include "fastpath/multires/grid_signs.h"

namespace clues::fastpath::multires {

bool is_low(const Domain& domain, std::uint32_t vertex) {
  return domain.star(vertex).size() + (domain.is_open(vertex) ? 1U : 0U) <= most_neighbours;
}

SurfaceStar star_of(const Domain& domain, std::uint32_t vertex, const std::array<std::uint32_t, 2>& tagged) {
  struct Spoke {
    std::uint32_t from, to, triangle;
  };
  std::array<Spoke, most_neighbours> spokes;
  const auto around = domain.star(vertex);
  const std::size_t n = around.size();
  SurfaceStar star;
  star.vertex = vertex;
  star.sectors = n;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& t = domain.triangles()[around[i]];
    const std::size_t k = t[0] == vertex ? 0 : (t[1] == vertex ? 1 : 2);
    spokes[i] = {t[(k + 1) % 3], t[(k + 2) % 3], around[i]};
  }
  std::size_t first = 0;
  if (domain.is_open(vertex)) {
    star.kind = scene::StarKind::boundary;
    const auto led_to = [&](std::uint32_t v) {
      return std::any_of(spokes.begin(), spokes.begin() + static_cast<std::ptrdiff_t>(n),
                         [&](const Spoke& s) { return s.to == v; });
    };
    while (led_to(spokes[first].from)) ++first;
  } else {
    for (std::size_t i = 1; i < n; ++i) {
      if (spokes[i].from < spokes[first].from) first = i;
    }
  }
  std::swap(spokes[0], spokes[first]);
  for (std::size_t i = 0; i < n; ++i) {
    star.ring_[i] = spokes[i].from;
    star.triangles_[i] = spokes[i].triangle;
    for (std::size_t j = i + 1; j < n; ++j) {
      if (spokes[j].from == spokes[i].to) {
        std::swap(spokes[i + 1], spokes[j]);
        break;
      }
    }
  }
  star.size = n;
  if (star.kind == scene::StarKind::boundary) star.ring_[star.size++] = spokes[n - 1].to;
  if (star.kind == scene::StarKind::interior && tagged[0] != scene::no_vertex) {
    star.kind = scene::StarKind::feature;
    const auto ring = star.ring();
    const auto place = [&](std::uint32_t v) { return std::find(ring.begin(), ring.end(), v) - ring.begin(); };
    const auto one = std::min(place(tagged[0]), place(tagged[1])), two = std::max(place(tagged[0]), place(tagged[1]));
    const auto end = static_cast<std::ptrdiff_t>(n);
    std::rotate(star.ring_.begin(), star.ring_.begin() + one, star.ring_.begin() + end);
    std::rotate(star.triangles_.begin(), star.triangles_.begin() + one, star.triangles_.begin() + end);
    star.across = static_cast<std::uint32_t>(two - one);
  }
  return star;
}

bool is_embedded(const SurfaceStar& star, const DiskLayout& layout) {
  const auto ring = layout.of(star);
  const std::size_t n = ring.size();
  int upward = 0;  // across the axis to the right
  for (std::size_t k = 0; k < star.sectors; ++k) {
    const auto &p = ring[k], &q = ring[(k + 1) % n];
    if (p[0] * q[1] - p[1] * q[0] <= 0) return false;
    if (p[1] < 0 && q[1] >= 0) ++upward;
  }
  if (star.kind == scene::StarKind::interior) return upward == 1;
  const bool open = star.kind == scene::StarKind::boundary;
  const auto& last = ring[open ? n - 1 : star.across];
  return upward == (open ? 0 : 1) && ring[0][0] > 0 && ring[0][1] == 0 && last[0] < 0 && last[1] == 0;
}

RingEdges ring_edges(const Domain& domain, const SurfaceStar& star) {
  RingEdges joined{};
  const auto ring = star.ring();
  std::uint64_t seen = 0;  // a bit for each vertex, which others may have, too
  for (const std::uint32_t v : ring) seen |= std::uint64_t{1} << (v & 63U);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (const std::uint32_t number : domain.star(ring[i])) {
      for (const std::uint32_t v : domain.triangles()[number]) {
        if ((seen >> (v & 63U) & 1U) == 0 || v == ring[i] || v == star.vertex) continue;
        for (std::size_t j = 0; j < ring.size(); ++j) {
          if (ring[j] == v) joined[i] = static_cast<std::uint16_t>(joined[i] | (1U << j));
        }
      }
    }
  }
  return joined;
}

}  // namespace clues::fastpath::multires
