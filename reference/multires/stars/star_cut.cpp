// Crossings are points of two lines, with numbers longer than 128 bits: the only place where that is so.

#include <algorithm>
#include <map>
#include <optional>

#include "reference/multires/stars/combination.h"
#include "reference/multires/stars/star_pieces.h"

namespace clues::reference {
namespace {

using exact::Wide;
using scene::CarrierPoint;

mpz_class divided_down(const mpz_class& a, const mpz_class& b) {
  mpz_class out;
  mpz_fdiv_q(out.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return out;
}

// The crossing of the edge from x to y, which lie strictly on either side of the diagonal's line.
struct Crossing {
  bool within = false;  // between the ends of the diagonal
  std::optional<StarPoint> point;
};
Crossing crossing_of(const Diagonal& d, const StarPoint& x, const StarPoint& y, Wide side_x, Wide side_y) {
  const mpz_class part = to_integer(side_x > 0 ? side_x : -side_x), rest = to_integer(side_y > 0 ? side_y : -side_y);
  const mpz_class whole = part + rest;
  const std::int64_t dx = d.at_b[0] - d.at_a[0], dy = d.at_b[1] - d.at_a[1];
  const std::size_t axis = std::abs(dx) >= std::abs(dy) ? 0 : 1;
  const mpz_class p = to_integer(axis == 0 ? x.flat.x : x.flat.y), q = to_integer(axis == 0 ? y.flat.x : y.flat.y);
  const mpz_class length(axis == 0 ? dx : dy);
  // From a, in units of 2^-84 / whole; the diagonal has length * 2^60 * whole of them.
  mpz_class way = rest * p + part * q - mpz_class(d.at_a[axis]) * mpz_class(scene::whole_weight) * whole;
  mpz_class unit = length * whole;
  if (unit < 0) {
    way = -way;
    unit = -unit;
  }
  Crossing out;
  out.within = way > 0 && way < unit * mpz_class(scene::whole_weight);
  if (!out.within) return out;
  const std::int64_t weight_b = divided_down(way, unit).get_si(), weight_a = scene::whole_weight - weight_b;
  if (weight_b == 0) return out;
  const auto source = combined({{&x.at.source, rest}, {&y.at.source, part}});
  if (!source) return out;
  StarPoint point;
  point.at.source = *source;
  point.at.image = d.a < d.b ? CarrierPoint{{d.a, d.b, scene::no_vertex}, {weight_a, weight_b, 0}}
                             : CarrierPoint{{d.b, d.a, scene::no_vertex}, {weight_b, weight_a, 0}};
  point.flat = {Wide{d.at_a[0]} * weight_a + Wide{d.at_b[0]} * weight_b,
                Wide{d.at_a[1]} * weight_a + Wide{d.at_b[1]} * weight_b};
  out.point = point;
  return out;
}

}  // namespace

bool cut_along(const Diagonal& diagonal, StarPieces& star) {
  const std::size_t count = star.points.size();
  std::vector<Wide> side(count);
  std::vector<int> sign(count);
  for (std::size_t k = 0; k < count; ++k) {
    side[k] = exact::orientation(diagonal.at_a, diagonal.at_b, star.points[k].flat);
    sign[k] = exact::sign_of(side[k]);
  }
  constexpr std::uint32_t none = scene::no_vertex;
  std::map<scene::Edge, std::uint32_t> crossings;  // of the edges that cross the line: the new point, or none
  bool possible = true;
  const auto crossing_at = [&](std::uint32_t x, std::uint32_t y) {
    const auto edge = scene::edge_of(x, y);
    const auto [place, fresh] = crossings.try_emplace(edge, none);
    if (fresh) {
      const auto crossing =
          crossing_of(diagonal, star.points[edge[0]], star.points[edge[1]], side[edge[0]], side[edge[1]]);
      if (crossing.within && !crossing.point) possible = false;
      if (crossing.point) {
        place->second = static_cast<std::uint32_t>(star.points.size());
        star.points.push_back(*crossing.point);
      }
    }
    return place->second;
  };
  const std::size_t before = star.pieces.size();
  for (std::size_t i = 0; i < before && possible; ++i) {
    const StarPiece piece = star.pieces[i];
    // Turned so that the first corner is alone on its side, or, where the line goes through a corner, is that corner.
    std::size_t turn = 3;
    const auto sign_at = [&](std::size_t k) { return sign[piece.corners[k % 3]]; };
    for (std::size_t k = 0; k < 3; ++k) {
      if (sign_at(k) == 0 && sign_at(k + 1) * sign_at(k + 2) < 0) turn = k;
      if (sign_at(k) != 0 && sign_at(k) * sign_at(k + 1) < 0 && sign_at(k) * sign_at(k + 2) < 0) turn = k;
    }
    if (turn == 3) continue;
    const std::uint32_t x = piece.corners[turn], y = piece.corners[(turn + 1) % 3], z = piece.corners[(turn + 2) % 3];
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      star.pieces.push_back({{a, b, c}, piece.input, true});
    };
    if (sign[x] == 0) {
      const std::uint32_t p = crossing_at(y, z);
      if (p == none) continue;
      star.pieces[i] = {{x, y, p}, piece.input, true};
      add(x, p, z);
      continue;
    }
    const std::uint32_t p = crossing_at(x, y), q = crossing_at(x, z);
    if (p == none || q == none) {
      // No vertex of the overlay lies inside of a piece, so that the diagonal, which ends in such vertices, crosses both edges or none.
      if (p != q) possible = false;
      continue;
    }
    star.pieces[i] = {{x, p, q}, piece.input, true};
    if (y < z) {
      add(p, y, q);
      add(y, z, q);
    } else {
      add(p, y, z);
      add(p, z, q);
    }
  }
  return possible;
}

}  // namespace clues::reference
