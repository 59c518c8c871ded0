// The rules of D31 and D32 that are stated in doubles: the order in which vertices are looked at, and where a star is proposed to be laid out.
// They claim nothing, since whatever they say is decided upon by signs afterwards; but each rounding counts if two programs are to make the
// same hierarchy. So they stand here once, for the reference and the fast path. Compiled as written (no contraction, no reordering).
#pragma once

#include <boost/container/small_vector.hpp>
#include <span>
#include <vector>

#include "exact/multires/grid.h"

namespace clues::exact {

// The input moved and scaled by powers of two, so that squares and cubes of lengths neither overflow nor vanish.
std::vector<scene::Point> points_for_estimates(const scene::TriangleMesh& mesh);

// The area of a star; and the sum of the absolute principal curvatures of a quadric over its plane, 0 where it has none. `star`: the numbers of
// its triangles, ascending.
struct StarSize {
  double area = 0, kappa = 0;
};
StarSize star_size_estimate(std::uint32_t vertex, std::span<const std::uint32_t> star,
                            const std::vector<scene::Triangle>& triangles, const std::vector<scene::Point>& points);
// Small, flat stars first: a / max a + kappa / max kappa, halved.
double removal_weight_estimate(const StarSize& size, const StarSize& largest);

// Proposals for the layout of a star around 0, in the order in which they are to be tried: z^a; its angles with equal radii; equal angles and
// radii. Rounded to the grid of 2^-24; whether one is embedded is for signs to say.
class LayoutProposals {
 public:
  static constexpr int count = 3;
  // `ring` as in scene::Removal: counter-clockwise, for a feature from one tagged edge to the other, at `across`, and on.
  LayoutProposals(scene::StarKind kind, std::uint32_t across, std::uint32_t vertex, std::span<const std::uint32_t> ring,
                  const std::vector<scene::Point>& points);
  // None is, where a side is a single triangle, which z^a makes flat.
  bool possible() const;
  void lay_out(int proposal, std::span<DiskPoint> out) const;

 private:
  using Numbers = boost::container::small_vector<double, 12>;
  // The parts of the turn that sectors share: from sector `begin` to `end` in ring order they make up `angle`.
  struct Side {
    std::size_t begin = 0, end = 0;
    double angle = 0;
  };

  scene::StarKind kind_;
  std::uint32_t across_;
  std::size_t sides_ = 1;
  std::array<Side, 2> side_;
  Numbers angles_, radii_;
};

}  // namespace clues::exact
