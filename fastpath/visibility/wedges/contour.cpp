#include "fastpath/visibility/wedges/contour.h"

#include "fastpath/visibility/wedges/on_wedge.h"

namespace clues::fastpath {

namespace {

struct Support {
  const Plane* plane = nullptr;
  std::vector<int> left, right;  // touching vertices on either side of the line, seen from the plane's positive side
};

// Up to two; none when the line of the edge meets int V.
std::vector<Support> supporting_planes(const LocalScene& scene, Pool& pool, const LocalEdge& edge) {
  const ExactPoint &a = scene.points[edge.a], &b = scene.points[edge.b];
  const auto& s = scene.cell.vertices;
  std::vector<Support> found;
  for (const int turn : {1, -1}) {
    // Seen along the line V spans at most a half turn, unless the line passes through int V; its end is found by comparison.
    int end = -1;
    bool passed = false;
    // Twice: the ends of a half turn are not told apart, so that one may be passed over the first time.
    for (int round = 0; round < 2; ++round) {
      for (int i = 0; i < static_cast<int>(s.size()); ++i) {
        const ExactPoint& x = s[static_cast<std::size_t>(i)];
        if (end < 0) {
          if (!collinear(a, b, x)) end = i;
        } else if (orientation(a, b, s[static_cast<std::size_t>(end)], x) == turn) {
          end = i;
        }
      }
    }
    if (end < 0) return {};
    const ExactPoint& m = s[static_cast<std::size_t>(end)];
    std::vector<int> on{end};
    for (int i = 0; i < static_cast<int>(s.size()) && !passed; ++i) {
      if (i == end) continue;
      const int o = orientation(a, b, m, s[static_cast<std::size_t>(i)]);
      passed = o == turn;
      if (o == 0 && !collinear(a, b, s[static_cast<std::size_t>(i)])) on.push_back(i);
    }
    if (passed) return {};
    Support support;
    support.plane = turn > 0 ? pool.plane(a, b, m) : pool.plane(b, a, m);
    const OnWedge frame{support.plane, &a, {}, {}, {}, {}, {}, {}};
    for (const int i : on)
      (frame.turn(&b, &s[static_cast<std::size_t>(i)]) > 0 ? support.left : support.right).push_back(i);
    std::sort(support.left.begin(), support.left.end());
    std::sort(support.right.begin(), support.right.end());
    found.push_back(std::move(support));
    // With touching vertices on both sides of the line both ends of V lie in this plane, unless all of V does.
    const Support& last = found.back();
    if (last.left.empty() || last.right.empty()) continue;
    bool flat = true;
    for (const ExactPoint& x : s) flat &= last.plane->side(x) == 0;
    if (!flat) break;
  }
  return found;
}

// What an edge is a contour for.
std::vector<ContourEdge> contours_of(const LocalScene& scene, std::uint32_t id, Pool& pool) {
  std::vector<ContourEdge> contour;
  const LocalEdge& edge = scene.edges[id];
  if (edge.pieces.empty()) return contour;
  const ExactPoint &a = scene.points[edge.a], &b = scene.points[edge.b];
  const std::vector<Support> supports = supporting_planes(scene, pool, edge);
  for (std::size_t k = 0; k < supports.size(); ++k) {
    const Plane* plane = supports[k].plane;
    const OnWedge frame{plane, &a, {}, {}, {}, {}, {}, {}};
    bool in_h_plus = true, left = false, right = false;
    for (const std::uint32_t t : edge.pieces) {
      for (const std::uint32_t c : scene.pieces[t].corners) {
        if (c == edge.a || c == edge.b) continue;
        const int side = plane->side(scene.points[c]);
        in_h_plus &= side <= 0;
        if (side == 0) (frame.turn(&b, &scene.points[c]) > 0 ? left : right) = true;
      }
      if (!in_h_plus) break;
    }
    // With the plane's surface on both sides the edge is a seam of a flat surface: a wedge that reaches it runs on over it.
    if (!in_h_plus || (left && right)) continue;
    const Plane* other = supports.size() == 2 ? supports[1 - k].plane : nullptr;
    const bool holds_cell = scene.cell.lies_in(*plane);
    if (!supports[k].left.empty()) contour.push_back({id, plane, supports[k].left, other, holds_cell});
    if (!supports[k].right.empty()) contour.push_back({id, plane, supports[k].right, other, holds_cell});
  }
  return contour;
}

}  // namespace

std::vector<ContourEdge> contour_edges(const LocalScene& scene, Workers& workers) {
  std::vector<std::vector<ContourEdge>> found(scene.edges.size());
  workers.for_each(found.size(), [&](std::size_t i, Workers::Worker& worker) {
    found[i] = contours_of(scene, static_cast<std::uint32_t>(i), worker.pool);
  });
  std::vector<ContourEdge> contour;
  for (auto& list : found) std::move(list.begin(), list.end(), std::back_inserter(contour));
  return contour;
}

}  // namespace clues::fastpath
