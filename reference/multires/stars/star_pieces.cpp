#include "reference/multires/stars/star_pieces.h"

#include <algorithm>
#include <utility>

#include "reference/multires/stars/combination.h"

namespace clues::reference {

bool lies_in(const scene::Triangle& triangle, const scene::CarrierPoint& point) {
  return std::all_of(point.corner.begin(), point.corner.begin() + static_cast<std::ptrdiff_t>(point.size()),
                     [&](std::uint32_t v) { return v == triangle[0] || v == triangle[1] || v == triangle[2]; });
}

scene::OverlayTriangle numbered(const StarPiece& piece, StarPieces& star, std::vector<scene::OverlayVertex>& points) {
  scene::OverlayTriangle out{{}, piece.input};
  for (std::size_t k = 0; k < 3; ++k) {
    StarPoint& point = star.points[piece.corners[k]];
    if (point.number == scene::no_vertex) {
      point.number = static_cast<std::uint32_t>(points.size());
      points.push_back(point.at);
    }
    out.corners[k] = point.number;
  }
  return out;
}

std::optional<scene::CarrierPoint> source_in(const StarPiece& piece, const std::array<mpz_class, 3>& part,
                                             const StarPieces& star) {
  std::vector<std::pair<const scene::CarrierPoint*, mpz_class>> parts;
  for (std::size_t k = 0; k < 3; ++k) {
    if (part[k] > 0) parts.emplace_back(&star.points[piece.corners[k]].at.source, part[k]);
  }
  return combined(parts);
}

void cut_from(std::uint32_t point, std::size_t i, const std::array<mpz_class, 3>& part, StarPieces& star) {
  const StarPiece piece = star.pieces[i];
  bool first = true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (part[k] == 0) continue;
    StarPiece next = piece;
    next.corners[k] = point;
    next.cut = true;
    if (first) {
      star.pieces[i] = next;
    } else {
      star.pieces.push_back(next);
    }
    first = false;
  }
}

}  // namespace clues::reference
