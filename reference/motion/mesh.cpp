// Loops over the triangles of a mesh.
#include "reference/motion/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using Rows = std::vector<exact::SightRow>;

Rows rows_of(const scene::DepthMesh& mesh, const ExactViewpoint& v) {
  Rows rows;
  rows.reserve(mesh.samples.size());
  for (const auto& sample : mesh.samples) rows.push_back(exact::sight_row(sample, v));
  return rows;
}

// Of each directed edge: how often, and the vertex that its (last) triangle has besides.
struct EdgeUse {
  std::uint64_t times = 0;
  std::uint32_t besides = no_opposite;
};
using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse>;

Edges edges_of(const scene::DepthMesh& mesh) {
  Edges edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& use = edges[{t[k], t[(k + 1) % 3]}];
      ++use.times;
      use.besides = t[(k + 2) % 3];
    }
  }
  return edges;
}

// Two triangles that go from `a` to `b`, and any that go back: which of them is beyond the edge nobody has said.
[[noreturn]] void refuse_edge(const scene::DepthMesh& mesh, std::uint32_t a, std::uint32_t b) {
  std::string triangles;
  for (std::size_t i = 0, named = 0; i < mesh.triangles.size() && named < 3; ++i) {
    const auto& t = mesh.triangles[i];
    if (std::count(t.begin(), t.end(), a) == 0 || std::count(t.begin(), t.end(), b) == 0) continue;
    triangles.append(named++ == 0 ? "" : ", ").append(std::to_string(i));
  }
  throw scene::Error(
      scene::ErrorCode::bad_argument,
      fmt::format("Delaunay bounds: the edge {}-{} is in more than one triangle in this direction (triangles {})", a, b,
                  triangles));
}

using Opposite = std::vector<std::array<std::uint32_t, 3>>;

// Nothing where nobody asks: any mesh has the other bounds.
Opposite opposite_where_asked(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds) {
  return thresholds.delaunay ? opposite_samples(mesh) : Opposite();
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> opposite_samples(const scene::DepthMesh& mesh) {
  const auto edges = edges_of(mesh);
  for (const auto& [edge, use] : edges) {
    if (use.times > 1) refuse_edge(mesh, edge.first, edge.second);
  }
  std::vector<std::array<std::uint32_t, 3>> out;
  out.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    auto& across = out.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto there = edges.find({t[(k + 1) % 3], t[k]});
      across[k] = there != edges.end() ? there->second.besides : no_opposite;
    }
  }
  return out;
}

DepthMeshState depth_mesh_state(const scene::DepthMesh& mesh, const ExactViewpoint& v) {
  DepthMeshState state;
  const auto edges = edges_of(mesh);
  for (const auto& [edge, use] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (use.times != 1 || back == edges.end() || back->second.times != 1) ++state.open_edges;
  }
  const auto rows = rows_of(mesh, v);
  for (const auto& t : mesh.triangles) {
    if (exact::facing_sign(rows[t[0]], rows[t[1]], rows[t[2]]) <= 0) ++state.not_facing;
  }
  if (state.open_edges != 0 || state.not_facing != 0 || mesh.triangles.empty()) return state;
  // Strictly inside of the first triangle. Whatever other triangle holds it, even on its border, covers it once more: all triangles
  // count positively (T7).
  exact::SightRow middle;
  for (const auto corner : mesh.triangles[0]) {
    for (std::size_t i = 0; i < 3; ++i) middle.x[i] += rows[corner].x[i];
  }
  for (const auto& t : mesh.triangles) {
    const auto &a = rows[t[0]], &b = rows[t[1]], &c = rows[t[2]];
    if (exact::facing_sign(middle, b, c) >= 0 && exact::facing_sign(a, middle, c) >= 0 &&
        exact::facing_sign(a, b, middle) >= 0) {
      ++state.degree;
    }
  }
  return state;
}

std::vector<scene::ConstraintPlace> violations(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds,
                                               const ExactViewpoint& v) {
  using scene::MotionConstraint;
  const ExactThresholds limits(thresholds);
  const auto rows = rows_of(mesh, v);
  const auto opposite = opposite_where_asked(mesh, thresholds);
  std::vector<scene::ConstraintPlace> out;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const auto corner = [&](std::size_t k) -> const exact::SightRow& { return rows[t[k % 3]]; };
    if (exact::facing_sign(corner(0), corner(1), corner(2)) <= 0) out.push_back({MotionConstraint::facing, i, 0});
    for (std::uint8_t k = 0; k < 3; ++k) {
      if (!exact::edge_length_holds(corner(k), corner(k + 1U), limits)) {
        out.push_back({MotionConstraint::edge_length, i, k});
      }
    }
    for (std::uint8_t k = 0; k < 3; ++k) {
      if (!exact::separation_holds(corner(k), corner(k + 1U), corner(k + 2U), limits)) {
        out.push_back({MotionConstraint::separation, i, k});
      }
    }
    for (std::uint8_t k = 0; thresholds.delaunay && k < 3; ++k) {
      if (opposite[i][k] == no_opposite) continue;
      if (exact::delaunay_sign(corner(0), corner(1), corner(2), rows[opposite[i][k]]) < 0) {
        out.push_back({MotionConstraint::delaunay, i, k});
      }
    }
  }
  return out;
}

std::vector<double> motion_bounds(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds,
                                  const ExactViewpoint& v) {
  const ExactThresholds limits(thresholds);
  const auto opposite = opposite_where_asked(mesh, thresholds);
  std::vector<double> out;
  out.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const auto corner = [&](std::size_t k) -> const DepthSample& { return mesh.samples[t[k % 3]]; };
    double bound = facing_bound(corner(0), corner(1), corner(2), v);
    for (std::size_t k = 0; k < 3; ++k) {
      bound = std::min(bound, edge_bound(corner(k), corner(k + 1), v, limits));
      bound = std::min(bound, separation_bound(corner(k), corner(k + 1), corner(k + 2), v, limits));
      if (thresholds.delaunay && opposite[i][k] != no_opposite) {
        bound = std::min(bound, delaunay_bound(corner(0), corner(1), corner(2), mesh.samples[opposite[i][k]], v));
      }
    }
    out.push_back(bound);
  }
  return out;
}

}  // namespace clues::reference
