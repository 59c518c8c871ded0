// D33, one step: the pieces of a star go along when it is laid out and its hole is covered. They are cut along the new diagonals, located in the new
// triangles, written in weights of these, and points that were introduced are taken out again where signs allow it. Every decision is the reference's
// (reference/multires/overlay.h), so that what comes out is the same to the bit; the numbers that it is made of are doubles where their error bound
// says that they will do, and whole numbers where it does not.
#pragma once

#include <boost/container/small_vector.hpp>
#include <vector>

#include "fastpath/multires/common_pieces.h"
#include "fastpath/multires/grid_signs.h"
#include "fastpath/multires/surface_star.h"
#include "fastpath/multires/thinning.h"

namespace clues::fastpath::multires {

// One for each thread: its arrays are used again.
class Carrier {
 public:
  Carrier(const CommonPieces& pieces, const std::vector<scene::Triangle>& input) : pieces_(pieces), input_(input) {}

  void carry(const SurfaceStar& star, const DiskLayout& layout, const HoleCover& cover, Carried& out);

 private:
  struct Diagonal {
    std::uint32_t a, b;
    exact::DiskPoint at_a, at_b;
  };
  using Sides = std::array<DiskDouble, 3>;

  void gather();
  std::size_t number_of(std::uint32_t vertex) const;  // in the ring, or that of the middle
  exact::DiskPoint place_of(std::uint32_t vertex) const;
  std::size_t triangle_of(const HoleCover& cover, const StarPart& part) const;
  void add_point(std::uint32_t number, bool of_input, const scene::CarrierPoint& source,
                 const scene::CarrierPoint& image);
  void find_diagonals(const HoleCover& cover);
  bool cut_along(const Diagonal& diagonal);
  std::uint32_t crossing_at(const Diagonal& diagonal, std::uint32_t x, std::uint32_t y, bool& possible);
  bool cross(const Diagonal& diagonal, std::uint32_t x, std::uint32_t y, bool& within);
  bool locate(const HoleCover& cover);
  bool share_out(const HoleCover& cover);
  // Of a point, and of the sum of three: whether the closed triangle has it.
  bool holds(std::size_t triangle, std::uint32_t point) const;
  bool holds_middle(std::size_t triangle, const std::array<std::uint32_t, 3>& corners) const;

  const CommonPieces& pieces_;
  const std::vector<scene::Triangle>& input_;
  const SurfaceStar* star_ = nullptr;
  const DiskLayout* layout_ = nullptr;
  bool sure_ = true;

  // Points of the star, by numbers of their own.
  StarPoints points_;
  std::vector<exact::FlatPoint> flat_;
  std::vector<DiskDouble> about_;  // the same in doubles
  std::vector<signed char> side_;  // of the diagonal at hand
  std::vector<StarPart> parts_;
  std::vector<std::vector<StarPart>> shares_;  // of the new triangles
  std::vector<std::uint32_t> place_;           // of each point of the overlay among those of the star
  boost::container::small_vector<Diagonal, most_neighbours> diagonals_;
  // The corners of the new triangles.
  std::array<std::array<exact::DiskPoint, 3>, most_neighbours> corners_;
  std::array<Sides, most_neighbours> about_corners_;
  // Bits for corners of an image, by place in the ring; 15: the middle.
  std::vector<std::uint16_t> mask_;
  std::array<std::uint16_t, most_neighbours> cover_mask_;
  std::array<bool, most_neighbours> may_thin_;
  // The crossings of a diagonal, in lists by the lower end of the edge.
  struct Crossing {
    std::uint32_t other, point, next;
  };
  std::vector<std::uint32_t> first_crossing_;
  std::vector<Crossing> crossings_;
  std::vector<std::uint8_t> moves_;  // of the points that were there before: not on the border
  Thinning thinning_;
};

}  // namespace clues::fastpath::multires
