#include "reference/multires/patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "reference/multires/pieces_around.h"
#include "reference/multires/stars/combination.h"
#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using exact::DiskPoint;
using exact::Wide;
using scene::CarrierPoint;

[[noreturn]] void too_fine(const Patch& patch) {
  throw scene::Error(
      scene::ErrorCode::unsupported,
      fmt::format(
          "remesh: the overlay in base triangle {} is too fine for the grid of 2^-60 at level {}; take fewer levels, "
          "or a base domain of more triangles",
          patch.base, patch.level + 1));
}

// Parameters as coordinates: the second and third weight.
exact::FlatPoint flat_of(const scene::Triangle& t, const CarrierPoint& p) {
  return {Wide{p.weight_of(t[1])} * scene::disk_unit, Wide{p.weight_of(t[2])} * scene::disk_unit};
}
DiskPoint disk_of(const scene::Triangle& t, const CarrierPoint& p) {
  constexpr int shift = scene::weight_bits - scene::disk_bits;
  return {p.weight_of(t[1]) >> shift, p.weight_of(t[2]) >> shift};
}

std::uint32_t point_at(const Patch& patch, const CarrierPoint& image) {
  for (std::uint32_t k = 0; k < patch.pieces.points.size(); ++k) {
    if (patch.pieces.points[k].at.image == image) return k;
  }
  return scene::no_vertex;
}

// Makes a point of the overlay at these parameters, which lie in the patch.
void insert(Patch& patch, const CarrierPoint& image) {
  if (point_at(patch, image) != scene::no_vertex) return;
  auto& points = patch.pieces.points;
  const auto& pieces = patch.pieces.pieces;
  const auto fresh = static_cast<std::uint32_t>(points.size());
  StarPoint point;
  point.at.image = image;
  point.flat = flat_of(patch.triangle, image);
  const std::size_t count = pieces.size();
  bool made = false;
  for (std::size_t i = 0; i < count; ++i) {
    const StarPiece piece = pieces[i];
    std::array<mpz_class, 3> part;
    bool inside = true;
    for (std::size_t k = 0; k < 3 && inside; ++k) {
      const Wide area = exact::area_in(patch.triangle, points[piece.corners[(k + 1) % 3]].at.image,
                                       points[piece.corners[(k + 2) % 3]].at.image, image);
      inside = area >= 0;
      if (inside) part[k] = to_integer(area);
    }
    if (!inside) continue;
    if (!made) {
      const auto source = source_in(piece, part, patch.pieces);
      if (!source) too_fine(patch);
      point.at.source = *source;
      points.push_back(point);
      made = true;
    }
    cut_from(fresh, i, part, patch.pieces);
  }
  if (!made) throw scene::Error(scene::ErrorCode::internal, "remesh: a point of a patch that no piece holds");
}

// New points on a line that the grid does not tell apart, on either surface, become one, that on an edge of the input if one is; pieces between them
// vanish. Whether what is left is right, its signs say.
void merge_from(std::size_t first, StarPieces& star) {
  std::vector<std::uint32_t> order, same(star.points.size());
  for (std::uint32_t k = 0; k < star.points.size(); ++k) same[k] = k;
  for (auto k = static_cast<std::uint32_t>(first); k < star.points.size(); ++k) order.push_back(k);
  bool any = false;
  for (const auto place : {&scene::OverlayVertex::image, &scene::OverlayVertex::source}) {
    const auto key = [&](std::uint32_t k) {
      const auto& at = star.points[k].at;
      return std::make_tuple((at.*place).corner, (at.*place).weight, at.source.size(), k);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::uint32_t p = order[k - 1], q = order[k];
      if (!(star.points[p].at.*place == star.points[q].at.*place) || same[p] == same[q]) continue;
      const std::uint32_t from = same[q], to = same[p];
      std::replace(same.begin(), same.end(), from, to);
      any = true;
    }
  }
  if (!any) return;
  std::vector<StarPiece> left;
  for (StarPiece piece : star.pieces) {
    for (auto& v : piece.corners) v = same[v];
    if (piece.corners[0] != piece.corners[1] && piece.corners[1] != piece.corners[2] &&
        piece.corners[2] != piece.corners[0]) {
      left.push_back(piece);
    }
  }
  star.pieces = std::move(left);
}

void cut(Patch& patch, const CarrierPoint& a, const CarrierPoint& b) {
  // cut_along() writes images over the ends of the line; here they are parameters. In steps of 2^(level + 2) on the line they are on the grid exactly: the
  // weights of its ends differ by multiples of 2^(59 - level).
  const std::int64_t step = std::int64_t{1} << (patch.level + 2);
  const std::size_t before = patch.pieces.points.size();
  if (!cut_along({0, 1, disk_of(patch.triangle, a), disk_of(patch.triangle, b)}, patch.pieces)) too_fine(patch);
  for (std::size_t k = before; k < patch.pieces.points.size(); ++k) {
    StarPoint& point = patch.pieces.points[k];
    const std::int64_t at_b = point.at.image.weight[1] / step * step;
    if (at_b == 0) too_fine(patch);
    const auto image = combined({{&a, mpz_class(scene::whole_weight - at_b)}, {&b, mpz_class(at_b)}});
    if (!image) too_fine(patch);
    point.at.image = *image;
    point.flat = flat_of(patch.triangle, *image);
  }
  merge_from(before, patch.pieces);
}

// The parts with these corners get the pieces whose middle they hold.
std::vector<Patch> shared_out(const Patch& patch, const std::vector<std::array<CarrierPoint, 3>>& parts, int level,
                              const scene::Hierarchy& hierarchy) {
  std::vector<Patch> out(parts.size());
  std::vector<std::map<std::uint32_t, std::uint32_t>> numbers(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    out[k].base = patch.base;
    out[k].triangle = patch.triangle;
    out[k].corners = parts[k];
    out[k].level = level;
  }
  for (const StarPiece& piece : patch.pieces.pieces) {
    std::array<const scene::OverlayVertex*, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = &patch.pieces.points[piece.corners[k]].at;
      if (!lies_in(hierarchy.input.triangles[piece.input], at[k]->source)) too_fine(patch);
    }
    if (exact::orientation_in(patch.triangle, at[0]->image, at[1]->image, at[2]->image) <= 0 ||
        exact::orientation_in(hierarchy.input.triangles[piece.input], at[0]->source, at[1]->source, at[2]->source) <=
            0) {
      too_fine(patch);
    }
    std::size_t part = 0;
    const auto held = [&](const std::array<CarrierPoint, 3>& corners) {
      for (const auto* p : at) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (exact::orientation_in(patch.triangle, corners[k], corners[(k + 1) % 3], p->image) < 0) return false;
        }
      }
      return true;
    };
    while (part < parts.size() && !held(parts[part])) ++part;
    if (part == parts.size()) too_fine(patch);
    StarPiece copy = piece;
    for (auto& v : copy.corners) {
      v = local_number(v, numbers[part], out[part].pieces.points, [&] { return patch.pieces.points[v]; });
    }
    out[part].pieces.pieces.push_back(copy);
  }
  return out;
}

}  // namespace

scene::Hierarchy with_coarse_parameters(const scene::Hierarchy& hierarchy) {
  constexpr std::int64_t step = std::int64_t{1} << 30;
  scene::Hierarchy h = hierarchy;
  const PiecesAround around(h);
  for (std::uint32_t p = 0; p < h.points.size(); ++p) {
    const CarrierPoint old = h.points[p].image;
    CarrierPoint moved = old;
    std::int64_t left = scene::whole_weight;
    std::size_t largest = 0;
    bool possible = old.size() > 1;
    for (std::size_t k = 0; k < old.size(); ++k) {
      moved.weight[k] = (old.weight[k] + step / 2) / step * step;
      possible = possible && moved.weight[k] > 0;
      if (moved.weight[k] > moved.weight[largest]) largest = k;
      left -= moved.weight[k];
    }
    moved.weight[largest] += left;
    if (!possible || moved.weight[largest] <= 0) continue;
    h.points[p].image = moved;
    const bool stays = std::all_of(around.pieces[p].begin(), around.pieces[p].end(), [&](std::uint32_t i) {
      const auto& c = h.pieces[i].corners;
      return exact::orientation_in(h.base[around.base[i]], h.points[c[0]].image, h.points[c[1]].image,
                                   h.points[c[2]].image) > 0;
    });
    if (!stays) h.points[p].image = old;
  }
  return h;
}

std::vector<Patch> base_patches(const scene::Hierarchy& h) {
  const std::vector<std::uint32_t> triangle_of = base_triangles(h);
  std::vector<Patch> out(h.base.size());
  for (std::uint32_t t = 0; t < h.base.size(); ++t) {
    out[t].base = t;
    out[t].triangle = h.base[t];
    for (std::size_t k = 0; k < 3; ++k) out[t].corners[k] = scene::at_vertex(h.base[t][k]);
  }
  std::vector<std::map<std::uint32_t, std::uint32_t>> local(h.base.size());
  for (std::uint32_t i = 0; i < h.pieces.size(); ++i) {
    const auto& piece = h.pieces[i];
    const std::uint32_t t = triangle_of[i];
    Patch& patch = out[t];
    StarPiece copy{{}, piece.input, false};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = piece.corners[k];
      copy.corners[k] = local_number(p, local[t], patch.pieces.points, [&] {
        return StarPoint{p, false, h.points[p], flat_of(patch.triangle, h.points[p].image)};
      });
    }
    patch.pieces.pieces.push_back(copy);
  }
  return out;
}

CarrierPoint middle_of(const CarrierPoint& a, const CarrierPoint& b) {
  std::vector<std::pair<std::uint32_t, std::int64_t>> weights;
  for (const auto* p : {&a, &b}) {
    for (std::size_t k = 0; k < p->size(); ++k) {
      const auto found =
          std::find_if(weights.begin(), weights.end(), [&](const auto& w) { return w.first == p->corner[k]; });
      if (found == weights.end()) {
        weights.emplace_back(p->corner[k], p->weight[k] / 2);
      } else {
        found->second += p->weight[k] / 2;
      }
    }
  }
  std::sort(weights.begin(), weights.end());
  CarrierPoint out;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    out.corner[k] = weights[k].first;
    out.weight[k] = weights[k].second;
  }
  return out;
}

std::vector<Patch> cut_in_four(const Patch& patch, const scene::Hierarchy& hierarchy) {
  Patch whole = patch;
  std::array<CarrierPoint, 3> middle;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = middle_of(patch.corners[k], patch.corners[(k + 1) % 3]);
    insert(whole, middle[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) cut(whole, middle[k], middle[(k + 1) % 3]);
  const auto& c = patch.corners;
  return shared_out(whole,
                    {{c[0], middle[0], middle[2]},
                     {middle[0], c[1], middle[1]},
                     {middle[2], middle[1], c[2]},
                     {middle[0], middle[1], middle[2]}},
                    patch.level + 1, hierarchy);
}

std::vector<Patch> cut_in_two(const Patch& patch, std::size_t edge, const scene::Hierarchy& hierarchy) {
  Patch whole = patch;
  const auto &a = patch.corners[edge], &b = patch.corners[(edge + 1) % 3], &c = patch.corners[(edge + 2) % 3];
  const CarrierPoint middle = middle_of(a, b);
  insert(whole, middle);
  cut(whole, middle, c);
  return shared_out(whole, {{a, middle, c}, {middle, b, c}}, patch.level, hierarchy);
}

CarrierPoint source_at(const Patch& patch, const CarrierPoint& corner) {
  const std::uint32_t k = point_at(patch, corner);
  if (k == scene::no_vertex)
    throw scene::Error(scene::ErrorCode::internal, "remesh: a corner of a patch that is no point of its pieces");
  return patch.pieces.points[k].at.source;
}

}  // namespace clues::reference
