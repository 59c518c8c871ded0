// What cells draw on the sides of triangles (scene/stream/contour_file.h), in doubles: each point as a box that holds it.
// A plane is made of corners of the scene and of the cell, which are doubles, and an end of a segment of planes; all of it
// in intervals that are rounded outward, so the width of a box is a bound on what rounding did. Every point lies in its
// triangle, and one of an edge or segment in the box of that: no box is larger.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fastpath/visibility/points/numbers.h"
#include "scene/mesh/mesh_edges.h"
#include "scene/stream/contour_file.h"

namespace clues::fastpath {

using Box3 = Vec3<Interval>;

// Which sides continue each other over which edges of the scene: those of the two triangles that have it.
class SceneEdges {
 public:
  explicit SceneEdges(const scene::TriangleMesh& mesh);  // O(n log n)

  bool has_area(std::uint32_t triangle) const { return !flat_[triangle]; }
  std::uint32_t edge(std::uint32_t triangle, std::size_t k) const { return edges_.edge(triangle, k); }
  std::size_t count() const { return users_.size(); }
  bool runs_up(std::uint32_t triangle, std::size_t k) const { return edges_.runs_up(triangle, k); }
  struct Beyond {
    std::uint32_t side = 0;
    std::size_t k = 0;
  };
  // None: `side` itself.
  Beyond beyond(std::uint32_t side, std::size_t k) const;

 private:
  std::vector<bool> flat_;
  scene::MeshEdges edges_;
  std::vector<std::vector<std::uint32_t>> users_;
};

struct DrawnBox {
  Box3 at{};
  std::uint32_t lies_on = 0;  // as scene::lies_on()
  std::uint32_t place = 0;  // of a point on an edge of the scene: its number there, 2 and more; corners: see stop_of()
};

struct IntervalSide {
  struct Line {
    scene::PointPair ends{};
    int level = 0;  // of the cell that drew it: its place in the chain; bridges: last_level
  };
  struct Block {
    std::uint32_t edge = 0;
    scene::PointPair ends{};
    int level = 0;
  };
  std::uint32_t side = 0;
  std::vector<DrawnBox> points;
  std::vector<Line> segments;
  std::vector<scene::PointPair> bridges;
  std::vector<Block> blocks;
};

// The sides on which somebody draws. RoundedUp has to be in scope, here and below.
class IntervalDrawings {
 public:
  IntervalDrawings(const scene::TriangleMesh& mesh, const SceneEdges& edges) : mesh_(mesh), edges_(edges) {}

  // Throws scene::Error malformed where a side has no area, or a point is beside its triangle.
  void add(const scene::ContourCell& cell, int level);

  const std::map<std::uint32_t, IntervalSide>& sides() const { return sides_; }
  // Boxes that are as large as their triangle or edge, because planes are nearly parallel there.
  std::uint64_t unbounded() const { return unbounded_; }

 private:
  struct PlaneBox {
    Vec3<Interval> normal;
    Box3 base;
    Interval value(const Box3& x) const { return dot(normal, x - base); }
  };
  PlaneBox plane_of(const scene::ContourPlane& plane, const scene::ContourCell& cell,
                    const std::vector<PlaneBox>& before) const;
  Box3 place_of(const scene::ContourPoint& point, const IntervalSide& side, const std::vector<PlaneBox>& planes);
  Box3 crossing_on(const Box3& a, const Box3& b, const PlaneBox& plane);
  Box3 corner(std::uint32_t point) const;

  const scene::TriangleMesh& mesh_;
  const SceneEdges& edges_;
  std::map<std::uint32_t, IntervalSide> sides_;
  std::map<std::uint32_t, std::vector<Box3>> on_edges_;
  std::uint64_t unbounded_ = 0;
};

Interval interval_of(const std::string& fraction);  // holds it; throws scene::Error malformed for what is none
Box3 box_of(const scene::Point& p);
// The smallest box around both.
Box3 hull_of(const Box3& a, const Box3& b);

}  // namespace clues::fastpath
