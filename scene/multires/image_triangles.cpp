#include "scene/multires/image_triangles.h"

#include <algorithm>

namespace clues::scene {

ImageTriangles::ImageTriangles(const std::vector<Triangle>& image) {
  for (std::uint32_t t = 0; t < image.size(); ++t) {
    Triangle corners = image[t];
    std::sort(corners.begin(), corners.end());
    numbers_.emplace(corners, t);
  }
}

std::uint32_t ImageTriangles::of(const OverlayTriangle& piece, const std::vector<OverlayVertex>& points) const {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t p : piece.corners) {
    const CarrierPoint& image = points[p].image;
    corners.insert(corners.end(), image.corner.begin(),
                   image.corner.begin() + static_cast<std::ptrdiff_t>(image.size()));
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() != 3) return no_vertex;
  const auto found = numbers_.find({corners[0], corners[1], corners[2]});
  return found == numbers_.end() ? no_vertex : found->second;
}

}  // namespace clues::scene
