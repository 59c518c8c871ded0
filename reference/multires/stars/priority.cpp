#include "reference/multires/stars/priority.h"

#include <algorithm>

namespace clues::reference {

std::vector<double> removal_weights_estimate(const StarComplex& complex, const std::vector<scene::Point>& points) {
  std::vector<exact::StarSize> sizes(points.size());
  exact::StarSize largest;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    sizes[v] = exact::star_size_estimate(v, complex.star(v), complex.triangles(), points);
    largest.area = std::max(largest.area, sizes[v].area);
    largest.kappa = std::max(largest.kappa, sizes[v].kappa);
  }
  std::vector<double> weight;
  weight.reserve(points.size());
  for (const auto& size : sizes) weight.push_back(exact::removal_weight_estimate(size, largest));
  return weight;
}

}  // namespace clues::reference
