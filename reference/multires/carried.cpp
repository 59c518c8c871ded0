#include "reference/multires/carried.h"

#include <cmath>
#include <map>
#include <optional>

namespace clues::reference {
namespace {

using scene::CarrierPoint;
using scene::Triangle;
using Texture = std::array<double, 2>;

double part(std::int64_t weight) { return std::ldexp(static_cast<double>(weight), -scene::weight_bits); }

class Carrier {
 public:
  Carrier(const Remesh& remesh, const scene::TriangleMesh& input, const scene::MeshAttributes& from)
      : remesh_(remesh), input_(input), from_(from) {}

  CarriedAttributes run() {
    if (!from_.colours.empty()) colours();
    if (!from_.texture_corners.empty()) {
      for (std::uint32_t t = 0; t < remesh_.mesh.triangles.size(); ++t) texture(t);
    }
    return std::move(out_);
  }

 private:
  void colours() {
    for (const CarrierPoint& source : remesh_.sources) {
      auto& colour = out_.attributes.colours.emplace_back();
      for (std::size_t k = 0; k < source.size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) colour[i] += part(source.weight[k]) * from_.colours[source.corner[k]][i];
      }
    }
  }

  // At a point of an input triangle.
  std::optional<Texture> texture_at(const CarrierPoint& source, std::uint32_t input) const {
    const Triangle &corners = input_.triangles[input], &texture = from_.texture_corners[input];
    Texture out{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (texture[k] == scene::no_vertex) return std::nullopt;
      const double weight = part(source.weight_of(corners[k]));
      for (std::size_t i = 0; i < 2; ++i) out[i] += weight * from_.texture[texture[k]][i];
    }
    return out;
  }

  void texture(std::uint32_t t) {
    const auto& proof = remesh_.proof;
    const Triangle& corners = remesh_.mesh.triangles[t];
    std::array<std::optional<Texture>, 3> at;
    std::map<scene::Edge, std::uint32_t> sides;  // of pieces: the input triangle on the side that came first
    bool jumps = false;
    for (std::size_t i = remesh_.first_piece[t]; i < remesh_.first_piece[t + 1]; ++i) {
      const auto& piece = proof.pieces[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& point = proof.points[piece.corners[k]];
        for (std::size_t c = 0; c < 3; ++c) {
          if (!at[c] && point.image == scene::at_vertex(corners[c])) at[c] = texture_at(point.source, piece.input);
        }
        const std::uint32_t a = piece.corners[k], b = piece.corners[(k + 1) % 3];
        const auto [side, fresh] = sides.try_emplace(scene::edge_of(a, b), piece.input);
        if (fresh || side->second == piece.input) continue;
        for (const std::uint32_t p : {a, b}) {
          const auto& source = proof.points[p].source;
          jumps = jumps || texture_at(source, side->second) != texture_at(source, piece.input);
        }
      }
    }
    Triangle numbers{scene::no_vertex, scene::no_vertex, scene::no_vertex};
    if (at[0] && at[1] && at[2]) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [place, fresh] = numbers_.try_emplace(std::make_pair(corners[c], *at[c]),
                                                         static_cast<std::uint32_t>(out_.attributes.texture.size()));
        if (fresh) out_.attributes.texture.push_back(*at[c]);
        numbers[c] = place->second;
      }
      if (jumps) ++out_.across_seams;
    }
    out_.attributes.texture_corners.push_back(numbers);
  }

  const Remesh& remesh_;
  const scene::TriangleMesh& input_;
  const scene::MeshAttributes& from_;
  std::map<std::pair<std::uint32_t, Texture>, std::uint32_t> numbers_;
  CarriedAttributes out_;
};

}  // namespace

CarriedAttributes carried(const Remesh& remesh, const scene::TriangleMesh& input,
                          const scene::MeshAttributes& attributes) {
  return Carrier(remesh, input, attributes).run();
}

}  // namespace clues::reference
