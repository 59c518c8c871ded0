// One star in arrays of fixed length: a vertex that may be removed has fewer than 12 neighbours (D31).
#pragma once

#include <array>
#include <functional>
#include <span>

#include "exact/multires/star_rules.h"
#include "fastpath/multires/domain.h"

namespace clues::fastpath::multires {

inline constexpr std::size_t most_neighbours = 11;

struct SurfaceStar {
  std::uint32_t vertex = 0;
  scene::StarKind kind = scene::StarKind::interior;
  std::uint32_t across = 0;  // feature: the place in the ring of the second tagged edge
  std::size_t size = 0, sectors = 0;
  // As in scene::Removal; triangle k lies between ring vertices k and k + 1.
  std::array<std::uint32_t, most_neighbours> ring_, triangles_;

  std::span<const std::uint32_t> ring() const { return {ring_.data(), size}; }
  std::span<const std::uint32_t> triangles() const { return {triangles_.data(), sectors}; }
};

// Whether it has few enough neighbours.
bool is_low(const Domain& domain, std::uint32_t vertex);
// Of a low vertex; `tagged`: the other ends of its features, or no_vertex.
SurfaceStar star_of(const Domain& domain, std::uint32_t vertex, const std::array<std::uint32_t, 2>& tagged);

struct DiskLayout {
  std::array<exact::DiskPoint, most_neighbours> ring_;
  std::span<exact::DiskPoint> of(const SurfaceStar& star) { return {ring_.data(), star.size}; }
  std::span<const exact::DiskPoint> of(const SurfaceStar& star) const { return {ring_.data(), star.size}; }
};
// D32: every sector turns counter-clockwise, and together they go round once (half round; on each side).
bool is_embedded(const SurfaceStar& star, const DiskLayout& layout);

// Which ring vertices, by place, are joined by an edge.
using RingEdges = std::array<std::uint16_t, most_neighbours>;
RingEdges ring_edges(const Domain& domain, const SurfaceStar& star);

// The triangles that close the hole, ascending, each from its lowest corner.
struct HoleCover {
  std::size_t size = 0;
  std::array<scene::Triangle, most_neighbours> triangles_;
  std::span<const scene::Triangle> triangles() const { return {triangles_.data(), size}; }
};
// Delaunay but for edges that are there already; of corners on one circle the diagonal at the lowest number. False: there is none. `sure`: doubles may be
// asked.
bool cover_hole(const SurfaceStar& star, const DiskLayout& layout, const RingEdges& joined, bool sure,
                HoleCover& cover);

}  // namespace clues::fastpath::multires
