#include "validate/multires/level_topology.h"

#include <fmt/format.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>

namespace clues::validate {
namespace {

struct NoAttributes : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::None);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::None);
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<NoAttributes>;

}  // namespace

LevelTopology topology_of(const std::vector<scene::Triangle>& triangles, std::size_t vertices) {
  ::omerr().disable();  // it tells standard error what we tell our caller
  LevelTopology out;
  HalfEdges mesh;
  std::vector<HalfEdges::VertexHandle> handles(vertices);
  std::vector<std::uint32_t> numbers;
  for (const auto& t : triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      out.defect = fmt::format("triangle ({}, {}, {}) has a vertex twice", t[0], t[1], t[2]);
      return out;
    }
    for (const std::uint32_t v : t) {
      if (handles[v].is_valid()) continue;
      handles[v] = mesh.add_vertex({0, 0, 0});
      numbers.push_back(v);
    }
  }
  for (const auto& t : triangles) {
    if (!mesh.add_face(handles[t[0]], handles[t[1]], handles[t[2]]).is_valid()) {
      out.defect = fmt::format(
          "triangle ({}, {}, {}) has an edge that two other triangles share, or runs through one against its "
          "neighbour, or meets others at a vertex only",
          t[0], t[1], t[2]);
      return out;
    }
  }
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_manifold(v)) {
      out.defect =
          fmt::format("several fans of triangles meet at vertex {}", numbers[static_cast<std::size_t>(v.idx())]);
      return out;
    }
  }
  std::vector<bool> seen(mesh.n_halfedges(), false);
  for (const auto h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) || seen[static_cast<std::size_t>(h.idx())]) continue;
    ++out.boundaries;
    for (HalfEdges::HalfedgeHandle at = h; !seen[static_cast<std::size_t>(at.idx())];
         at = mesh.next_halfedge_handle(at)) {
      seen[static_cast<std::size_t>(at.idx())] = true;
    }
  }
  out.vertices = static_cast<std::int64_t>(mesh.n_vertices());
  out.edges = static_cast<std::int64_t>(mesh.n_edges());
  out.triangles = static_cast<std::int64_t>(mesh.n_faces());
  return out;
}

std::vector<std::uint32_t> vertices_without_triangle(const std::vector<scene::Triangle>& triangles,
                                                     std::size_t vertices) {
  std::vector<bool> used(vertices, false);
  for (const auto& t : triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  std::vector<std::uint32_t> out;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!used[v]) out.push_back(v);
  }
  return out;
}

std::optional<scene::Triangle> triangle_there_twice(std::vector<scene::Triangle> triangles) {
  for (auto& t : triangles) std::sort(t.begin(), t.end());
  std::sort(triangles.begin(), triangles.end());
  const auto twice = std::adjacent_find(triangles.begin(), triangles.end());
  if (twice == triangles.end()) return std::nullopt;
  return *twice;
}

}  // namespace clues::validate
