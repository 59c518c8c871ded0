#include "fastpath/visibility/scene/surface_vertices.h"

#include <algorithm>

namespace clues::fastpath {
namespace {

class Neighbourhood {
 public:
  Neighbourhood(const LocalScene& scene, std::uint32_t x) : scene_(scene), x_(x) {}

  bool has_vertex() {
    for (const std::uint32_t e : scene_.point_edges[x_]) {
      if (!runs_through_a_flat_face(e)) line_.push_back(e);
    }
    if (line_.empty()) return !is_one_disc();
    return !(line_.size() == 2 && is_straight() && all_are_half_discs());
  }

 private:
  std::uint32_t other_end(std::uint32_t e) const {
    return scene_.edges[e].a == x_ ? scene_.edges[e].b : scene_.edges[e].a;
  }
  std::uint32_t corner_beside(std::uint32_t t, std::uint32_t e) const {
    const LocalEdge& edge = scene_.edges[e];
    return *std::find_if(scene_.pieces[t].corners.begin(), scene_.pieces[t].corners.end(),
                         [&](std::uint32_t c) { return c != edge.a && c != edge.b; });
  }

  // Two pieces of one plane: on either side of the edge, as pieces of a complex do not overlap.
  bool runs_through_a_flat_face(std::uint32_t e) const {
    const std::vector<std::uint32_t>& pieces = scene_.edges[e].pieces;
    return pieces.size() == 2 && scene_.planes[pieces[0]].side(scene_.points[corner_beside(pieces[1], e)]) == 0;
  }

  // The other edge at x of a piece.
  std::uint32_t next_edge(std::uint32_t t, std::uint32_t e) const {
    for (const std::uint32_t other : scene_.pieces[t].edges) {
      if (other != e && (scene_.edges[other].a == x_ || scene_.edges[other].b == x_)) return other;
    }
    return e;
  }
  // From piece to piece through a flat face, from an edge at x on, until that edge or one of the line is met; the pieces are counted.
  std::uint32_t end_of_face(std::uint32_t t, std::uint32_t from, std::size_t& pieces) const {
    std::uint32_t e = from;
    for (;;) {
      ++pieces;
      e = next_edge(t, e);
      if (e == from || std::find(line_.begin(), line_.end(), e) != line_.end()) return e;
      const std::vector<std::uint32_t>& both = scene_.edges[e].pieces;
      t = both[0] == t ? both[1] : both[0];
    }
  }

  bool is_one_disc() const {
    const std::uint32_t e = scene_.point_edges[x_].front();
    std::size_t pieces = 0;
    return end_of_face(scene_.edges[e].pieces[0], e, pieces) == e && pieces == scene_.point_pieces[x_].size();
  }

  bool is_straight() const {
    const ExactPoint &x = scene_.points[x_], &p = scene_.points[other_end(line_[0])],
                     &q = scene_.points[other_end(line_[1])];
    if (!collinear(p, x, q)) return false;
    int axis = 0;
    while (axis < 2 && compare_coordinate(p, q, axis) == 0) ++axis;
    return compare_coordinate(p, x, axis) * compare_coordinate(x, q, axis) > 0;
  }

  bool all_are_half_discs() const {
    std::size_t pieces = 0;
    for (const std::uint32_t t : scene_.edges[line_[0]].pieces) {
      if (end_of_face(t, line_[0], pieces) != line_[1]) return false;
    }
    return scene_.edges[line_[0]].pieces.size() == scene_.edges[line_[1]].pieces.size() &&
           pieces == scene_.point_pieces[x_].size();
  }

  const LocalScene& scene_;
  const std::uint32_t x_;
  std::vector<std::uint32_t> line_;  // the edges at x that are no part of a flat face's inside
};

}  // namespace

std::vector<bool> surface_vertices(const LocalScene& scene) {
  std::vector<bool> found(scene.points.size(), false);
  for (std::uint32_t x = 0; x < found.size(); ++x)
    found[x] = !scene.point_edges[x].empty() && Neighbourhood(scene, x).has_vertex();
  return found;
}

}  // namespace clues::fastpath
