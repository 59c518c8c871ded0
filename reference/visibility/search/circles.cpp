#include "reference/visibility/search/circles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <set>

#include "exact/box_tree.h"
#include "exact/complex/simple_point.h"
#include "exact/strong_components.h"

namespace clues::reference {

using exact::Plane3;
using exact::Point3;

namespace {

// The supporting planes of V through each edge that has sources: V, and so what a sight line comes through before the edge, is in their closed H+, and what it comes to
// after that is in their closed H-.
std::map<std::uint32_t, std::vector<Plane3>> planes_of_edges(const exact::SceneQuery& scene,
                                                             const std::vector<ContourEdge>& contours,
                                                             const std::vector<Source>& sources) {
  std::map<std::uint32_t, std::vector<Plane3>> planes;
  for (const Source& s : sources) planes[contours[s.contour].edge];
  std::vector<std::pair<const std::uint32_t, std::vector<Plane3>>*> list;
  for (auto& entry : planes) list.push_back(&entry);
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
    const exact::Edge& e = scene.complex().edges[list[i]->first];
    for (const SupportingPlane& h :
         supporting_planes(scene.complex().points[e.a], scene.complex().points[e.b], scene.cell()))
      list[i]->second.push_back(h.plane);
  });
  return planes;
}

// Who may wait for whom. A point z of a part waits for a point y of another if z = y + t (y - s) for an s in V, t > 0: if y is on the way from V to z.
class Waiting {
 public:
  Waiting(const exact::SceneQuery& scene, const std::vector<ContourEdge>& contours, const std::vector<Source>& sources)
      : planes_(planes_of_edges(scene, contours, sources)) {
    CGAL::Bbox_3 cell = scene.cell().vertices().front().bbox();
    for (const Point3& v : scene.cell().vertices()) cell += v.bbox();
    std::vector<CGAL::Bbox_3> boxes;
    for (const Source& s : sources) {
      const std::uint32_t edge = contours[s.contour].edge;
      const CGAL::Bbox_3 box = s.lo.bbox() + s.hi.bbox();
      parts_.push_back({&s, edge, &planes_.at(edge), box + cell});
      boxes.push_back(box);
    }
    tree_ = exact::BoxTree(std::move(boxes));
  }

  std::vector<std::vector<std::uint32_t>> arcs() const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> of_edge;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) of_edge[parts_[i].edge].push_back(i);
    std::vector<const std::vector<std::uint32_t>*> edges;
    for (const auto& [edge, parts] : of_edge) edges.push_back(&parts);
    std::vector<std::vector<std::uint32_t>> arcs(parts_.size());
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t e) {
      std::map<std::uint32_t, bool> behind;  // by parts: what the parts of this edge cannot wait for
      for (const std::uint32_t i : *edges[e]) {
        const Part& p = parts_[i];
        std::map<std::uint32_t, bool> before;  // by edges: those whose parts p cannot wait for
        for (const std::uint32_t k :
             tree_.candidates([&](const CGAL::Bbox_3& box) { return CGAL::do_overlap(p.ways, box); })) {
          const Part& q = parts_[k];
          if (p.edge == q.edge) continue;  // ways to one point of an edge come through no other point of it
          if (!known(before, q.edge, [&] { return lies_on(-1, *q.planes, p); }) &&
              !known(behind, k, [&] { return lies_on(1, *p.planes, q); }))
            arcs[i].push_back(k);
        }
      }
    });
    return arcs;
  }

 private:
  struct Part {
    const Source* source;
    std::uint32_t edge;
    const std::vector<Plane3>* planes;
    CGAL::Bbox_3 ways;  // holds the ways from V to the part
  };

  // Of any of the planes, but for an end upon it.
  static bool lies_on(int side, const std::vector<Plane3>& planes, const Part& p) {
    return std::any_of(planes.begin(), planes.end(), [&](const Plane3& h) {
      const int lo = side * h.oriented_side(p.source->lo), hi = side * h.oriented_side(p.source->hi);
      return lo >= 0 && hi >= 0 && lo + hi > 0;
    });
  }
  template <class Decide>
  static bool known(std::map<std::uint32_t, bool>& answers, std::uint32_t of, const Decide& decide) {
    const auto [answer, is_new] = answers.try_emplace(of, false);
    if (is_new) answer->second = decide();
    return answer->second;
  }

  std::map<std::uint32_t, std::vector<Plane3>> planes_;
  std::vector<Part> parts_;
  exact::BoxTree tree_;
};

}  // namespace

std::vector<std::pair<std::uint32_t, Point3>> cuts_of_circles(const exact::SceneQuery& scene,
                                                              const std::vector<ContourEdge>& contours,
                                                              const std::vector<Source>& sources) {
  std::vector<std::pair<std::uint32_t, Point3>> cuts;
  if (sources.empty()) return cuts;
  for (const std::vector<std::uint32_t>& circle : exact::circles_of(Waiting(scene, contours, sources).arcs())) {
    std::set<std::size_t> in_circle;
    for (const std::uint32_t i : circle) in_circle.insert(sources[i].contour);
    for (const std::uint32_t i : circle) {
      const Source& s = sources[i];
      for (const std::size_t c : in_circle) {
        const exact::Plane3& plane = contours[c].plane;
        if (plane.oriented_side(s.lo) * plane.oriented_side(s.hi) >= 0) continue;
        cuts.emplace_back(contours[s.contour].edge, exact::crossing(plane, s.lo, s.hi));
      }
    }
  }
  return cuts;
}

}  // namespace clues::reference
