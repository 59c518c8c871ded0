// The drawing of one side as a plane graph, and which sides of its edges bound the same face, in doubles.
//
// A drawing hangs together (contour_file.h), so the border of each face is one closed walk: along an edge to a point, and
// there on along the next edge in the order of directions. Which points are one is known from their numbers. What is left
// for doubles is the order of directions at a point with three edges or more, and that of points on an edge. Where boxes
// do not tell it, the point is "wild": all sides of all edges there count as one face. Two points of an edge whose order
// is not known are one wild point. So sides of one face are always found to be of one; sides of two may be, at wild
// points only. A face more in a flood is the only thing that can come of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fastpath/contours/interval_drawing.h"

namespace clues::fastpath {

// Sets of numbers that are joined one by one.
class JoinedNumbers {
 public:
  explicit JoinedNumbers(std::size_t count);
  std::uint32_t root(std::uint32_t i) {
    while (first_[i] != i) i = first_[i] = first_[first_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    first_[a < b ? b : a] = a < b ? a : b;
  }

 private:
  std::vector<std::uint32_t> first_;
};

struct FlatBox {
  Interval x, y;
};

// The places of directions in counter-clockwise order, from the first on; none where boxes do not tell it.
std::optional<std::vector<std::size_t>> turning_order(const std::vector<FlatBox>& directions);

// In which coordinate the two are farthest apart, 0 to 2: the same from both ends, as of an edge that two sides share each goes its
// own way.
int longest_axis(const Box3& a, const Box3& b);

class SideGraph {
 public:
  // Sides of edges have numbers from 0 on, 2 e on the left of edge e and 2 e + 1 on its right; behind them each point has
  // one, for faces at wild points that have no edge left. Each is an atom.
  struct Edge {
    std::array<std::uint32_t, 2> ends{};    // vertices
    std::array<std::uint32_t, 2> points{};  // of the drawing, where it begins and ends; of a cluster one of them
    FlatBox direction{};
    int level = 0;  // of a segment; -1: of an edge of the triangle
    bool is_bridge = false;
  };
  // Where points are on an edge of the triangle: one, or several that cannot be told apart.
  struct Stop {
    std::uint32_t vertex = 0;
    std::vector<std::uint32_t> points;
  };
  struct OnEdge {
    std::vector<Stop> stops;           // from corner k to the next
    std::vector<std::uint32_t> edges;  // between two stops; none: there is no edge between them
  };

  explicit SideGraph(const IntervalSide& drawn);

  std::size_t atoms() const { return 2 * edges_.size() + drawn_->points.size(); }
  std::uint32_t atom_of_vertex(std::uint32_t vertex) const {
    return static_cast<std::uint32_t>(2 * edges_.size() + vertex);
  }
  std::uint32_t inner_atom(std::uint32_t edge) const {
    return 2 * edge + (inside_is_left_ ? 0 : 1);
  }  // of the triangle's
  bool is_outer(std::uint32_t atom) const;
  bool is_used(std::uint32_t atom) const;  // of a vertex: a wild one

  const IntervalSide& drawn() const { return *drawn_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const OnEdge& on_edge(std::size_t k) const { return on_edges_[k]; }
  std::uint32_t vertex_of(std::uint32_t point) const { return vertex_[point]; }
  bool is_wild(std::uint32_t vertex) const { return wild_[vertex]; }
  std::uint64_t wild_count() const;
  Box3 box_of_vertex(std::uint32_t vertex) const;  // around all points that it is
  FlatBox flat(std::uint32_t point) const { return flat(drawn_->points[point].at); }
  FlatBox flat(const Box3& at) const;
  std::array<int, 2> axes() const { return axes_; }

  // Joins atoms of one face of what is drawn up to this level, `first` being the number of the first atom.
  void join_faces(int level, std::uint32_t first, JoinedNumbers& joined) const;
  // Atoms of which one is of the face that begins at the point in this direction.
  std::vector<std::uint32_t> atoms_towards(std::uint32_t point, const FlatBox& direction, int level) const;

 private:
  struct Out {
    std::uint32_t edge = 0;
    bool forth = true;
  };
  FlatBox direction_of(const Out& out) const;
  std::uint32_t left_of(const Out& out) const { return 2 * out.edge + (out.forth ? 0 : 1); }
  std::uint32_t right_of(const Out& out) const { return 2 * out.edge + (out.forth ? 1 : 0); }
  // Adds the line with the points that are on it; in order, or as wild ones.
  OnEdge add_line(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& between, int level,
                  bool is_bridge);
  std::optional<std::vector<Out>> in_order(const std::vector<Out>& outs) const;

  const IntervalSide* drawn_;
  std::array<int, 2> axes_{};
  bool inside_is_left_ = true;
  std::vector<std::uint32_t> vertex_;  // of each point, the first point of those it is one with
  std::vector<bool> wild_;
  std::vector<Edge> edges_;
  std::array<OnEdge, 3> on_edges_;
  std::vector<std::vector<Out>> outs_;                  // of each vertex
  std::vector<std::optional<std::vector<Out>>> order_;  // counter-clockwise, of those with three and more
};

}  // namespace clues::fastpath
