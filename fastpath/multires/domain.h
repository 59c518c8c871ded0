// K^l (D31) as arrays: the triangles by number, and the star of each vertex as a stretch of one array, anew for every level. What is asked within a
// level is asked of it as it is at that moment; a level that has to be decided again is taken back as a whole.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::fastpath::multires {

class Domain {
 public:
  // Throws Error unsupported where the triangles are no surface (D31), with a vertex at which they are not. O(n).
  Domain(const scene::TriangleMesh& mesh, const std::string& name);

  std::size_t triangle_count() const { return count_; }
  // Numbers are never used twice, and grow.
  const std::vector<scene::Triangle>& triangles() const { return triangles_; }
  // Ascending numbers.
  std::span<const std::uint32_t> star(std::uint32_t vertex) const {
    const Stretch& s = stretches_[vertex];
    return {pool_.data() + s.begin, s.size};
  }
  bool has_edge(std::uint32_t a, std::uint32_t b) const;
  bool has_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool is_open(std::uint32_t vertex) const { return open_[vertex]; }  // on the boundary; no removal changes that

  // Takes the star of the vertex away, and puts these triangles in its place, numbered as they follow.
  void replace(std::uint32_t vertex, std::span<const scene::Triangle> closing);

  // A level ends: what was replaced since the last one is final; or is taken back.
  void end_level();
  void take_back();

  std::vector<std::uint32_t> triangles_left() const;  // ascending numbers

 private:
  struct Stretch {
    std::size_t begin = 0;
    std::uint32_t size = 0, room = 0;
  };
  void lay_out_stars();
  void add(std::uint32_t vertex, std::uint32_t triangle);
  void check_fan(std::uint32_t vertex, std::vector<std::uint32_t>& next, const std::string& name);

  std::vector<scene::Triangle> triangles_;
  std::vector<std::uint8_t> gone_;
  std::vector<std::uint32_t> left_;   // those that the level began with
  std::vector<std::uint32_t> taken_;  // those that it took away
  std::size_t first_of_level_ = 0;    // number of the first that it added
  std::size_t count_ = 0;
  std::vector<Stretch> stretches_;  // by vertex
  std::vector<std::uint32_t> pool_;
  std::vector<bool> open_;
};

}  // namespace clues::fastpath::multires
