// D33, the overlay: the input and the current domain K^l cut into common pieces. Every piece is a triangle of which the source lies in one
// input triangle and the image in one triangle of K^l, both turned counter-clockwise; edges of pieces cover all edges of the input and of K^l. Pi is
// linear on each piece, so that it is a homeomorphism whatever was rounded on the way: signs say so, not the construction.
//
// When a star is flattened and closed, its pieces go with it: cut along the new diagonals, located, written in weights of the new
// triangles. A point that was introduced on an edge that is gone is taken out again where both sides stay positive without it.
#pragma once

#include <optional>
#include <vector>

#include "reference/multires/stars/flattening.h"

namespace clues::reference {

// The weights of a flattened point in the closed triangle of three ring vertices: each the ratio of areas rounded down to the grid of 2^-60, and what
// is left over goes to the largest (of equal ones, to that of the lowest number). None: outside, or a positive weight would become 0.
std::optional<scene::CarrierPoint> weights_in(const scene::Triangle& triangle,
                                              const std::array<exact::DiskPoint, 3>& corners,
                                              const exact::FlatPoint& point);

class Overlay {
 public:
  explicit Overlay(const scene::TriangleMesh& input);

  // The star of `vertex` in the complex, flattened, becomes `closing` (in the order in which StarComplex::replace() will number them,
  // which has to follow). False, and nothing has changed: the grids are too coarse for some piece.
  bool carry(std::uint32_t vertex, const StarShape& shape, const FlatStar& flat,
             const std::vector<scene::Triangle>& closing);

  std::size_t piece_count() const { return count_; }
  const scene::CarrierPoint& image(std::uint32_t input_vertex) const { return points_[input_vertex].image; }
  // The pieces of these triangles of the complex, in this order; points that no piece has any more are left out.
  void write_to(const std::vector<std::uint32_t>& triangles, scene::Hierarchy& hierarchy) const;

 private:
  std::size_t input_vertices_;
  std::vector<scene::Triangle> input_triangles_;
  std::vector<scene::OverlayVertex> points_;
  std::vector<std::vector<scene::OverlayTriangle>> pieces_;  // by number of the triangle in the complex
  std::size_t count_;
  std::vector<std::uint32_t> place_;  // of each point among those of the star at hand; no_vertex between stars
};

}  // namespace clues::reference
