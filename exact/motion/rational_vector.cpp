// The determinant of three rows that move with the viewpoint.
#include "exact/motion/rational_vector.h"

namespace clues::exact {

AffineDeterminant affine_determinant(const std::array<const scene::DepthSample*, 3>& samples, const ExactViewpoint& v) {
  const RationalVector rows[3] = {seen(*samples[0], v), seen(*samples[1], v), seen(*samples[2], v)};
  AffineDeterminant out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto others = cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    if (i == 0) out.value = dot(rows[0], others);
    if (!samples[i]->is_direction) out.gradient = minus(out.gradient, others);
  }
  return out;
}

}  // namespace clues::exact
