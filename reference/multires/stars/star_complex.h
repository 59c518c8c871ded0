// K^l (D31): triangles over the vertices of the input, with the star of each vertex. Only what one step of the hierarchy asks and does: rings,
// "is there such an edge or face", and a star replaced by the triangles that close its hole. Stars are short lists, looked
// through from end to end.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::reference {

// The vertices around a vertex, counter-clockwise, from the lowest one (closed) or from one end to the other (open).
struct Ring {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> triangles;  // number k lies between vertices k and k + 1
  bool open = false;
};

class StarComplex {
 public:
  explicit StarComplex(const scene::TriangleMesh& surface);  // checked_surface() holds

  std::size_t vertex_count() const { return stars_.size(); }  // of the input
  std::size_t triangle_count() const { return count_; }
  // Numbers of triangles are never used twice; those of triangles that are gone have no meaning.
  const scene::Triangle& triangle(std::uint32_t number) const { return triangles_[number]; }
  const std::vector<scene::Triangle>& triangles() const { return triangles_; }
  const std::vector<std::uint32_t>& star(std::uint32_t vertex) const { return stars_[vertex]; }
  bool has_vertex(std::uint32_t vertex) const { return !stars_[vertex].empty(); }

  Ring ring(std::uint32_t vertex) const;
  std::size_t degree(std::uint32_t vertex) const;  // neighbours
  bool has_edge(std::uint32_t a, std::uint32_t b) const;
  bool has_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  // Takes the vertex away with its star; returns the number of the first of the new triangles, which follow each other.
  std::uint32_t replace(std::uint32_t vertex, const std::vector<scene::Triangle>& triangles);

  std::vector<std::uint32_t> triangles_left() const;  // their numbers, ascending

 private:
  std::vector<scene::Triangle> triangles_;
  std::vector<std::vector<std::uint32_t>> stars_;  // ascending numbers
  std::vector<bool> gone_;
  std::size_t count_ = 0;
};

}  // namespace clues::reference
