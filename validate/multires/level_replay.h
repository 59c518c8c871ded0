// The triangles of a level as a set, for the judge: who takes what away and puts what in its place.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::validate {

class TriangleSet {
 public:
  TriangleSet(const std::vector<scene::Triangle>& triangles, std::size_t vertices);

  // Whether the triangle is there, oriented so.
  bool has(const scene::Triangle& oriented) const;
  bool has_vertices(scene::Triangle corners) const;
  void insert(const scene::Triangle& oriented);
  void erase(const scene::Triangle& oriented);

  std::size_t triangles_at(std::uint32_t v) const { return count_[v]; }
  const std::map<std::uint32_t, int>& neighbours(std::uint32_t v) const { return edges_[v]; }
  bool has_edge(std::uint32_t a, std::uint32_t b) const { return edges_[a].count(b) != 0; }
  std::vector<scene::Triangle> all() const;

 private:
  void count(const scene::Triangle& t, int by);
  std::set<scene::Triangle> triangles_;  // each from its lowest vertex
  std::vector<std::size_t> count_;
  std::vector<std::map<std::uint32_t, int>> edges_;  // to each neighbour: how many triangles
};

// Whether a polygon of these vertices has a triangulation without edges and triangles that the surface has: combinatorially.
bool has_free_triangulation(const std::vector<std::uint32_t>& polygon, const TriangleSet& surface);

}  // namespace clues::validate
