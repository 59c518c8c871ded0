// One plane, cut along segments: its parts, which of the given polygons cover each, and the outlines of parts that belong together as triangles.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/planar/plane_frame.h"

namespace clues::reference {

class PlaneCut {
 public:
  explicit PlaneCut(const exact::Plane3& plane);
  PlaneCut(const PlaneCut&) = delete;
  PlaneCut& operator=(const PlaneCut&) = delete;
  ~PlaneCut();

  // A convex polygon of the plane: its outline cuts, and components() tell whether it covers them. Polygons count from 0.
  void add_polygon(const std::vector<exact::Point3>& corners);
  // What a segment says of the parts beside it (marks: bits), left and right when the plane's normal points up. `source` is the plane that made it, a number from 0. Where
  // segments of several sources run along each other nothing is said: the plane of one may come between another and the part.
  struct Trace {
    int source = 0;
    unsigned left = 0, right = 0;
  };
  // The part of segment ab (of the plane) inside the polygon that was added last.
  void add_segment(const exact::Point3& a, const exact::Point3& b, const Trace& trace);

  // Parts of the plane between the segments, with a point inside, and the marks from all around.
  struct Component {
    exact::Point3 inner;
    exact::Point2 flat;
    unsigned marks = 0;
  };
  // Ends the adding. For n segments with k crossings O((n + k) log n) expected.
  const std::vector<Component>& components();
  bool covers(std::size_t polygon, const Component& component) const;

  // Triangles, counter-clockwise about the plane's normal, of the components with of[component] >= 0; components with the same number are one.
  // They depend on the point sets alone.
  struct Facet {
    int of = 0;
    std::array<exact::Point3, 3> corners;
  };
  std::vector<Facet> facets(const std::vector<int>& of) const;

 private:
  struct Triangulated;

  struct Segment {
    exact::Point2 a, b;
    Trace trace;
  };

  void insert_segments();
  void collect_marks();

  exact::Plane3 plane_;
  PlaneFrame frame_;
  std::vector<std::vector<exact::Point2>> polygons_;  // counter-clockwise
  std::vector<Segment> segments_;
  std::vector<Component> components_;
  std::unique_ptr<Triangulated> cut_;
};

}  // namespace clues::reference
