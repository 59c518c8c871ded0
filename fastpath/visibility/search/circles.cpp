#include "fastpath/visibility/search/circles.h"

#include <algorithm>
#include <map>

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
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_edge;
    for (std::uint32_t i = 0; i < parts.size(); ++i) by_edge[contours[parts[i].contour].edge].push_back(i);
    edge_of_.resize(parts.size());
    for (auto& [edge, of_edge] : by_edge) {
      for (const std::uint32_t i : of_edge) edge_of_[i] = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back(std::move(of_edge));
    }
    std::vector<IntervalBox> boxes;
    for (const Sources::OfEdge& s : parts) {
      boxes.push_back(hull(s.part.lo->approximate(), s.part.hi->approximate()));
      ways_.push_back(hull(boxes.back(), cell));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  std::vector<std::vector<std::uint32_t>> arcs(Workers& workers) const {
    std::vector<std::vector<std::uint32_t>> arcs(parts_.size());
    workers.for_each(edges_.size(), [&](std::size_t e, Workers::Worker&) {
      Answers behind(parts_.size());  // what the parts of this edge cannot wait for
      for (const std::uint32_t i : edges_[e]) {
        Answers before(edges_.size());  // those whose parts part i cannot wait for
        tree_.any([&](const IntervalBox& box) { return overlap(box, ways_[i]); },
                  [&](std::uint32_t k) {
                    const std::uint32_t other = edge_of_[k];
                    if (other == e) return false;  // ways to one point of an edge come through no other point of it
                    if (!before.of(other, [&] { return lies_on(-1, parts_[k], parts_[i].part); }) &&
                        !behind.of(k, [&] { return lies_on(1, parts_[i], parts_[k].part); }))
                      arcs[i].push_back(k);
                    return false;
                  });
      }
    });
    return arcs;
  }

 private:
  // Each is decided once.
  class Answers {
   public:
    explicit Answers(std::size_t n) : known_(n, Known::nothing) {}
    template <class Decide>
    bool of(std::uint32_t i, const Decide& decide) {
      if (known_[i] == Known::nothing) known_[i] = decide() ? Known::yes : Known::no;
      return known_[i] == Known::yes;
    }

   private:
    enum class Known : std::uint8_t { nothing, yes, no };
    std::vector<Known> known_;
  };

  // On that side of one of the planes of the edge that `s` is of, but for an end upon it.
  bool lies_on(int side, const Sources::OfEdge& s, const EdgePart& part) const {
    for (const Plane* h : {contours_[s.contour].plane, contours_[s.contour].other}) {
      if (!h) continue;
      const int lo = side * h->side(*part.lo), hi = side * h->side(*part.hi);
      if (lo >= 0 && hi >= 0 && lo + hi > 0) return true;
    }
    return false;
  }

  const std::vector<ContourEdge>& contours_;
  const std::vector<Sources::OfEdge>& parts_;
  std::vector<IntervalBox> ways_;                  // from V to a part
  std::vector<std::vector<std::uint32_t>> edges_;  // the parts of each edge that has some
  std::vector<std::uint32_t> edge_of_;             // among these
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
