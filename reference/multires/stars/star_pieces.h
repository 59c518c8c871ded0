// The pieces of one star while it is flattened (D33), or of one patch (D34): their points by numbers of their own, laid out flat.
#pragma once

#include <gmpxx.h>

#include <map>
#include <optional>
#include <vector>

#include "exact/multires/grid.h"

namespace clues::reference {

struct StarPoint {
  std::uint32_t number = scene::no_vertex;  // in the overlay; no_vertex: introduced here
  bool of_input = false;
  scene::OverlayVertex at;
  exact::FlatPoint flat;
};

struct StarPiece {
  std::array<std::uint32_t, 3> corners{};  // points of this star
  std::uint32_t input = 0;
  bool cut = false;  // its source is new
};

struct StarPieces {
  std::vector<StarPoint> points;
  std::vector<StarPiece> pieces;
};

// Whether a point lies in a closed triangle, by the vertices that carry it.
bool lies_in(const scene::Triangle& triangle, const scene::CarrierPoint& point);

// The number of a point among `points`, where make() puts it when it is met for the first time.
template <typename Make>
std::uint32_t local_number(std::uint32_t point, std::map<std::uint32_t, std::uint32_t>& numbers,
                           std::vector<StarPoint>& points, const Make& make) {
  const auto [place, fresh] = numbers.try_emplace(point, static_cast<std::uint32_t>(points.size()));
  if (fresh) points.push_back(make());
  return place->second;
}

// The piece by numbers in the overlay, to whose points those introduced here are added.
scene::OverlayTriangle numbered(const StarPiece& piece, StarPieces& star, std::vector<scene::OverlayVertex>& points);

// A point in a closed piece, by the areas opposite to the corners of that. Its place in the input; none: the grid has none.
std::optional<scene::CarrierPoint> source_in(const StarPiece& piece, const std::array<mpz_class, 3>& part,
                                             const StarPieces& star);
// Cuts piece number `i` from the point to its corners: `point` in place of each corner in turn, but of those from which nothing would be left.
void cut_from(std::uint32_t point, std::size_t i, const std::array<mpz_class, 3>& part, StarPieces& star);

// A new edge across the disk, between two ring vertices.
struct Diagonal {
  std::uint32_t a = 0, b = 0;
  exact::DiskPoint at_a{}, at_b{};
};

// Cuts the pieces along the diagonal. Where an edge crosses it, a point is introduced, at the grid point of the diagonal below the
// crossing. False: the grid has none strictly between the ends, or none between the ends of the source.
bool cut_along(const Diagonal& diagonal, StarPieces& star);

// Takes out what points it can that are not of the input and lie inside of `triangle`, of which these are all pieces: such a point is moved onto a
// neighbour (along the input edge that it lies on), if all pieces that are left keep both orientations.
void simplify(const scene::Triangle& triangle, const std::vector<scene::Triangle>& input, const StarPieces& star,
              std::vector<StarPiece>& pieces);
// The same for all triangles at a vertex, by triangle, with points on the edges from it: these move along the edge.
void simplify_star(const std::vector<scene::Triangle>& triangles, std::uint32_t hub,
                   const std::vector<scene::Triangle>& input, const StarPieces& star,
                   std::vector<std::vector<StarPiece>>& pieces);

}  // namespace clues::reference
