// The spherical Delaunay mesh (A1.5) of one viewpoint: samples go in by location and flips, and out by a new triangulation of their star, every decision
// by exactly decided signs. Nothing is normalised. Where four samples are cocircular, the diagonal from the one with the least number is
// taken, so that the mesh depends on the samples and their numbers only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fastpath/motion/bounds/predicates.h"
#include "fastpath/motion/sphere_mesh.h"

namespace clues::fastpath::motion {

// The rows of all samples from one viewpoint, made when they are first asked for.
class View {
 public:
  explicit View(const SphereMesh& mesh) : mesh_(&mesh) {}

  void look_from(const MotionPoint& at);
  void forget(std::uint32_t vertex);  // whose sample is another one now
  const MotionPoint& at() const { return at_; }
  const Row& row(std::uint32_t vertex) const {
    if (vertex >= stamps_.size() || stamps_[vertex] != now_) make(vertex);
    return rows_[vertex];
  }
  Seen seen(std::uint32_t vertex) const {
    const Row& r = row(vertex);
    return {&mesh_->samples()[vertex], &r};
  }

 private:
  void make(std::uint32_t vertex) const;

  const SphereMesh* mesh_;
  MotionPoint at_{};
  mutable std::vector<Row> rows_;
  mutable std::vector<std::uint32_t> stamps_;
  std::uint32_t now_ = 1;
};

class Triangulation {
 public:
  // The base mesh alone, seen from a finite viewpoint. Throws scene::Error.
  Triangulation(const scene::MotionThresholds& thresholds, const MotionPoint& at);

  SphereMesh& mesh() { return mesh_; }
  const SphereMesh& mesh() const { return mesh_; }
  Constraints& constraints() { return constraints_; }
  View& view() { return view_; }
  const View& view() const { return view_; }

  int facing(const View& view, std::uint32_t a, std::uint32_t b, std::uint32_t c);
  bool edge_holds(std::uint32_t a, std::uint32_t b);
  bool face_holds(std::uint32_t f);  // facing, edges, separations
  // The sign of the edge opposite of corner i.
  int delaunay(std::uint32_t f, std::size_t i);

  // A sample into the mesh, in which all triangles face view(): its number; or kNone where a constraint forbids it: a vertex too near, the
  // viewpoint itself. Flips around it while an edge is not locally Delaunay. `from`: a face near it, if one is known.
  // Expected O(1) after location, which is a walk from that face. `base`: the number of the base vertex that it is.
  std::uint32_t insert(const scene::DepthSample& sample, std::uint32_t from = kNone, std::uint32_t base = kNone);

  // The face that holds the direction of a vertex of which the row is known, present or not; a walk from that face. kNone where there is no face with it.
  std::uint32_t face_holding(std::uint32_t vertex, std::uint32_t from);

  // A face at the base vertex whose direction is nearest to that of the sample, as doubles tell: where to begin a walk to it.
  std::uint32_t face_towards(const scene::DepthSample& sample) const;

  // Takes a vertex away, with a triangulation of its star that faces `view`; of the possible triangles those first that face the second
  // view, with short edges. False, and nothing is changed, where none was found (the star does not fit in a half sphere).
  bool remove(std::uint32_t vertex, const View& view, const View& preferred);

  // Flips while there is an edge of these faces, or of those that flips change, that is not locally Delaunay; `allowed` may refuse an edge.
  // All faces face view(). Returns the number of flips.
  template <class Allowed>
  std::uint64_t legalise(std::vector<std::uint32_t>& faces, const Allowed& allowed);

  std::uint64_t flips = 0;

 private:
  struct Place {
    std::uint32_t face = kNone;
    int zeros = 0;
    std::size_t edge = 0;  // with one zero: the edge opposite of this corner holds the sample
  };
  Place locate(const Seen& sample, std::uint32_t from);
  bool wants_flip(std::uint32_t f, std::size_t i);

  Constraints constraints_;
  SphereMesh mesh_;
  View view_;
  std::uint32_t base_vertices_;  // the first so many
  SphereMesh::Star star_, inner_star_;
  // Of the polygon that remove() cuts ears from, and the ears.
  struct Corner {
    std::uint32_t place;  // in the ring
    Seen seen;
    const Row* row;  // as the preferred view sees it
  };
  std::vector<Corner> corners_;
  std::vector<std::array<std::uint32_t, 3>> ears_;
  std::vector<std::uint32_t> stack_;
  std::uint32_t last_ = 0;
};

template <class Allowed>
std::uint64_t Triangulation::legalise(std::vector<std::uint32_t>& faces, const Allowed& allowed) {
  std::uint64_t count = 0;
  while (!faces.empty()) {
    const std::uint32_t f = faces.back();
    faces.pop_back();
    if (!mesh_.face(f).alive()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t g = mesh_.face(f).across[i];
      if (!allowed(f, g) || !wants_flip(f, i)) continue;
      mesh_.flip(f, i);
      ++count;
      faces.push_back(g);
      faces.push_back(f);
      break;
    }
  }
  flips += count;
  return count;
}

}  // namespace clues::fastpath::motion
