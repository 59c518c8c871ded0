// Samples of a scene as seen from a viewpoint (D28), by sight lines that are exactly decided (D5).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fastpath/queries/segment_queries.h"
#include "scene/motion/depth_mesh.h"

namespace clues::fastpath::motion {

using scene::DepthSample;
using scene::MotionPoint;

// So many directions, one in each of as many cells of a grid on a cube, evenly spread and at random in its cell; in rounds of which each is about as large as all before,
// near ones one after the other. A function of its arguments alone. Any lengths.
std::vector<MotionPoint> directions(std::uint32_t count, std::uint64_t seed);

class Sampler {
 public:
  // Keeps a reference. Throws scene::Error as Bvh and SegmentQueries.
  explicit Sampler(const Bvh& bvh);

  // The first surface on the segment from the viewpoint in this direction to beyond the scene, as the point in doubles next to it; where there is none a direction. None where
  // doubles cannot express the point: the direction is not finite or zero. A triangle that holds the viewpoint hides nothing.
  std::optional<DepthSample> sample(const MotionPoint& at, const MotionPoint& direction);
  // Whether nothing lies between, up to a millionth of the distance before it; of a direction, up to beyond the scene.
  bool sees(const MotionPoint& at, const DepthSample& sample);

  std::uint64_t rays = 0;

 private:
  std::optional<Point> beyond(const MotionPoint& at, const MotionPoint& direction) const;

  const Bvh* bvh_;
  SegmentQueries queries_;
  Point low_{}, high_{};
};

}  // namespace clues::fastpath::motion
