// FIGS. 36, 42 and the summary's "boundary edges": the same with whole triangles, for lists (D26). A flood runs over
// triangles that have an edge in common, from a seed for each connected part of the wanted list, within a known one, and
// passes no edge of the boundary: that are those with wanted and other known triangles at them. It needs no numbers, so
// the client that has doubles only finds the list exactly. All triangles at an edge are neighbours, however many.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh_edges.h"

namespace clues::reference {

// The edges of a scene, by points with the same coordinates.
class EdgeUsers {
 public:
  explicit EdgeUsers(const scene::TriangleMesh& mesh);  // O(n log n)

  const std::vector<std::uint32_t>& at(std::uint32_t edge) const { return users_[edge]; }  // triangles, ascending
  std::uint32_t edge(std::uint32_t triangle, std::size_t k) const { return edges_.edge(triangle, k); }
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(users_.size()); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(edges_.triangle_count()); }

 private:
  scene::MeshEdges edges_;
  std::vector<std::vector<std::uint32_t>> users_;
};

struct ListContour {
  std::vector<std::uint32_t> seeds;     // triangles, ascending
  std::vector<std::uint32_t> boundary;  // edges, ascending

  friend bool operator==(const ListContour&, const ListContour&) = default;
};

// For many lists of one scene: what is marked is taken back, so that a list costs what it has, and not what the scene has.
// Keeps a reference.
class ListFloods {
 public:
  explicit ListFloods(const EdgeUsers& edges);  // O(n)

  // Lists ascending, `wanted` a part of `known`. O(known + wanted log wanted), where edges have few triangles.
  ListContour contour(const std::vector<std::uint32_t>& known, const std::vector<std::uint32_t>& wanted);
  // With all seeds and edges `wanted`; with fewer edges more, with fewer seeds less. Ascending.
  std::vector<std::uint32_t> list(const std::vector<std::uint32_t>& known, const ListContour& contour);

 private:
  enum class Place : std::uint8_t { outside, known, wanted };

  void mark(const std::vector<std::uint32_t>& triangles, Place place);
  void block(const std::vector<std::uint32_t>& boundary, bool blocked);
  bool is_boundary(std::uint32_t edge) const;
  void flood(std::uint32_t from, std::vector<std::uint32_t>& reached);

  const EdgeUsers* edges_;
  std::vector<Place> place_;   // between two calls: outside,
  std::vector<bool> blocked_;  // and no edge
};

// For one list: O(n) more.
ListContour list_contour(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                         const std::vector<std::uint32_t>& wanted);
std::vector<std::uint32_t> flooded_list(const EdgeUsers& edges, const std::vector<std::uint32_t>& known,
                                        const ListContour& contour);

// Differences as varints: seeds, then edges. Throws scene::Error malformed, for numbers that the scene does not have too.
std::string to_bytes(const ListContour& contour);
ListContour parse_list_contour(std::string_view bytes, const EdgeUsers& edges);

}  // namespace clues::reference
