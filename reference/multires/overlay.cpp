#include "reference/multires/overlay.h"

#include <algorithm>

#include "reference/multires/stars/star_pieces.h"

namespace clues::reference {
namespace {

using exact::DiskPoint;
using exact::FlatPoint;
using exact::Wide;
using scene::CarrierPoint;

// Where the vertices of a star lie in the disk.
struct Disk {
  std::uint32_t middle;
  const std::vector<std::uint32_t>& ring;
  const std::vector<DiskPoint>& flat;

  DiskPoint at(std::uint32_t vertex) const {
    if (vertex == middle) return {0, 0};
    const auto place = std::find(ring.begin(), ring.end(), vertex);
    return flat[static_cast<std::size_t>(place - ring.begin())];
  }
  FlatPoint at(const CarrierPoint& point) const {
    FlatPoint out;
    for (std::size_t k = 0; k < point.size(); ++k) {
      const DiskPoint corner = at(point.corner[k]);
      out.x += Wide{corner[0]} * point.weight[k];
      out.y += Wide{corner[1]} * point.weight[k];
    }
    return out;
  }
};

std::vector<Diagonal> diagonals_of(const std::vector<scene::Triangle>& closing, const Disk& disk) {
  std::vector<scene::Edge> edges;
  for (const auto& t : closing) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(scene::edge_of(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Diagonal> out;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    if (edges[k] != edges[k + 1]) continue;
    out.push_back({edges[k][0], edges[k][1], disk.at(edges[k][0]), disk.at(edges[k][1])});
  }
  return out;
}

bool holds(const std::array<DiskPoint, 3>& corners, const FlatPoint& point, Wide threefold) {
  for (std::size_t k = 0; k < 3; ++k) {
    const DiskPoint &a = corners[k], &b = corners[(k + 1) % 3];
    const Wide dx = point.x - threefold * a[0] * scene::whole_weight,
               dy = point.y - threefold * a[1] * scene::whole_weight;
    if ((b[0] - a[0]) * dy - (b[1] - a[1]) * dx < 0) return false;
  }
  return true;
}

}  // namespace

std::optional<CarrierPoint> weights_in(const scene::Triangle& triangle, const std::array<DiskPoint, 3>& corners,
                                       const FlatPoint& point) {
  const Wide area = exact::orientation(corners[0], corners[1], corners[2]);
  std::array<Wide, 3> parts;  // of a point outside they may be any size
  for (std::size_t k = 0; k < 3; ++k) parts[k] = exact::orientation(corners[(k + 1) % 3], corners[(k + 2) % 3], point);
  if (*std::min_element(parts.begin(), parts.end()) < 0) return std::nullopt;
  std::array<std::pair<std::uint32_t, std::int64_t>, 3> weights;
  std::int64_t left = scene::whole_weight;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] = {triangle[k], static_cast<std::int64_t>(parts[k] / area)};
    if (parts[k] > 0 && weights[k].second == 0) return std::nullopt;
    left -= weights[k].second;
  }
  return exact::rounded_point(weights, left);
}

Overlay::Overlay(const scene::TriangleMesh& input)
    : input_vertices_(input.points.size()), input_triangles_(input.triangles), count_(input.triangles.size()) {
  for (std::uint32_t v = 0; v < input.points.size(); ++v) points_.push_back({scene::at_vertex(v), scene::at_vertex(v)});
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t) pieces_.push_back({{input.triangles[t], t}});
}

bool Overlay::carry(std::uint32_t vertex, const StarShape& shape, const FlatStar& flat,
                    const std::vector<scene::Triangle>& closing) {
  const Disk disk{vertex, shape.ring.vertices, flat.ring};
  StarPieces star;
  std::size_t old_count = 0;
  for (const std::uint32_t number : shape.ring.triangles) old_count += pieces_[number].size();
  star.pieces.reserve(2 * old_count);
  star.points.reserve(2 * old_count);
  place_.resize(points_.size(), scene::no_vertex);
  for (const std::uint32_t number : shape.ring.triangles) {
    for (const auto& piece : pieces_[number]) {
      StarPiece local{{}, piece.input, false};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t point = piece.corners[k];
        if (place_[point] == scene::no_vertex) {
          place_[point] = static_cast<std::uint32_t>(star.points.size());
          star.points.push_back({point, point < input_vertices_, points_[point], disk.at(points_[point].image)});
        }
        local.corners[k] = place_[point];
      }
      star.pieces.push_back(local);
    }
  }
  for (const StarPoint& point : star.points) place_[point.number] = scene::no_vertex;
  for (const Diagonal& diagonal : diagonals_of(closing, disk)) {
    if (!cut_along(diagonal, star)) return false;
  }

  std::vector<std::array<DiskPoint, 3>> corners;
  for (const auto& t : closing) corners.push_back({disk.at(t[0]), disk.at(t[1]), disk.at(t[2])});
  for (StarPoint& point : star.points) {
    if (point.at.image.weight_of(vertex) == 0) continue;  // on the border, or introduced on a diagonal
    std::optional<CarrierPoint> image;
    for (std::size_t t = 0; t < closing.size() && !image; ++t) {
      if (holds(corners[t], point.flat, 1)) {
        image = weights_in(closing[t], corners[t], point.flat);
        if (!image) return false;
      }
    }
    if (!image) return false;
    point.at.image = *image;
  }
  std::vector<std::vector<StarPiece>> by_triangle(closing.size());
  for (const StarPiece& piece : star.pieces) {
    FlatPoint sum;
    for (const std::uint32_t v : piece.corners) {
      sum.x += star.points[v].flat.x;
      sum.y += star.points[v].flat.y;
    }
    std::size_t t = 0;
    while (t < closing.size() && !holds(corners[t], sum, 3)) ++t;
    if (t == closing.size()) return false;
    const auto &a = star.points[piece.corners[0]].at, &b = star.points[piece.corners[1]].at,
               &c = star.points[piece.corners[2]].at;
    if (!lies_in(closing[t], a.image) || !lies_in(closing[t], b.image) || !lies_in(closing[t], c.image)) return false;
    if (exact::orientation_in(closing[t], a.image, b.image, c.image) <= 0) return false;
    if (piece.cut && exact::orientation_in(input_triangles_[piece.input], a.source, b.source, c.source) <= 0)
      return false;
    by_triangle[t].push_back(piece);
  }
  for (std::size_t t = 0; t < closing.size(); ++t) simplify(closing[t], input_triangles_, star, by_triangle[t]);

  // Nothing can fail any more.
  for (const StarPoint& point : star.points) {
    if (point.number != scene::no_vertex) points_[point.number] = point.at;
  }
  for (const std::uint32_t number : shape.ring.triangles) std::vector<scene::OverlayTriangle>().swap(pieces_[number]);
  count_ -= old_count;
  for (const auto& pieces : by_triangle) {
    auto& out = pieces_.emplace_back();
    for (const StarPiece& piece : pieces) out.push_back(numbered(piece, star, points_));
    count_ += pieces.size();
  }
  return true;
}

void Overlay::write_to(const std::vector<std::uint32_t>& triangles, scene::Hierarchy& hierarchy) const {
  std::vector<std::uint32_t> number(points_.size(), scene::no_vertex);
  hierarchy.points.assign(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(input_vertices_));
  for (std::uint32_t v = 0; v < input_vertices_; ++v) number[v] = v;
  hierarchy.pieces.clear();
  for (const std::uint32_t t : triangles) {
    for (scene::OverlayTriangle piece : pieces_[t]) {
      for (std::uint32_t& v : piece.corners) {
        if (number[v] == scene::no_vertex) {
          number[v] = static_cast<std::uint32_t>(hierarchy.points.size());
          hierarchy.points.push_back(points_[v]);
        }
        v = number[v];
      }
      hierarchy.pieces.push_back(piece);
    }
  }
}

}  // namespace clues::reference
