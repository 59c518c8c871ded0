// Defects are looked for in a fixed order, so that the same file always gets the same message.
#include "reference/multires/stars/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using scene::Triangle;

struct EdgeUse {
  std::uint32_t a, b;  // ascending
  std::uint32_t triangle;
  bool forward;  // the triangle runs from a to b
};

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw scene::Error(scene::ErrorCode::unsupported, name + ": " + what);
}

void check_triangles(const scene::TriangleMesh& mesh, const std::string& name) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    std::sort(corners.begin(), corners.end());
    if (corners[0] == corners[1] || corners[1] == corners[2]) {
      refuse(name, fmt::format("triangle {}: vertex {} is two of its corners; take the triangle out", t, corners[1]));
    }
    sorted.emplace_back(corners, t);
  }
  std::sort(sorted.begin(), sorted.end());
  std::uint32_t first = 0, second = 0xffffffff;
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k].first == sorted[k - 1].first && sorted[k].second < second) {
      first = sorted[k - 1].second;
      second = sorted[k].second;
    }
  }
  if (second != 0xffffffff) {
    refuse(name, fmt::format("triangles {} and {} have the same three vertices; take one of them out", first, second));
  }
}

std::vector<EdgeUse> edge_uses(const scene::TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& p, const EdgeUse& q) {
    return std::tie(p.a, p.b, p.triangle) < std::tie(q.a, q.b, q.triangle);
  });
  return uses;
}

// Whether turning triangles round could orient the component: a walk over its edges that meets no contradiction.
bool can_be_oriented(const scene::TriangleMesh& mesh, const std::vector<EdgeUse>& uses) {
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> next(
      mesh.triangles.size());  // bool: to be turned against each other
  for (std::size_t k = 0; k + 1 < uses.size(); ++k) {
    const EdgeUse &p = uses[k], &q = uses[k + 1];
    if (p.a != q.a || p.b != q.b) continue;
    next[p.triangle].emplace_back(q.triangle, p.forward == q.forward);
    next[q.triangle].emplace_back(p.triangle, p.forward == q.forward);
  }
  std::vector<signed char> turned(mesh.triangles.size(), -1);
  for (std::uint32_t start = 0; start < mesh.triangles.size(); ++start) {
    if (turned[start] >= 0) continue;
    turned[start] = 0;
    std::vector<std::uint32_t> waiting{start};
    while (!waiting.empty()) {
      const std::uint32_t t = waiting.back();
      waiting.pop_back();
      for (const auto& [other, against] : next[t]) {
        const auto wanted = static_cast<signed char>(against ? 1 - turned[t] : turned[t]);
        if (turned[other] < 0) {
          turned[other] = wanted;
          waiting.push_back(other);
        } else if (turned[other] != wanted) {
          return false;
        }
      }
    }
  }
  return true;
}

// How many boundary edges there are.
std::uint64_t check_edges(const scene::TriangleMesh& mesh, const std::vector<EdgeUse>& uses, SurfaceCensus& census,
                          const std::string& name) {
  std::uint64_t open = 0;
  const EdgeUse* against = nullptr;
  for (std::size_t k = 0; k < uses.size();) {
    std::size_t end = k;
    while (end < uses.size() && uses[end].a == uses[k].a && uses[end].b == uses[k].b) ++end;
    ++census.edges;
    if (end - k > 2) {
      refuse(
          name,
          fmt::format(
              "the edge from vertex {} to vertex {} belongs to {} triangles ({}, {}, {}{}), a surface has one or two; "
              "split the mesh there",
              uses[k].a, uses[k].b, end - k, uses[k].triangle, uses[k + 1].triangle, uses[k + 2].triangle,
              end - k > 3 ? ", ..." : ""));
    }
    if (end - k == 1) ++open;
    if (end - k == 2 && uses[k].forward == uses[k + 1].forward && against == nullptr) against = &uses[k];
    k = end;
  }
  if (against != nullptr) {
    refuse(name,
           fmt::format("triangles {} and {} run through the edge from vertex {} to vertex {} in the same direction; {}",
                       against->triangle, (against + 1)->triangle, against->a, against->b,
                       can_be_oriented(mesh, uses) ? "orient the triangles alike"
                                                   : "the surface has one side only (like a Moebius strip)"));
  }
  return open;
}

std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

// The triangles at each vertex are one fan: as many runs as triangles, joined over the edges at the vertex.
void check_vertices(const scene::TriangleMesh& mesh, const std::vector<EdgeUse>& uses, const std::string& name) {
  const std::size_t corners = 3 * mesh.triangles.size();
  std::vector<std::uint32_t> parent(corners);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto corner_at = [&](std::uint32_t t, std::uint32_t v) {
    std::uint32_t k = 0;
    while (mesh.triangles[t][k] != v) ++k;
    return 3 * t + k;
  };
  for (std::size_t k = 0; k + 1 < uses.size(); ++k) {
    const EdgeUse &p = uses[k], &q = uses[k + 1];
    if (p.a != q.a || p.b != q.b) continue;
    for (const std::uint32_t v : {p.a, p.b}) {
      parent[find_root(parent, corner_at(p.triangle, v))] = find_root(parent, corner_at(q.triangle, v));
    }
  }
  std::vector<std::uint32_t> fan(mesh.points.size(), 0xffffffff), first(mesh.points.size(), 0),
      fans(mesh.points.size(), 0);
  std::vector<std::uint32_t> second(mesh.points.size(), 0);
  for (std::uint32_t c = 0; c < corners; ++c) {
    const std::uint32_t v = mesh.triangles[c / 3][c % 3], root = find_root(parent, c);
    if (fans[v] == 0) {
      fan[v] = root;
      first[v] = c / 3;
      fans[v] = 1;
    } else if (root != fan[v] && fans[v] == 1) {
      second[v] = c / 3;
      fans[v] = 2;
    }
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (fans[v] == 0) refuse(name, fmt::format("vertex {} belongs to no triangle; take it out", v));
    if (fans[v] == 2) {
      refuse(name,
             fmt::format(
                 "vertex {}: several fans of triangles meet there and in no edge (triangles {} and {}); give each a "
                 "vertex of its own",
                 v, first[v], second[v]));
    }
  }
}

}  // namespace

SurfaceCensus checked_surface(const scene::TriangleMesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) refuse(name, "no triangles; there is no surface");
  check_triangles(mesh, name);
  const auto uses = edge_uses(mesh);
  SurfaceCensus census;
  const std::uint64_t open = check_edges(mesh, uses, census, name);
  check_vertices(mesh, uses, name);
  census.vertices = mesh.points.size();
  census.triangles = mesh.triangles.size();
  // Components over all edges; loops over boundary edges, of which a boundary vertex has two.
  std::vector<std::uint32_t> all(mesh.points.size()), rim(mesh.points.size());
  std::iota(all.begin(), all.end(), 0U);
  std::iota(rim.begin(), rim.end(), 0U);
  census.components = census.vertices;
  std::uint64_t joined = 0;
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const auto join = [](std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
      const std::uint32_t p = find_root(parent, a), q = find_root(parent, b);
      parent[p] = q;
      return p != q;
    };
    if (join(all, uses[k].a, uses[k].b)) --census.components;
    const bool shared = (k > 0 && uses[k - 1].a == uses[k].a && uses[k - 1].b == uses[k].b) ||
                        (k + 1 < uses.size() && uses[k + 1].a == uses[k].a && uses[k + 1].b == uses[k].b);
    if (!shared && join(rim, uses[k].a, uses[k].b)) ++joined;
  }
  census.boundaries = open - joined;  // a loop of n edges joins n - 1 times
  return census;
}

}  // namespace clues::reference
