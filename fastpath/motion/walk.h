// A depth mesh that follows a viewpoint (A1.7): after each step every triangle satisfies every constraint of D29 at the viewpoint, and, with motion bounds, only
// triangles that are due were looked at (D30).
//
// REPAIR, and why the mesh stays a depth mesh. Before a step all triangles face the old viewpoint; those that fail at the new one are known, as their keys are due. A
// sample of each is taken out and its star triangulated anew so that it faces the *old* viewpoint, where that can always be done, and the new triangles are
// tested at the new one; and so on until none fails there. Now every triangle faces both ends of the step. det(a - v, b - v, c - v) is linear in v, so it
// faces all of the step, and the projection stays one to one (T7), however long the step was and whatever it went through. Only then come flips
// (between triangles that face the viewpoint they always can be done), what was taken out and is seen still, and new samples, at the new viewpoint.
//
// Vertices of the base are directions: near surfaces move past them. In a triangle that turned over it is the base vertex that is taken out, and put back
// where it belongs now; samples in its way stay. The base is there so that no direction is further than 0.1888 from a vertex where samples are missing
// (A1.4). A base vertex is out while the triangle that holds its direction has three corners within 0.1 of it, or while something is nearer to it than
// the thresholds allow: but for the latter, every direction is within 0.29 of a vertex, and edges between many samples and a direction, which are due most
// often, are spared. (One that waits is looked at in every fourth frame, and may be late by three.)
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "fastpath/motion/bounds/bounds.h"
#include "fastpath/motion/bounds/calendar.h"
#include "fastpath/motion/bounds/edge_bounds.h"
#include "fastpath/motion/sampling.h"
#include "fastpath/motion/triangulation.h"

namespace clues::fastpath::motion {

inline constexpr std::uint32_t kMostSamples = 1U << 24U;

struct WalkOptions {
  enum class Bounds : std::uint8_t {
    sound,           // a triangle is examined when its key is due
    none,            // all are, in each frame
    rebuild,         // a new mesh of new samples in each frame
    sketch_unsound,  // with the separation bound of the sketch, which is not sound (A1.3): for comparison only
  };
  scene::MotionThresholds thresholds;
  Bounds bounds = Bounds::sound;
  std::uint32_t samples = 11000;  // wanted; at most kMostSamples
  std::uint64_t seed = 1;
  double step = 0;  // the usual step, for the width of bins; 0: that of the first step
};

struct FrameReport {
  MotionPoint at{};
  double odometer = 0;
  std::uint64_t triangles = 0, samples = 0;  // after the frame; samples without the base
  std::uint64_t examined = 0;                // triangles that were due
  std::uint64_t tested = 0;                  // of these: those for which what was computed earlier did not do any more
  std::uint64_t removed = 0, flipped = 0;    // samples, edges
  std::uint64_t inserted = 0, reinserted = 0;  // samples; of these, such as had been removed before
  std::uint64_t reused = 0;                    // triangles that were there before and stayed as they were
  std::uint64_t rays = 0, exact = 0;           // sight lines; predicates that doubles left open
  bool rebuilt = false;                        // everything was made anew
};

class Walk {
 public:
  // Samples the scene from the first viewpoint. The tree must outlive it. Throws scene::Error: bad_argument for options, non_finite for a viewpoint.
  Walk(const Bvh& bvh, const WalkOptions& options, const MotionPoint& start);

  // Throws scene::Error for a viewpoint that is not finite, or further than 2^90 from the origin. Without bounds O(triangles); with them O(due triangles and repairs).
  FrameReport move_to(const MotionPoint& at);
  const FrameReport& first() const { return first_; }

  const SphereMesh& mesh() const { return triangulation_->mesh(); }
  scene::DepthMesh depth_mesh() const { return mesh().to_depth_mesh(); }
  // The same with places of their own for all frames: samples that are gone are in no triangle, triangles that are gone have corners kNone.
  scene::DepthMesh mesh_in_places() const;
  // For each triangle of depth_mesh() a bound at the viewpoint: of its own constraints what is left of the one that the walk keeps, of those of its edges computed
  // here. No violation is nearer. Infinite where none can be; 0 without bounds. O(triangles).
  std::vector<double> bounds_left() const;

 private:
  // Facing, edges and separations of the triangles: bounds, where they were computed, and keys in the odometer.
  struct TriangleBounds {
    std::vector<double> bound, key, x, y, z;
    void resize(std::size_t n);
    MotionPoint origin(std::uint32_t f) const { return {x[f], y[f], z[f]}; }
  };

  void rebuild();
  bool delaunay() const { return options_.thresholds.delaunay; }
  void examine_due(FrameReport& report);
  void examine_all(FrameReport& report);
  bool repair_at_old_viewpoint(FrameReport& report);
  bool settle(FrameReport& report);
  void refill(FrameReport& report);
  void note_changes();
  bool lift_base_vertex_of(std::uint32_t f);
  void lift_covered_base_vertices();
  bool covers(const std::uint32_t* corners, std::size_t count, std::uint32_t base) const;
  void put_back(FrameReport& report);
  bool remove_sample(std::uint32_t v, std::uint32_t f, const View& view, FrameReport& report);
  std::uint32_t furthest_sample(std::uint32_t f) const;
  std::uint32_t sample_that_moves(std::uint32_t f);
  double bound_of(std::uint32_t f) const;
  void set_bound(std::uint32_t f, double bound);
  void queue(std::uint32_t f);
  // The Delaunay condition of edge i of triangle f is slot 3 f + i of edges_; one of its two triangles keeps it.
  std::array<const Row*, 4> rows_of_edge(std::uint32_t f, std::size_t i) const;
  double ball_of_edge(std::uint32_t f, std::size_t i) const;
  static std::uint32_t slot_of(std::uint32_t f, std::size_t i) {
    return static_cast<std::uint32_t>(3 * std::size_t{f} + i);
  }
  bool set_edge(std::uint32_t f, std::size_t i);
  void begin_bounds(double step);
  void bounds_of_changed();
  bool is_thin(std::uint32_t f);
  bool changed_now(std::uint32_t f) const { return f < changed_in_.size() && changed_in_[f] == frame_; }

  WalkOptions options_;
  BoundThresholds limits_;
  Sampler sampler_;
  std::unique_ptr<Triangulation> triangulation_;
  std::unique_ptr<View> old_view_;
  FrameReport first_;
  MotionPoint at_{};
  double odometer_ = 0, thin_cosine_ = 0;
  std::uint32_t frame_ = 1;

  std::optional<Calendar> calendar_;
  std::optional<EdgeBounds> edges_;
  TriangleBounds bounds_;
  std::vector<double>
      first_balls_;  // by slot of the triangle with the lesser number: Delaunay bounds until the first step
  std::vector<std::uint32_t> stamps_, changed_in_, tested_in_, examined_in_, computed_in_;  // the last two: frames
  std::uint32_t tested_now_ = 0;
  std::vector<std::uint32_t> changed_;                 // of this frame, each once
  std::vector<std::uint32_t> failing_, not_delaunay_;  // due triangles by what failed, and all of them
  std::vector<std::uint32_t> due_edges_, touched_, stack_;
  std::vector<Calendar::Entry> due_;
  std::deque<DepthSample> removed_;
  // Taken out in this frame, and base vertices that are out for longer: with a vertex that was next to it.
  struct Out {
    DepthSample sample;
    std::uint32_t base, beside;  // base: its number
    std::uint32_t frame;         // in which it was taken out
  };
  std::vector<Out> out_;
};

}  // namespace clues::fastpath::motion
