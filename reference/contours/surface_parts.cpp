#include "reference/contours/surface_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "scene/mesh/mesh_edges.h"

namespace clues::reference {
namespace {

using exact::FT;
using exact::Point2;

// An edge of the scene, by the numbers of its ends; points with the same coordinates have one number.
using SceneEdge = std::pair<std::uint32_t, std::uint32_t>;

// From 0 at the smaller end of the edge to 1 at the other.
struct Stretch {
  FT from, to;
};

// What runs along an edge on one side of a triangle.
struct Along {
  std::vector<std::pair<Stretch, std::size_t>> parts;
  std::vector<Stretch> cuts;
};

// Where a point of the segment from a to b lies.
FT place_on(const Point2& a, const Point2& b, const Point2& p) {
  return a.x() != b.x() ? (p.x() - a.x()) / (b.x() - a.x()) : (p.y() - a.y()) / (b.y() - a.y());
}

class EdgeTable {
 public:
  EdgeTable(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh)
      : mesh_(mesh), number_(scene::numbers_of_places(mesh)) {
    std::set<std::uint32_t> seen;
    for (const InputSide& side : sides) {
      if (!seen.insert(side.triangle).second) continue;
      for (std::size_t k = 0; k < 3; ++k) users_[edge(side.triangle, k)].push_back(side.triangle);
    }
  }

  SceneEdge edge(std::uint32_t triangle, std::size_t k) const {
    const auto [a, b] = ends(triangle, k);
    return {std::min(a, b), std::max(a, b)};
  }
  bool runs_up(std::uint32_t triangle, std::size_t k) const {
    const auto [a, b] = ends(triangle, k);
    return a < b;
  }
  // The side that continues this one over its edge k.
  std::optional<std::pair<std::uint32_t, bool>> neighbour(const InputSide& side, std::size_t k) const {
    const auto& users = users_.at(edge(side.triangle, k));
    if (users.size() != 2 || users[0] == users[1]) return std::nullopt;
    const std::uint32_t other = users[0] == side.triangle ? users[1] : users[0];
    for (std::size_t j = 0; j < 3; ++j) {
      if (edge(other, j) != edge(side.triangle, k)) continue;
      const bool same_turn = runs_up(other, j) != runs_up(side.triangle, k);
      return std::pair(other, side.front == same_turn);
    }
    return std::nullopt;
  }

 private:
  SceneEdge ends(std::uint32_t triangle, std::size_t k) const {
    const auto& corners = mesh_.triangles[triangle];
    return {number_[corners[k]], number_[corners[(k + 1) % 3]]};
  }

  const scene::TriangleMesh& mesh_;
  std::vector<std::uint32_t> number_;
  std::map<SceneEdge, std::vector<std::uint32_t>> users_;
};

// Stretches of both, one for each pair that overlaps, without what is cut on either side.
std::vector<std::pair<Stretch, std::pair<std::size_t, std::size_t>>> overlaps(const Along& one, const Along& other) {
  std::vector<FT> ends;
  for (const Along* side : {&one, &other}) {
    for (const auto& [s, part] : side->parts) ends.insert(ends.end(), {s.from, s.to});
    for (const Stretch& s : side->cuts) ends.insert(ends.end(), {s.from, s.to});
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const auto holds = [](const Stretch& s, const FT& from, const FT& to) { return s.from <= from && to <= s.to; };
  std::vector<std::pair<Stretch, std::pair<std::size_t, std::size_t>>> out;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const FT &from = ends[i], &to = ends[i + 1];
    bool cut = false;
    for (const Along* side : {&one, &other}) {
      for (const Stretch& s : side->cuts) cut |= holds(s, from, to);
    }
    if (cut) continue;
    for (const auto& [a, part_a] : one.parts) {
      if (!holds(a, from, to)) continue;
      for (const auto& [b, part_b] : other.parts) {
        if (holds(b, from, to)) out.push_back({{from, to}, {part_a, part_b}});
      }
    }
  }
  return out;
}

}  // namespace

SurfaceParts::SurfaceParts(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                           const std::vector<FlatSet>& sets, const std::vector<SideSegment>& cuts) {
  const EdgeTable edges(sides, mesh);
  std::vector<std::vector<FlatSegment>> cuts_on(sides.size());
  for (const SideSegment& cut : cuts) cuts_on[cut.side].push_back(cut.at);
  std::map<std::pair<std::uint32_t, bool>, std::size_t> side_of;
  std::vector<std::array<Along, 3>> along(sides.size());
  std::vector<std::array<std::array<Point2, 2>, 3>> ends(sides.size());  // of the edges, the smaller end first
  for (std::size_t s = 0; s < sides.size(); ++s) {
    side_of[{sides[s].triangle, sides[s].front}] = s;
    const TriangleFrame frame = frame_of(mesh, sides[s].triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = [&](std::size_t i) { return frame.frame()(frame.corners()[i % 3]); };
      ends[s][k] = {corner(k), corner(k + 1)};
      if (!edges.runs_up(sides[s].triangle, k)) std::swap(ends[s][k][0], ends[s][k][1]);
    }
    // The edge that a segment runs along, and where.
    const auto on_edge = [&](const Point2& p, const Point2& q) -> std::optional<std::pair<std::size_t, Stretch>> {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& [a, b] = ends[s][k];
        if (!CGAL::collinear(a, b, p) || !CGAL::collinear(a, b, q)) continue;
        const auto [from, to] = std::minmax({place_on(a, b, p), place_on(a, b, q)});
        return std::pair(k, Stretch{from, to});
      }
      return std::nullopt;
    };
    for (const FlatSegment& cut : cuts_on[s]) {
      if (const auto at = on_edge(cut.a, cut.b)) along[s][at->first].cuts.push_back(at->second);
    }
    for (Face2& face : sets[s].faces_cut_by(cuts_on[s])) {
      for (const Ring2& ring : face) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          if (const auto at = on_edge(ring[i], ring[(i + 1) % ring.size()]))
            along[s][at->first].parts.emplace_back(at->second, parts_.size());
        }
      }
      parts_.push_back({s, std::move(face)});
    }
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto next = edges.neighbour(sides[s], k);
      if (!next || !side_of.contains(*next) || side_of[*next] < s) continue;
      const std::size_t other = side_of[*next];
      for (std::size_t j = 0; j < 3; ++j) {
        if (edges.edge(sides[other].triangle, j) != edges.edge(sides[s].triangle, k)) continue;
        const auto& [a, b] = ends[s][k];
        for (const auto& [stretch, pair] : overlaps(along[s][k], along[other][j])) {
          const FlatSegment at{a + (b - a) * stretch.from, a + (b - a) * stretch.to};
          joins_.push_back({pair.first, pair.second, {s, at}});
        }
      }
    }
  }
}

std::vector<std::size_t> SurfaceParts::components() const {
  std::vector<std::size_t> first(parts_.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto root = [&first](std::size_t i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  for (const Join& join : joins_) {
    const auto [a, b] = std::minmax({root(join.one), root(join.other)});
    first[b] = a;
  }
  std::vector<std::size_t> number(parts_.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) number[i] = root(i) == i ? next++ : number[root(i)];
  return number;
}

}  // namespace clues::reference
