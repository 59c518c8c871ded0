#include "fastpath/visibility/search/circles.h"

#include <algorithm>
#include <array>

#include "exact/strong_components.h"

namespace clues::fastpath {

namespace {

// Who may wait for whom: a part for what is on the ways from V to one of its points, in front of that. No way leads back: what it comes through before an edge is in H+ of
// the planes that support V there, and what it comes to after that is in H-.
class Waiting {
 public:
  Waiting(const LocalScene& scene, const std::vector<ContourEdge>& contours, const std::vector<Sources::OfEdge>& parts)
      : contours_(contours), parts_(parts) {
    IntervalBox cell = scene.cell.vertices.front().approximate();
    for (const ExactPoint& v : scene.cell.vertices) cell = hull(cell, v.approximate());
    std::vector<IntervalBox> boxes;
    for (const Sources::OfEdge& s : parts) {
      boxes.push_back(hull(s.part.lo->approximate(), s.part.hi->approximate()));
      ways_.push_back(hull(boxes.back(), cell));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  std::vector<std::vector<std::uint32_t>> arcs(Workers& workers) const {
    std::vector<std::vector<std::uint32_t>> arcs(parts_.size());
    workers.for_each(parts_.size(), [&](std::size_t i, Workers::Worker&) {
      tree_.any([&](const IntervalBox& box) { return overlap(box, ways_[i]); },
                [&](std::uint32_t k) {
                  if (may_wait(parts_[i], parts_[k])) arcs[i].push_back(k);
                  return false;
                });
    });
    return arcs;
  }

 private:
  std::array<const Plane*, 2> planes_of(const Sources::OfEdge& s) const {
    return {contours_[s.contour].plane, contours_[s.contour].other};
  }
  // But for an end upon the plane.
  static bool lies_on(int side, const Plane* h, const EdgePart& part) {
    if (!h) return false;
    const int lo = side * h->side(*part.lo), hi = side * h->side(*part.hi);
    return lo >= 0 && hi >= 0 && lo + hi > 0;
  }
  // Ways to one point of an edge come through no other point of it.
  bool may_wait(const Sources::OfEdge& p, const Sources::OfEdge& q) const {
    const auto of_p = planes_of(p), of_q = planes_of(q);
    return contours_[p.contour].edge != contours_[q.contour].edge &&
           std::none_of(of_q.begin(), of_q.end(), [&](const Plane* h) { return lies_on(-1, h, p.part); }) &&
           std::none_of(of_p.begin(), of_p.end(), [&](const Plane* h) { return lies_on(1, h, q.part); });
  }

  const std::vector<ContourEdge>& contours_;
  const std::vector<Sources::OfEdge>& parts_;
  std::vector<IntervalBox> ways_;  // from V to a part
  BoxTree tree_;
};

}  // namespace

std::vector<std::pair<std::uint32_t, const ExactPoint*>> cuts_of_circles(const LocalScene& scene,
                                                                         const std::vector<ContourEdge>& contours,
                                                                         const std::vector<Sources::OfEdge>& parts,
                                                                         Workers& workers) {
  struct Cut {
    std::size_t part;
    const Plane* plane;
    const ExactPoint* at;
  };
  std::vector<Cut> cuts;
  for (const std::vector<std::uint32_t>& circle : exact::circles_of(Waiting(scene, contours, parts).arcs(workers))) {
    std::vector<std::size_t> in_circle;
    for (const std::uint32_t i : circle) in_circle.push_back(parts[i].contour);
    std::sort(in_circle.begin(), in_circle.end());
    in_circle.erase(std::unique(in_circle.begin(), in_circle.end()), in_circle.end());
    for (const std::uint32_t i : circle) {
      for (const std::size_t c : in_circle) {
        const Plane& h = *contours[c].plane;
        if (h.side(*parts[i].part.lo) * h.side(*parts[i].part.hi) < 0) cuts.push_back({i, &h, nullptr});
      }
    }
  }
  workers.for_each(cuts.size(), [&](std::size_t i, Workers::Worker& worker) {
    const LocalEdge& e = scene.edges[contours[parts[cuts[i].part].contour].edge];
    cuts[i].at = worker.pool.keep(ExactPoint::on_plane(scene.points[e.a], scene.points[e.b], *cuts[i].plane));
  });
  std::vector<std::pair<std::uint32_t, const ExactPoint*>> found;
  for (const Cut& cut : cuts) found.emplace_back(contours[parts[cut.part].contour].edge, cut.at);
  return found;
}

}  // namespace clues::fastpath
