// Rays from the cell that look for triangles which may be visible, for a first guess: nothing is proved by them, and every answer is only a list of
// first hits. A ray that just passes the edge of a triangle known to be seen finds what is next to it in the picture; so what is seen spreads from
// neighbour to neighbour, and small or distant triangles are met for a few rays each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "exact/dials.h"
#include "fastpath/predicates/cell.h"
#include "fastpath/queries/bvh.h"

namespace clues::fastpath {

class SightRays {
 public:
  // Keeps references. The same answers in every run and for any number of threads. `budget`: no more rays than this in all (Dials); those left out hit nothing.
  SightRays(const Bvh& bvh, const Cell& cell, std::int64_t budget = exact::Dials::kOwn)
      : bvh_(bvh), cell_(cell), budget_(budget) {}
  // No triangle is near the cell: so none needs to be asked which part of it is in int V (D3).
  void cell_is_empty() { cell_is_empty_ = true; }

  // First hits of `count` rays spread evenly over all directions, others each time.
  std::vector<std::uint32_t> around(std::size_t count, std::size_t time);
  // First hits of rays that pass each of the triangles closely, edge by edge.
  std::vector<std::uint32_t> beside(std::span<const std::uint32_t> triangles);
  // Tells take(triangle, ray) of what rays all around meet first, ray() being the one that met it. Where it answers true, what is next to the triangle is looked for, and what is next to that.
  // Then all around again, in other directions, up to kTimes while it takes what is met.
  template <class Take>
  void look_around(const Take& take);
  // The same of what is next to these.
  template <class Take>
  void look_beside(std::vector<std::uint32_t> triangles, const Take& take);
  // First hits on the way to each of the triangles, up to it: kTowards for each, kNothing where nothing is in front.
  static constexpr std::size_t kTowards = 4;
  static constexpr std::uint32_t kNothing = ~0U;
  std::vector<std::uint32_t> towards(std::span<const std::uint32_t> triangles);
  // For each triangle of the tree whether such a ray meets it before it gets there; kMetTowards of them for each that is asked about.
  static constexpr std::size_t kMetTowards = 16;
  std::vector<std::uint8_t> met_towards(std::span<const std::uint32_t> triangles);

  std::uint64_t count() const { return count_; }

 private:
  static constexpr std::size_t kRays = 4096, kTimes = 6;

  // The ray number i of around(count, time) and of beside(triangles).
  Segment ray_around(std::size_t i, std::size_t count, std::size_t time) const;
  Segment ray_beside(std::span<const std::uint32_t> triangles, std::size_t i) const;
  // The triangles that are taken.
  template <class Take, class RayOf>
  static std::vector<std::uint32_t> taken(const std::vector<std::uint32_t>& met, const Take& take, const RayOf& ray_of);
  Segment ray_towards(std::uint32_t triangle, std::size_t number, std::size_t of, std::uint64_t purpose) const;
  std::size_t within_budget(std::size_t count);
  template <class RayOf>
  std::vector<std::uint32_t> first_hits(std::size_t count, const RayOf& ray_of);

  const Bvh& bvh_;
  const Cell& cell_;
  std::int64_t budget_;
  bool cell_is_empty_ = false;
  std::uint64_t count_ = 0;
};

template <class Take, class RayOf>
std::vector<std::uint32_t> SightRays::taken(const std::vector<std::uint32_t>& met, const Take& take,
                                            const RayOf& ray_of) {
  std::vector<std::uint32_t> all;
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (met[i] != kNothing && take(met[i], [&] { return ray_of(i); })) all.push_back(met[i]);
  }
  return all;
}

template <class Take>
void SightRays::look_beside(std::vector<std::uint32_t> triangles, const Take& take) {
  while (!triangles.empty())
    triangles = taken(beside(triangles), take, [&](std::size_t i) { return ray_beside(triangles, i); });
}

template <class Take>
void SightRays::look_around(const Take& take) {
  const std::size_t count = std::min(bvh_.mesh().triangles.size(), kRays);
  for (std::size_t time = 0; time < kTimes; ++time) {
    auto fresh = taken(around(count, time), take, [&](std::size_t i) { return ray_around(i, count, time); });
    if (fresh.empty()) break;
    look_beside(std::move(fresh), take);
  }
}

// What rays find, from neighbour to neighbour: each triangle once, in the order in which it is found, with the ray that meets it first, which begins in the cell but for roundings.
struct Sights {
  std::vector<std::uint32_t> triangles;
  std::vector<Segment> rays;
  std::uint64_t shot = 0;
};

// The same for any number of threads of the current arena.
Sights sights_from(const Bvh& bvh, const Cell& cell);

}  // namespace clues::fastpath
