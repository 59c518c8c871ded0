// A triangulated sphere as a table: faces with their corners and neighbours. Topology only; which face may be cut or joined is for the
// caller to say (triangulation.h). Numbers of removed faces and vertices are used again, the last one first.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/motion/depth_mesh.h"

namespace clues::fastpath::motion {

inline constexpr std::uint32_t kNone = 0xffffffffU;

struct Face {
  std::array<std::uint32_t, 3> corner{kNone, kNone, kNone};  // counter-clockwise from inside
  std::array<std::uint32_t, 3> across{kNone, kNone,
                                      kNone};  // across[i]: the face beyond the edge opposite of corner[i]

  bool alive() const { return corner[0] != kNone; }
  std::size_t place_of(std::uint32_t vertex) const { return corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2; }
  std::size_t place_of_face(std::uint32_t face) const { return across[0] == face ? 0 : across[1] == face ? 1 : 2; }
};

class SphereMesh {
 public:
  // A closed oriented surface, each edge of two triangles; throws scene::Error otherwise.
  explicit SphereMesh(const scene::DepthMesh& mesh);

  const std::vector<Face>& faces() const { return faces_; }
  const Face& face(std::uint32_t f) const { return faces_[f]; }
  const std::vector<scene::DepthSample>& samples() const { return samples_; }
  bool is_vertex(std::uint32_t v) const { return face_of_[v] != kNone; }
  std::uint32_t face_of(std::uint32_t v) const { return face_of_[v]; }  // some face at v
  std::size_t face_count() const { return faces_.size() - free_faces_.size(); }
  // Base vertices that are out for a while count, too: they keep their numbers.
  std::size_t vertex_count() const { return samples_.size() - free_vertices_.size(); }

  std::uint32_t add_vertex(const scene::DepthSample& sample);  // in no face yet
  void forget_vertex(std::uint32_t v);                         // that is in no face

  // A vertex into a face: three faces; into the edge opposite of corner i: four.
  void split_face(std::uint32_t f, std::uint32_t vertex);
  void split_edge(std::uint32_t f, std::size_t i, std::uint32_t vertex);
  // The edge opposite of corner i of f, for the other diagonal. The two corners across must not be joined by an edge yet.
  void flip(std::uint32_t f, std::size_t i);

  // The faces around v, counter-clockwise, and the corners after v in each of them: edge k of the polygon goes from ring[k] to ring[k + 1].
  struct Star {
    std::vector<std::uint32_t> faces, ring;
  };
  void star_of(std::uint32_t v, Star& star) const;
  // Takes v and its star away and puts triangles of places in the ring there: ring.size() - 2 of them, a triangulation of the polygon.
  void replace_star(std::uint32_t v, const Star& star, std::span<const std::array<std::uint32_t, 3>> triangles);

  // Faces that were made or got other corners, in order, some more than once, until they are cleared. Some may be gone again.
  std::vector<std::uint32_t>& changed() { return changed_; }

  // What is left, with vertices numbered anew; `numbers`, if given, gets the old number of each.
  scene::DepthMesh to_depth_mesh(std::vector<std::uint32_t>* numbers = nullptr) const;

 private:
  std::uint32_t new_face();
  void set(std::uint32_t f, const std::array<std::uint32_t, 3>& corner, const std::array<std::uint32_t, 3>& across);
  void join(std::uint32_t f, std::uint32_t instead_of, std::uint32_t g);  // of face f

  std::vector<Face> faces_;
  std::vector<scene::DepthSample> samples_;
  std::vector<std::uint32_t> face_of_;
  std::vector<std::uint32_t> free_faces_, free_vertices_, changed_;
};

}  // namespace clues::fastpath::motion
