// Supporting planes in doubles that need not be exact, and culling by them.
#include "fastpath/queries/shaft.h"

#include <algorithm>
#include <cmath>

#include "fastpath/predicates/estimated_vectors.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

// A plane is worth having if the points on its wrong side are within this fraction of the shaft's size: only tightness depends on it.
constexpr double kSupports = 0x1p-30;

template <class Found>
void walk(const Bvh& bvh, const Shaft& shaft, std::span<const std::uint32_t> ignored, const Found& found) {
  if (bvh.nodes().empty()) return;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t next = stack.back();
    stack.pop_back();
    if ((next & BoxLanes::kLeaf) == 0) {
      const BoxLanes& node = bvh.nodes()[next];
      for (unsigned met = shaft.may_meet_conservative(node); met != 0; met &= met - 1)
        stack.push_back(node.child[__builtin_ctz(met)]);
      continue;
    }
    const TriangleBlock& block = bvh.blocks()[next & ~BoxLanes::kLeaf];
    for (unsigned met = shaft.may_meet_conservative(block); met != 0; met &= met - 1) {
      const std::uint32_t id = block.id[__builtin_ctz(met)];
      if (std::find(ignored.begin(), ignored.end(), id) != ignored.end()) continue;
      if (shaft.plane_may_meet_conservative(bvh.corners(id)) && found(id)) return;
    }
  }
}

}  // namespace

Shaft::Shaft(const LocalFrame& frame, const Corners& triangle, std::span<const Point> cell) {
  points_.assign(triangle.begin(), triangle.end());
  points_.insert(points_.end(), cell.begin(), cell.end());
  double size = 1;
  bool near = true;
  for (const Point& p : points_) {
    Point local{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite(p[k])) throw scene::Error(scene::ErrorCode::non_finite, "a point of a shaft is not finite");
      local[k] = frame.to_local(p[k], k);
      near = near && std::fabs(local[k]) <= 0x1p40;
      size = std::max(size, std::fabs(local[k]));
    }
    local_.push_back(local);
  }
  if (!near) return;  // too far for floats: no half spaces, every box may be met
  // Errors of a value normal . x, |normal| <= 1: the offset's point is wrong by 2^-53 size a coordinate and the value rounded (2^-51 size in all, 2^-49
  // is safe). On the other side a box is exact in floats and its value in float has three products and two sums: at most 9 u |x|
  // for |x| <= 1.01; the triangles' corners are wrong by 2^-25 + 2^-24 * 2 and rounded sums of two, 2^-22 in each of three coordinates. 2^-19 covers
  // both (9 * 2^-24 < 2^-20 and 3 * 2^-22 + 2^-20 < 2^-19 * 0.9), and the rounding of the normal, which is the same on both sides.
  slack_ = 0x1p-19 + 0x1p-49 * size;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double direction : {-1.0, 1.0}) {
      Point axis{};
      axis[k] = direction;
      add_half_space(axis);
    }
  }
  // A facet of the hull is the triangle, or spanned by an edge of one and a corner of the other, or a facet of the cell. The last are left
  // out: of these the box has what matters.
  const std::size_t n = local_.size();
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const Point edge = minus(local_[j], local_[i]);
      for (std::size_t k = j + 1; k < n; ++k) {
        Point normal = cross_of(edge, minus(local_[k], local_[i]));
        const double length = std::max({std::fabs(normal[0]), std::fabs(normal[1]), std::fabs(normal[2])});
        if (!(length > 0x1p-300)) continue;
        for (double& x : normal) x /= length;
        double low = INFINITY, high = -INFINITY;
        for (const Point& p : local_) {
          const double value = dot_of(normal, minus(p, local_[i]));
          low = std::min(low, value);
          high = std::max(high, value);
        }
        const double least = kSupports * (high - low);
        if (high <= least) add_half_space(normal);
        if (low >= -least) add_half_space({-normal[0], -normal[1], -normal[2]});
      }
    }
  }
}

void Shaft::add_half_space(const Point& normal) {
  HalfSpace h;
  Point rounded{};
  for (std::size_t k = 0; k < 3; ++k) {
    h.normal[k] = static_cast<float>(normal[k]);
    rounded[k] = static_cast<double>(h.normal[k]);
  }
  double offset = -INFINITY;
  for (const Point& p : local_) offset = std::max(offset, dot_of(rounded, p));
  h.offset = rounded_up(offset + slack_);
  // Coplanar corners span the same plane many times.
  const bool known = std::any_of(half_spaces_.begin(), half_spaces_.end(),
                                 [&](const HalfSpace& other) { return other.normal == h.normal; });
  if (!known) half_spaces_.push_back(h);
}

unsigned Shaft::may_meet_conservative(const BoxLanes& node) const {
  unsigned met = 0;
  for (std::size_t lane = 0; lane < BoxLanes::kWidth; lane += 4) {
    Mask4 outside{};
    for (const HalfSpace& h : half_spaces_) {
      // The corner of the box where the value is least.
      Float4 value{};
      for (std::size_t k = 0; k < 3; ++k)
        value += load4(node.side[h.normal[k] > 0 ? k : k + 3] + lane) * all_lanes(h.normal[k]);
      outside |= value > all_lanes(h.offset);
    }
    met |= bits_of(~outside) << lane;
  }
  for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
    if (node.child[lane] == BoxLanes::kEmpty) met &= ~(1U << lane);
  }
  return met;
}

unsigned Shaft::may_meet_conservative(const TriangleBlock& block) const {
  Mask4 outside{};
  for (const HalfSpace& h : half_spaces_) {
    Float4 at_corner{}, to_second{}, to_third{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Float4 n = all_lanes(h.normal[k]);
      at_corner += load4(block.corner[k]) * n;
      to_second += load4(block.edge1[k]) * n;
      to_third += load4(block.edge2[k]) * n;
    }
    outside |= (at_corner + min4(all_lanes(0.0F), min4(to_second, to_third))) > all_lanes(h.offset);
  }
  // A size above the scene's marks a triangle that does not fit into floats.
  return bits_of(~outside | (load4(block.size) > all_lanes(16.0F)));
}

bool Shaft::plane_may_meet_conservative(const Corners& t) const {
  bool above = true, below = true;
  for (const Point& p : points_) {
    const FilteredSign side = orient3d_filtered(t[0], t[1], t[2], p);
    above = above && side.certain && side.sign == Sign::positive;
    below = below && side.certain && side.sign == Sign::negative;
    if (!above && !below) return true;
  }
  return false;
}

std::vector<std::uint32_t> shaft_candidates_conservative(const Bvh& bvh, const Shaft& shaft,
                                                         std::span<const std::uint32_t> ignored) {
  std::vector<std::uint32_t> found;
  walk(bvh, shaft, ignored, [&](std::uint32_t id) {
    found.push_back(id);
    return false;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool shaft_is_empty_conservative(const Bvh& bvh, const Shaft& shaft, std::span<const std::uint32_t> ignored) {
  bool empty = true;
  walk(bvh, shaft, ignored, [&](std::uint32_t) {
    empty = false;
    return true;
  });
  return empty;
}

}  // namespace clues::fastpath
