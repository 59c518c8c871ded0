// The overlay (D33) in arrays: images and sources of its points, and for each triangle of the domain a stretch of pieces.
//
// Removals of one level are independent: the stars have no triangle in common, and what they share of the overlay, points on edges of their
// rings, no removal moves. So each is carried by itself, by any thread, from the overlay that the level began with (carry.h), and what comes
// of it is put in place in the order of the removals.
#pragma once

#include <span>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::fastpath::multires {

// What a removal does to the overlay. Points of pieces are those of the overlay, or, from `first_new` on, `added`.
struct Carried {
  static constexpr std::uint32_t first_new = 0x80000000;
  struct Moved {
    std::uint32_t point;
    scene::CarrierPoint image;
  };
  bool done = false;  // false: the grids are too coarse for some piece
  std::vector<Moved> moved;
  std::vector<scene::OverlayVertex> added;
  std::vector<scene::OverlayTriangle> pieces;  // by triangle of the cover
  std::vector<std::uint32_t> sizes;            // how many each has
};

class CommonPieces {
 public:
  explicit CommonPieces(const scene::TriangleMesh& input);

  std::size_t point_count() const { return images_.size(); }
  bool is_vertex(std::uint32_t point) const { return point < vertices_; }
  const scene::CarrierPoint& image(std::uint32_t point) const { return images_[point]; }
  const scene::CarrierPoint& source(std::uint32_t point) const { return sources_[point]; }
  std::span<const scene::OverlayTriangle> of(std::uint32_t triangle) const {
    return {pool_.data() + stretches_[triangle].begin, stretches_[triangle].size};
  }

  // What was carried for a star of these triangles; those that take their place are numbered on.
  void put(std::span<const std::uint32_t> star, const Carried& carried);
  void end_level();  // gives back what is no longer used
  // Points that no piece has are left out.
  void write_to(std::span<const std::uint32_t> triangles, scene::Hierarchy& hierarchy) const;

 private:
  struct Stretch {
    std::size_t begin = 0;
    std::uint32_t size = 0;
  };
  std::size_t vertices_, used_;  // used_: pieces of the pool that are still of a triangle
  std::vector<scene::CarrierPoint> images_, sources_;
  std::vector<Stretch> stretches_;  // by number of the triangle
  std::vector<scene::OverlayTriangle> pool_;
};

}  // namespace clues::fastpath::multires
