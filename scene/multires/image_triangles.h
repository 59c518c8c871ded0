// Which triangle of an image a piece of an overlay lies in: the one whose vertices carry its corners.
#pragma once

#include <map>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::scene {

class ImageTriangles {
 public:
  // No two of the same three vertices. O(n log n).
  explicit ImageTriangles(const std::vector<Triangle>& image);

  // By the images of its corners among `points`; no_vertex: no three vertices carry these, or they are no triangle. O(log n).
  std::uint32_t of(const OverlayTriangle& piece, const std::vector<OverlayVertex>& points) const;

 private:
  std::map<Triangle, std::uint32_t> numbers_;  // ascending corners
};

}  // namespace clues::scene
