#include "fastpath/solids/targets.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "fastpath/solids/openings.h"

namespace clues::fastpath::solids {

Targets::Targets(const scene::FlaggedMesh& scene, const Solids& solids)
    : scene_(scene), backs_(scene_.mesh.triangles.size()) {
  for (std::uint32_t t = 0; t < scene_.mesh.triangles.size(); ++t) {
    if (scene_.counting(t)) order_.push_back(t);
  }
  for (const auto t : order_) find_backs(t, solids);
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

namespace {

// Whether the point, which is in the plane, may be in a solid that reaches beyond it: but for roundings.
bool may_be_in(const Solid& solid, const FacetPlane& plane, const scene::Point& point, double slack) {
  const bool reaches =
      plane.outside_is_above ? solid.bounds.high[plane.axis] > plane.at : solid.bounds.low[plane.axis] < plane.at;
  return reaches && std::all_of(solid.sides.begin(), solid.sides.end(),
                                [&](const Side& s) { return s.estimate.above(point) <= slack; });
}

}  // namespace

void Targets::find_backs(std::uint32_t triangle, const Solids& solids) {
  const auto corners = corners_of({{}, 0, 0, triangle});
  const scene::Point middle = middle_of(corners);
  auto& backs = backs_[triangle];
  const auto touching = solids.touching(bounds_of(triangle));
  for (const auto i : touching) {
    const Solid& solid = solids.all()[i];
    const auto side = std::find_if(solid.sides.begin(), solid.sides.end(), [&](const Side& s) {
      return s.has_none_outside(corners) && s.has_none_inside(corners);
    });
    if (side != solid.sides.end() &&
        std::all_of(solid.sides.begin(), solid.sides.end(), [&](const Side& s) { return s.has_none_outside(corners); }))
      backs.push_back(*side);
  }
  const Side seen_left = side_through(corners[0], corners[1], corners[2]),
             seen_right = side_through(corners[0], corners[2], corners[1]);
  for (const Side& side : {seen_left, seen_right}) {
    if (!side.flat) return;
    FacetPlane behind = *side.flat;
    behind.outside_is_above = !behind.outside_is_above;
    const auto is_same = [&](const Side& other) {
      return other.flat && other.flat->outside_is_above == side.flat->outside_is_above;
    };
    const auto may_have_middle = [&](std::uint32_t i) {
      return may_be_in(solids.all()[i], behind, middle, solids.scale().margin());
    };
    if (std::none_of(backs.begin(), backs.end(), is_same) &&
        std::any_of(touching.begin(), touching.end(), may_have_middle) && solids.filled(behind).fills(corners))
      backs.push_back(side);
  }
}

scene::Bounds Targets::bounds_of(std::uint32_t triangle) const {
  std::array<scene::Point, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = scene_.mesh.points[scene_.mesh.triangles[triangle][i]];
  return scene::bounds_of(corners);
}

std::uint32_t Targets::build(std::uint32_t first, std::uint32_t count) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  scene::Bounds box = bounds_of(order_[first]);
  for (std::uint32_t i = 1; i < count; ++i) box = scene::hull_of(box, bounds_of(order_[first + i]));
  nodes_.push_back({box, 0, 0, order_[first]});
  if (count == 1) return at;
  const std::size_t axis = longest_axis(box);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const scene::Bounds of_a = bounds_of(a), of_b = bounds_of(b);
    const double at_a = of_a.low[axis] + of_a.high[axis], at_b = of_b.low[axis] + of_b.high[axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  const std::uint32_t left = build(first, count / 2), right = build(first + count / 2, count - count / 2);
  nodes_[at].left = left;
  nodes_[at].right = right;
  return at;
}

std::vector<scene::Point> Targets::corners_of(const Node& node) const {
  if (!node.is_triangle()) return scene::corners_of(node.bounds);
  std::vector<scene::Point> corners;
  for (const auto i : scene_.mesh.triangles[node.triangle]) corners.push_back(scene_.mesh.points[i]);
  return corners;
}

}  // namespace clues::fastpath::solids
