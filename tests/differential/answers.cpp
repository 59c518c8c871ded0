#include "tests/differential/answers.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "exact/area.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement/refinement.h"
#include "fuzz/campaign/generators.h"
#include "reference/visibility/refinement/bounds.h"
#include "tests/seed.h"
#include "validate/verdicts/precision.h"
#include "validate/visible_set/visible_set.h"

namespace clues::tests {

using exact::Point3;

namespace {

reference::Options reference_options(const exact::Dials& dials) {
  reference::Options options;
  options.threads = 1;
  options.dials = dials;
  return options;
}

fastpath::LocalMapOptions fast_options(const exact::Dials& dials) {
  fastpath::LocalMapOptions options;
  options.dials = dials;
  return options;
}

}  // namespace

Answer reference_answer(const fuzz::Case& scene, const exact::Dials& dials, reference::Formulation formulation) {
  reference::Options options = reference_options(dials);
  options.formulation = formulation;
  if (scene.solid) options.mode = reference::Mode::solid;
  const auto map = reference::first_order_visibility(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
  Answer out{formulation == reference::Formulation::plain ? "reference" : "traversal",
             map.visible,
             map.statistics.conservative_fallbacks,
             {},
             map.in_doubt};
  for (const reference::Region& r : map.regions) {
    if (!r.visible) continue;
    const exact::Piece& piece = map.complex.pieces[r.piece];
    const auto corner = [&](std::size_t i) { return map.complex.points[piece.corners[i]]; };
    const double area = exact::area_estimate(corner(0), corner(1), corner(2)) * CGAL::to_double(r.area_fraction);
    for (const exact::Origin& o : piece.origins) out.areas[{o.triangle, o.same_side == r.front}] += area;
  }
  return out;
}

Answer fast_answer(const fuzz::Case& scene, const exact::Dials& dials) {
  const fastpath::Bvh bvh(scene.mesh);
  fastpath::LocalMapOptions options = fast_options(dials);
  if (scene.solid) options.mode = fastpath::SideMode::solid;
  const auto found = fastpath::first_order_visibility(bvh, scene.cell, options, {.regions = true, .in_doubt = true});
  Answer out{"fast", found.visible, found.conservative_fallbacks, {}, found.in_doubt};
  for (const fastpath::LocalRegion& r : found.regions) {
    if (r.visible) out.areas[{r.triangle, r.front}] += r.area_estimate;
  }
  return out;
}

Answer refined_reference_answer(const fuzz::Case& scene, const exact::Dials& dials, bool backprojection, int depth) {
  reference::Bounds bounds(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), reference_options(dials));
  const auto how = backprojection ? validate::Refinement::backprojection : validate::Refinement::cells;
  validate::refine(bounds, how, {depth, 0});
  const auto map = bounds.refined_map("refined");
  return {backprojection ? "reference backprojected" : "reference subdivided",
          map.visible,
          map.statistics.conservative_fallbacks,
          {}};
}

Answer refined_fast_answer(const fuzz::Case& scene, const exact::Dials& dials, bool backprojection, int depth) {
  const fastpath::Bvh bvh(scene.mesh);
  fastpath::RefinementOptions refinement;
  refinement.by = backprojection ? fastpath::RefineBy::backprojection : fastpath::RefineBy::cells;
  refinement.max_depth = depth;
  const auto found = fastpath::refined_visibility(bvh, scene.cell, fast_options(dials), refinement);
  return {backprojection ? "fast backprojected" : "fast subdivided",
          found.visible,
          found.conservative_fallbacks + found.first_order.conservative_fallbacks,
          {}};
}

std::vector<std::uint32_t> missing_from(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
  std::vector<std::uint32_t> out;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(out));
  return out;
}

std::vector<std::uint32_t> truly_visible(const fuzz::Case& scene) {
  const auto set = validate::exact_visible_set(scene.mesh, exact::ConvexCell::from_doubles(scene.cell));
  std::vector<std::uint32_t> visible;
  for (std::uint32_t t = 0; t < set.triangles.size(); ++t) {
    if (set.triangles[t].sight == validate::Sight::visible) visible.push_back(t);
  }
  return visible;
}

PointJudge::PointJudge(const fuzz::Case& scene)
    : mesh_(scene.mesh), cell_(exact::ConvexCell::from_doubles(scene.cell)) {
  const auto degenerate = scene::degenerate_triangles(mesh_);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (!std::binary_search(degenerate.begin(), degenerate.end(), t)) occluders_.push_back(corners(t));
  }
}

exact::TriangleCorners PointJudge::corners(std::uint32_t triangle) const {
  const scene::Triangle& c = mesh_.triangles[triangle];
  return {exact::to_exact(mesh_.points[c[0]]), exact::to_exact(mesh_.points[c[1]]),
          exact::to_exact(mesh_.points[c[2]])};
}

bool PointJudge::is_seen(std::uint32_t triangle, bool front, const scene::Point& near) const {
  const auto [a, b, c] = corners(triangle);
  // The point of the plane below it, which may be just outside of the triangle: then nothing is claimed.
  const exact::Plane3 plane(a, b, c);
  const Point3 p = exact::collapsed(plane.projection(exact::to_exact(near)));
  if (!exact::Kernel::Triangle_3(a, b, c).has_on(p)) return false;
  // A side that no point of V is strictly in front of is not seen (D15), also where it lies on V: there the oracle calls every point seen (D3).
  const auto& s = cell_.vertices();
  const auto faced = front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
  if (std::none_of(s.begin(), s.end(), [&](const Point3& v) { return plane.oriented_side(v) == faced; })) return false;
  return !exact::point_occlusion(p, front ? plane : plane.opposite(), cell_, occluders_).occluded;
}

Judged judge_regions(const PointJudge& judge, const std::vector<fastpath::LocalRegion>& regions) {
  Judged judged;
  for (const fastpath::LocalRegion& r : regions) {
    if (r.visible || r.area_estimate < 1e-6) continue;
    scene::Point middle{};
    for (const scene::Point& p : r.outline_estimate) {
      for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<double>(r.outline_estimate.size());
    }
    std::vector<scene::Point> places{middle};
    for (const scene::Point& p : r.outline_estimate) {
      scene::Point place{};
      for (std::size_t k = 0; k < 3; ++k) place[k] = middle[k] + 0.96875 * (p[k] - middle[k]);
      places.push_back(place);
    }
    for (const scene::Point& p : places) {
      ++judged.points;
      judged.seen += judge.is_seen(r.triangle, r.front, p);
    }
  }
  return judged;
}

std::vector<fuzz::Case> small_scenes(std::size_t per_generator, std::size_t most_pieces) {
  const fuzz::GivenScenes none;
  std::vector<fuzz::Case> scenes;
  for (const auto& generator : fuzz::generators_named(
           {"loose_triangles", "tetrahedra", "open_sheets", "axis_boxes", "interpenetrating"}, none)) {
    std::size_t found = 0;
    for (std::uint64_t i = 0; found < per_generator && i < 40 * per_generator; ++i) {
      fuzz::Case scene = generator.make(kSeed, i);
      const auto cell = exact::ConvexCell::from_doubles(scene.cell);
      if (scene.mesh.triangles.size() > most_pieces) continue;
      if (exact::build_complex(scene.mesh, &cell).pieces.size() > most_pieces) continue;
      scene.solid = false;
      scenes.push_back(std::move(scene));
      ++found;
    }
  }
  return scenes;
}

}  // namespace clues::tests
