#include "reference/multires/smoothing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "reference/multires/overlay.h"
#include "reference/multires/stars/combination.h"
#include "reference/multires/stars/priority.h"
#include "reference/multires/stars/star_pieces.h"

namespace clues::reference {
namespace {

using exact::DiskPoint;
using exact::FlatPoint;
using exact::Wide;
using scene::CarrierPoint;

FlatPoint flat_of(const DiskPoint& p) { return {Wide{p[0]} * scene::whole_weight, Wide{p[1]} * scene::whole_weight}; }

// Of two points of the finer grid and a third one, whose area has more than 128 bits.
mpz_class area_of(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return to_integer(b.x - a.x) * to_integer(c.y - a.y) - to_integer(b.y - a.y) * to_integer(c.x - a.x);
}

// How far Loop's rule draws a vertex of n neighbours to the sum of these.
double loop_weight(std::size_t n) {
  const double c = 3.0 / 8 + std::cos(2 * std::numbers::pi / static_cast<double>(n)) / 4;
  return (5.0 / 8 - c * c) / static_cast<double>(n);
}

class Smoother {
 public:
  Smoother(Remesh& remesh, const scene::Hierarchy& h, const SmoothingOptions& options)
      : remesh_(remesh), h_(h), options_(options), complex_(remesh.mesh), points_(remesh.proof.points) {
    estimates_.points = exact::points_for_estimates(h.input);
    for (const CarrierPoint& source : remesh.sources) places_.push_back(position_estimate(source, estimates_));
    for (std::size_t t = 0; t < remesh.mesh.triangles.size(); ++t) {
      const auto first = remesh.proof.pieces.begin() + static_cast<std::ptrdiff_t>(remesh.first_piece[t]),
                 end = remesh.proof.pieces.begin() + static_cast<std::ptrdiff_t>(remesh.first_piece[t + 1]);
      pieces_.emplace_back(first, end);
    }
    features_.insert(h.features.begin(), h.features.end());
    kept_.insert(h.fixed.begin(), h.fixed.end());
    for (const scene::Edge& e : h.features) kept_.insert(e.begin(), e.end());
  }

  std::uint64_t run() {
    std::uint64_t moves = 0;
    const std::uint64_t vertices = remesh_.mesh.points.size();
    for (int round = 0; round < options_.rounds; ++round) {
      for (std::uint32_t v = 0; v < vertices; ++v) {
        if (move(v)) ++moves;
        if (options_.progress)
          options_.progress(static_cast<std::uint64_t>(round) * vertices + v + 1,
                            vertices * static_cast<std::uint64_t>(options_.rounds));
      }
    }
    write();
    return moves;
  }

 private:
  bool stays(const CarrierPoint& source) const {
    if (source.size() == 1) return kept_.count(source.corner[0]) != 0;
    return source.size() == 2 && features_.count({source.corner[0], source.corner[1]}) != 0;
  }

  bool move(std::uint32_t v) {
    if (stays(remesh_.sources[v])) return false;
    StarShape shape;
    shape.ring = complex_.ring(v);
    if (shape.ring.open && remesh_.proof.parameters[v].size() == 1) return false;
    if (shape.ring.open) shape.kind = scene::StarKind::boundary;
    const auto layouts = flattenings(shape, v, places_);
    if (layouts.empty()) return false;
    const FlatStar& flat = layouts.front();
    std::array<double, 2> target{};
    if (shape.ring.open) {
      target[0] = (static_cast<double>(flat.ring.front()[0]) + static_cast<double>(flat.ring.back()[0])) / 8;
    } else {
      const double weight = loop_weight(flat.ring.size());
      for (const DiskPoint& p : flat.ring) {
        for (std::size_t i = 0; i < 2; ++i) target[i] += weight * static_cast<double>(p[i]);
      }
    }
    for (const double part : {1.0, 0.5, 0.25}) {
      const DiskPoint to{std::llround(part * target[0]), std::llround(part * target[1])};
      if (to == DiskPoint{0, 0}) return false;
      if (carry(v, shape.ring, flat, to)) return true;
    }
    return false;
  }

  // The star laid out, with its middle taken to another place in it. False, and nothing has changed: a sign or the grid forbids it.
  bool carry(std::uint32_t v, const Ring& ring, const FlatStar& flat, const DiskPoint& to) {
    const std::size_t sectors = ring.triangles.size(), n = ring.vertices.size();
    for (std::size_t k = 0; k < sectors; ++k) {
      if (exact::orientation(to, flat.ring[k], flat.ring[(k + 1) % n]) <= 0) return false;
    }
    // The vertex has another number while it is in two places.
    const auto moved = v + static_cast<std::uint32_t>(remesh_.mesh.points.size());
    StarPieces star = gathered(v, ring, flat);
    if (!insert(moved, to, star)) return false;
    const std::size_t before = star.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      if (!cut_along({moved, ring.vertices[k], to, flat.ring[k]}, star)) return false;
    }
    std::vector<scene::Triangle> closing;
    std::vector<std::array<DiskPoint, 3>> corners;
    for (std::size_t k = 0; k < sectors; ++k) {
      closing.push_back({moved, ring.vertices[k], ring.vertices[(k + 1) % n]});
      corners.push_back({to, flat.ring[k], flat.ring[(k + 1) % n]});
    }
    for (std::size_t p = 0; p < before; ++p) {
      StarPoint& point = star.points[p];
      if (point.at.image.weight_of(v) == 0) continue;
      std::optional<CarrierPoint> image;
      for (std::size_t t = 0; t < sectors && !image; ++t) image = weights_in(closing[t], corners[t], point.flat);
      if (!image) return false;
      point.at.image = *image;
    }
    std::vector<std::vector<StarPiece>> by_triangle(sectors);
    for (const StarPiece& piece : star.pieces) {
      const auto t = triangle_of(piece, star, closing);
      if (!t) return false;
      by_triangle[*t].push_back(piece);
    }
    simplify_star(closing, moved, h_.input.triangles, star, by_triangle);
    take_over(v, moved, ring, star, by_triangle);
    return true;
  }

  StarPieces gathered(std::uint32_t v, const Ring& ring, const FlatStar& flat) const {
    StarPieces star;
    std::map<std::uint32_t, std::uint32_t> place;
    for (const std::uint32_t number : ring.triangles) {
      for (const auto& piece : pieces_[number]) {
        StarPiece local{{}, piece.input, false};
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t p = piece.corners[k];
          local.corners[k] = local_number(p, place, star.points, [&] {
            const auto& at = points_[p];
            FlatPoint in_disk;
            for (std::size_t c = 0; c < at.image.size(); ++c) {
              if (at.image.corner[c] == v) continue;
              const auto corner = std::find(ring.vertices.begin(), ring.vertices.end(), at.image.corner[c]);
              const DiskPoint& q = flat.ring[static_cast<std::size_t>(corner - ring.vertices.begin())];
              in_disk.x += Wide{q[0]} * at.image.weight[c];
              in_disk.y += Wide{q[1]} * at.image.weight[c];
            }
            return StarPoint{p, at.source.size() == 1, at, in_disk};
          });
        }
        star.pieces.push_back(local);
      }
    }
    return star;
  }

  // Makes the place of the vertex a point of the pieces, so that no edge from it begins inside of one.
  static bool insert(std::uint32_t moved, const DiskPoint& to, StarPieces& star) {
    StarPoint point;
    point.flat = flat_of(to);
    point.at.image = scene::at_vertex(moved);
    const std::size_t count = star.pieces.size();
    bool made = false;
    const auto fresh = static_cast<std::uint32_t>(star.points.size());
    for (std::size_t i = 0; i < count; ++i) {
      const StarPiece piece = star.pieces[i];
      std::array<mpz_class, 3> part;
      bool inside = true;
      for (std::size_t k = 0; k < 3 && inside; ++k) {
        part[k] = area_of(star.points[piece.corners[(k + 1) % 3]].flat, star.points[piece.corners[(k + 2) % 3]].flat,
                          point.flat);
        inside = part[k] >= 0;
      }
      if (!inside) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (part[(k + 1) % 3] != 0 || part[(k + 2) % 3] != 0) continue;
        star.points[piece.corners[k]].at.image = point.at.image;  // there is one already
        return true;
      }
      if (!made) {
        const auto source = source_in(piece, part, star);
        if (!source) return false;
        point.at.source = *source;
        star.points.push_back(point);
        made = true;
      }
      cut_from(fresh, i, part, star);
    }
    return made;
  }

  // The new triangle that all corners of a piece lie in, where both signs are right.
  std::optional<std::size_t> triangle_of(const StarPiece& piece, const StarPieces& star,
                                         const std::vector<scene::Triangle>& closing) const {
    const auto &a = star.points[piece.corners[0]].at, &b = star.points[piece.corners[1]].at,
               &c = star.points[piece.corners[2]].at;
    const auto& input = h_.input.triangles[piece.input];
    if (piece.cut && (!lies_in(input, a.source) || !lies_in(input, b.source) || !lies_in(input, c.source) ||
                      exact::orientation_in(input, a.source, b.source, c.source) <= 0)) {
      return std::nullopt;
    }
    for (std::size_t t = 0; t < closing.size(); ++t) {
      if (!lies_in(closing[t], a.image) || !lies_in(closing[t], b.image) || !lies_in(closing[t], c.image)) continue;
      if (exact::orientation_in(closing[t], a.image, b.image, c.image) > 0) return t;
    }
    return std::nullopt;
  }

  // Nothing can fail any more.
  void take_over(std::uint32_t v, std::uint32_t moved, const Ring& ring, StarPieces& star,
                 const std::vector<std::vector<StarPiece>>& by_triangle) {
    for (StarPoint& point : star.points) {
      CarrierPoint& image = point.at.image;
      if (image == scene::at_vertex(moved)) remesh_.sources[v] = point.at.source;
      image = with_number(image, moved, v);
      if (point.number != scene::no_vertex) points_[point.number] = point.at;
    }
    places_[v] = position_estimate(remesh_.sources[v], estimates_);
    for (std::size_t t = 0; t < by_triangle.size(); ++t) {
      auto& out = pieces_[ring.triangles[t]];
      out.clear();
      for (const StarPiece& piece : by_triangle[t]) out.push_back(numbered(piece, star, points_));
    }
  }
  static CarrierPoint with_number(const CarrierPoint& p, std::uint32_t old, std::uint32_t now) {
    if (p.weight_of(old) == 0) return p;
    std::array<std::pair<std::uint32_t, std::int64_t>, 3> weights;
    for (std::size_t k = 0; k < 3; ++k) weights[k] = {p.corner[k] == old ? now : p.corner[k], p.weight[k]};
    std::sort(weights.begin(), weights.end());
    CarrierPoint out;
    for (std::size_t k = 0; k < 3; ++k) std::tie(out.corner[k], out.weight[k]) = weights[k];
    return out;
  }

  // Pieces, positions and bounds of what has come out.
  void write() {
    scene::RemeshProof& proof = remesh_.proof;
    for (std::size_t v = 0; v < remesh_.sources.size(); ++v)
      remesh_.mesh.points[v] = remesh_position(remesh_.sources[v], h_.input, options_.single);
    proof.pieces.clear();
    proof.near.clear();
    proof.points.clear();
    proof.to_remesh = proof.to_input = 0;
    std::vector<std::uint32_t> numbers(points_.size(), scene::no_vertex);
    for (std::size_t t = 0; t < pieces_.size(); ++t) {
      const auto& corners = remesh_.mesh.triangles[t];
      Patch patch;
      patch.triangle = corners;
      for (std::size_t k = 0; k < 3; ++k) patch.corners[k] = scene::at_vertex(corners[k]);
      std::map<std::uint32_t, std::uint32_t> local;
      for (scene::OverlayTriangle piece : pieces_[t]) {
        StarPiece copy{{}, piece.input, false};
        for (std::size_t k = 0; k < 3; ++k) {
          std::uint32_t& p = piece.corners[k];
          copy.corners[k] = local_number(p, local, patch.pieces.points, [&] {
            return StarPoint{p, false, points_[p], {}};
          });
          if (numbers[p] == scene::no_vertex) {
            numbers[p] = static_cast<std::uint32_t>(proof.points.size());
            proof.points.push_back(points_[p]);
          }
          p = numbers[p];
        }
        patch.pieces.pieces.push_back(copy);
        proof.pieces.push_back(piece);
      }
      remesh_.first_piece[t + 1] = proof.pieces.size();
      add_error(patch, remesh_.mesh, corners, h_.input, proof);
    }
  }

  Remesh& remesh_;
  const scene::Hierarchy& h_;
  const SmoothingOptions& options_;
  const StarComplex complex_;
  std::vector<scene::OverlayVertex> points_;
  std::vector<std::vector<scene::OverlayTriangle>> pieces_;  // by triangle of the remesh
  scene::TriangleMesh estimates_;                            // the input as layouts see it
  std::vector<scene::Point> places_;                         // of the vertices, there
  std::set<scene::Edge> features_;
  std::set<std::uint32_t> kept_;
};

}  // namespace

std::uint64_t smooth(Remesh& remesh, const scene::Hierarchy& hierarchy, const SmoothingOptions& options) {
  return Smoother(remesh, hierarchy, options).run();
}

NeighbourAngles neighbour_angles_estimate(const scene::TriangleMesh& mesh) {
  std::vector<std::optional<scene::Point>> normals;
  for (const auto& t : mesh.triangles) {
    scene::Point u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = mesh.points[t[1]][i] - mesh.points[t[0]][i];
      v[i] = mesh.points[t[2]][i] - mesh.points[t[0]][i];
    }
    scene::Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double& x : n) x /= length;
    normals.push_back(length > 0 && std::isfinite(length) ? std::optional(n) : std::nullopt);
  }
  std::map<scene::Edge, std::size_t> sides;
  NeighbourAngles out;
  double sum = 0;
  std::uint64_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [side, fresh] =
          sides.try_emplace(scene::edge_of(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]), t);
      if (fresh || !normals[t] || !normals[side->second]) continue;
      const auto &a = *normals[t], &b = *normals[side->second];
      const double angle =
          std::acos(std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0, 1.0)) * 180 / std::numbers::pi;
      out.largest = std::max(out.largest, angle);
      sum += angle;
      ++count;
    }
  }
  out.mean = count > 0 ? sum / static_cast<double>(count) : 0;
  return out;
}

}  // namespace clues::reference
