// What cells draw on the sides of triangles, with exact coordinates: each point where its label puts it, and each
// segment from point to point (scene/stream/contour_file.h). From the outermost cell inwards, cell after cell.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "exact/kernel.h"
#include "reference/contours/plane_labels.h"
#include "reference/delta/input_sides.h"
#include "scene/stream/contour_file.h"

namespace clues::reference {

// One side of a triangle. Points are laid flat as frame_of() does.
class DrawnSide {
 public:
  struct Drawn {
    exact::Point3 at;
    exact::Point2 flat;
    std::uint32_t lies_on = 0;  // 0: in the open, 1 to 3: on an edge, 4 + n: on segment n; of a corner nothing
  };

  DrawnSide(const scene::TriangleMesh& mesh, std::uint32_t triangle);

  const TriangleFrame& frame() const { return frame_; }
  const exact::Plane3& plane() const { return plane_; }
  const std::vector<Drawn>& points() const { return points_; }
  const std::vector<scene::PointPair>& segments() const { return segments_; }
  bool is_corner(std::uint32_t p) const { return p < 3; }
  bool on_edge(std::size_t k, const exact::Point2& p) const;
  bool on_edge(std::size_t k, std::uint32_t p) const { return on_edge(k, points_[p].flat); }

  // Whether nothing that is drawn parts the two, which may lie on it themselves. O(drawing).
  bool is_free(const exact::Point2& p, const exact::Point2& q) const;
  // Whether no part of the drawing meets the closed segment. O(drawing).
  bool is_clear(const exact::Point2& p, const exact::Point2& q) const;
  // What has to be added for the drawing to hang together, edges of the triangle included. O(points^2 * drawing).
  std::vector<scene::PointPair> bridges() const;

  std::uint32_t add_point(const exact::Point3& at, std::uint32_t lies_on);
  void add_segment(const scene::PointPair& segment) { segments_.push_back(segment); }

 private:
  template <class Test>
  bool all_lines(const Test& test) const;

  TriangleFrame frame_;
  exact::Plane3 plane_;
  std::vector<Drawn> points_;
  std::vector<scene::PointPair> segments_;
};

class Drawings {
 public:
  explicit Drawings(const scene::TriangleMesh& mesh);

  // Of a side on which nobody has drawn: nothing but its triangle. `side` as in the file.
  DrawnSide& on(std::uint32_t side);
  // Adds what the cell draws. Throws scene::Error malformed where a label does not make a point of its triangle, or the
  // side is of a triangle without area.
  void add(const scene::ContourCell& cell);

  // Points on an edge of the scene, in the order in which they came; of one that is shared, those of all sides.
  std::vector<exact::Point3>& on_scene_edge(std::uint32_t triangle, std::size_t k);
  exact::Point3 place_of(const scene::ContourPoint& point, std::uint32_t side, const PlaneTable& planes);

 private:
  const scene::TriangleMesh* mesh_;
  std::vector<std::uint32_t> number_;  // of points with the same coordinates one
  std::vector<bool> flat_;             // triangles without area
  std::map<std::uint32_t, DrawnSide> sides_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<exact::Point3>> edges_;
};

// The planes of the labels of a cell, in their order. Throws scene::Error malformed.
PlaneTable planes_of(const scene::ContourCell& cell, const scene::TriangleMesh& mesh);

// Where a seed is, flat.
exact::Point2 place_of(const scene::ContourSeed& seed, const TriangleFrame& frame);

}  // namespace clues::reference
