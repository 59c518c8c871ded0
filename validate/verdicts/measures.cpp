#include "validate/verdicts/measures.h"

#include <algorithm>

#include "validate/verdicts/area.h"

namespace clues::validate {
namespace {

template <class Weight>
Weights weigh(const Judgement& judgement, const Weight& weight) {
  Weights sum;
  for (std::uint32_t t = 0; t < judgement.triangles.size(); ++t) {
    switch (judgement.triangles[t]) {
      case TriangleVerdict::hidden:
        break;
      case TriangleVerdict::missing_undecided:
        sum.undecided_missing += weight(t);
        break;
      case TriangleVerdict::missing_visible:
        sum.visible_missing += weight(t);
        break;
      case TriangleVerdict::exact:
        sum.visible_listed += weight(t);
        break;
      case TriangleVerdict::first_order:
        (std::binary_search(judgement.proved_hidden.begin(), judgement.proved_hidden.end(), t)
             ? sum.hidden_listed
             : sum.undecided_listed) += weight(t);
        break;
      case TriangleVerdict::loose:
        sum.hidden_listed += weight(t);
        break;
    }
  }
  return sum;
}

}  // namespace

std::optional<Bounds> over_estimate(const Weights& w) {
  const double visible = w.visible_listed + w.visible_missing;
  if (!(visible > 0)) return std::nullopt;
  return Bounds{w.hidden_listed / (visible + w.undecided_listed + w.undecided_missing),
                (w.hidden_listed + w.undecided_listed) / visible};
}

std::optional<Bounds> under_estimate(const Weights& w) {
  const double visible = w.visible_listed + w.visible_missing;
  if (!(visible > 0)) return std::nullopt;
  return Bounds{w.visible_missing / (visible + w.undecided_listed),
                (w.visible_missing + w.undecided_missing) / (visible + w.undecided_missing)};
}

Weights count_weights(const Judgement& judgement) {
  return weigh(judgement, [](std::uint32_t) { return 1.0; });
}

Weights area_weights(const Judgement& judgement, const scene::TriangleMesh& mesh) {
  const exact::StandardRange range(mesh, std::vector<scene::Point>{});
  const scene::TriangleMesh in_range = range.moved_in(mesh);
  Weights weights = weigh(judgement, [&](std::uint32_t t) { return area_estimate(in_range, t); });
  weights.range = range;
  return weights;
}

std::vector<std::array<exact::FT, 2>> first_order_fractions(const scene::TriangleMesh& mesh,
                                                            const reference::VisibilityMap& map) {
  std::vector<std::array<exact::FT, 2>> fractions(mesh.triangles.size(), {exact::FT(0), exact::FT(0)});
  const auto normal = [](const exact::Point3& a, const exact::Point3& b, const exact::Point3& c) {
    return CGAL::cross_product(b - a, c - a);
  };
  for (const reference::Region& r : map.regions) {
    if (!r.visible) continue;
    const auto& c = map.complex.pieces[r.piece].corners;
    const exact::Vector3 of_piece =
        normal(map.complex.points[c[0]], map.complex.points[c[1]], map.complex.points[c[2]]);
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      const bool front = o.same_side == r.front;
      if (map.mode == reference::Mode::solid && !front) continue;
      const auto& [i, j, k] = mesh.triangles[o.triangle];
      const exact::Vector3 of_triangle =
          normal(exact::to_exact(mesh.points[i]), exact::to_exact(mesh.points[j]), exact::to_exact(mesh.points[k]));
      // The two normals are parallel, so that the ratio of the areas is rational.
      exact::FT& sum = fractions[o.triangle][front ? 0 : 1];
      sum = exact::collapsed(sum + r.area_fraction * CGAL::abs(of_piece * of_triangle) / (of_triangle * of_triangle));
    }
  }
  return fractions;
}

}  // namespace clues::validate
