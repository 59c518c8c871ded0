#include "fastpath/visibility/search/circles.h"

#include <algorithm>

#include "exact/strong_components.h"

namespace clues::fastpath {

namespace {

// Who may wait for whom: a part for what is on the ways from V to one of its points, in front of that. No way leads back: what it comes through before an edge is in H+ of
// the planes that support V there, and what it comes to after that is in H-.
class Waiting {
 public:
  Waiting(const LocalScene& scene, const std::vector<ContourEdge>& contours, const std::vector<Sources::OfEdge>& parts)
      : contours_(contours), parts_(parts) {
    const IntervalBox cell = scene.cell.bounds();
    std::vector<IntervalBox> boxes_of_runs;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
      const IntervalBox box = hull(parts[i].part.lo->approximate(), parts[i].part.hi->approximate());
      boxes_.push_back(box);
      ways_.push_back(hull(box, cell));
      if (i == 0 || parts[i].contour != parts[i - 1].contour) {
        runs_.push_back({i, i});
        boxes_of_runs.push_back(box);
      }
      runs_.back().end = i + 1;
      boxes_of_runs.back() = hull(boxes_of_runs.back(), box);
    }
    tree_ = BoxTree(std::move(boxes_of_runs));
  }

  // Of the parts of an edge, one after the other, those that a part may wait for follow each other, too: so do those that meet its ways in boxes, and a plane has one end of the edge on a side,
  // and what lies between.
  std::vector<std::vector<exact::NodeRange>> arcs(Workers& workers) const {
    std::vector<std::vector<exact::NodeRange>> arcs(parts_.size());
    workers.for_each(runs_.size(), [&](std::size_t r, Workers::Worker&) {
      const std::vector<std::uint32_t> others = in_front_of(runs_[r]);
      Answers behind(parts_.size());  // what the parts of this edge cannot wait for
      for (std::uint32_t i = runs_[r].begin; i < runs_[r].end; ++i) {
        const auto may_wait_for = [&](std::uint32_t k) {
          return overlap(boxes_[k], ways_[i]) && !behind.of(k, [&] { return lies_on(1, parts_[i], parts_[k].part); });
        };
        for (const std::uint32_t other : others) {
          exact::NodeRange range = runs_[other];
          if (lies_on(-1, parts_[range.begin], parts_[i].part)) continue;
          while (range.begin < range.end && !may_wait_for(range.begin)) ++range.begin;
          while (range.begin < range.end && !may_wait_for(range.end - 1)) --range.end;
          if (range.begin < range.end) arcs[i].push_back(range);
        }
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

  // Other edges of which parts of this one may wait for some, as far as that is known of both as a whole.
  std::vector<std::uint32_t> in_front_of(const exact::NodeRange& run) const {
    const auto all_of = [&](const exact::NodeRange& r) {
      return EdgePart{parts_[r.begin].part.lo, parts_[r.end - 1].part.hi, nullptr};
    };
    IntervalBox ways = ways_[run.begin];
    for (std::uint32_t i = run.begin + 1; i < run.end; ++i) ways = hull(ways, ways_[i]);
    std::vector<std::uint32_t> others;
    tree_.any([&](const IntervalBox& box) { return overlap(box, ways); },
              [&](std::uint32_t other) {
                const exact::NodeRange& them = runs_[other];
                // Ways to one point of an edge come through no other point of it.
                if (edge_of(them) != edge_of(run) && !lies_on(-1, parts_[them.begin], all_of(run)) &&
                    !lies_on(1, parts_[run.begin], all_of(them)))
                  others.push_back(other);
                return false;
              });
    return others;
  }

  // On that side of one of the planes of the edge that `s` is of, but for an end upon it.
  bool lies_on(int side, const Sources::OfEdge& s, const EdgePart& part) const {
    for (const Plane* h : {contours_[s.contour].plane, contours_[s.contour].other}) {
      if (!h) continue;
      const int lo = side * h->side(*part.lo), hi = side * h->side(*part.hi);
      if (lo >= 0 && hi >= 0 && lo + hi > 0) return true;
    }
    return false;
  }

  std::uint32_t edge_of(const exact::NodeRange& run) const { return contours_[parts_[run.begin].contour].edge; }

  const std::vector<ContourEdge>& contours_;
  const std::vector<Sources::OfEdge>& parts_;
  std::vector<IntervalBox> boxes_, ways_;  // of a part, and of all from V to it
  std::vector<exact::NodeRange> runs_;     // the parts of one contour edge after the other, along it
  BoxTree tree_;                           // of these
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
