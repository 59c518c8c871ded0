#include "reference/contours/flood.h"

#include <algorithm>
#include <array>

namespace clues::reference {
namespace {

using exact::FT;

// From low to high of the points, along each axis.
struct ExactBox {
  std::array<FT, 3> low, high;

  explicit ExactBox(const std::vector<exact::Point3>& points) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto [lo, hi] = std::minmax_element(points.begin(), points.end(),
                                                [axis](const auto& p, const auto& q) { return p[axis] < q[axis]; });
      low[axis] = (*lo)[axis];
      high[axis] = (*hi)[axis];
    }
  }
  FT squared_diameter() const {
    FT sum(0);
    for (std::size_t i = 0; i < 3; ++i) sum += (high[i] - low[i]) * (high[i] - low[i]);
    return sum;
  }
  FT squared_distance(const ExactBox& other) const {
    FT sum(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const FT gap = std::max(FT(0), std::max(other.low[i] - high[i], low[i] - other.high[i]));
      sum += gap * gap;
    }
    return sum;
  }
};

}  // namespace

ContourLabel contour_label(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                           const std::vector<FlatSet>& known, const std::vector<FlatSet>& wanted) {
  ContourLabel label;
  std::vector<bool> has_seed;
  const SurfaceParts parts(sides, mesh, wanted, {});
  const auto component = parts.components();
  for (std::size_t i = 0; i < parts.parts().size(); ++i) {
    has_seed.resize(std::max(has_seed.size(), component[i] + 1), false);
    if (has_seed[component[i]]) continue;
    has_seed[component[i]] = true;
    label.seeds.push_back({parts.parts()[i].side, inner_point(parts.parts()[i].face, 0)});
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (const FlatSegment& at : known[s].borders_of(wanted[s])) label.segments.push_back({s, at});
  }
  // Where it ends along an edge of the scene: parts that are joined, and one of them only is wanted.
  const SurfaceParts cut(sides, mesh, known, label.segments);
  std::vector<bool> is_wanted;
  for (const auto& part : cut.parts()) {
    const exact::Point2 at = inner_point(part.face, 0);
    const auto faces = wanted[part.side].faces();
    is_wanted.push_back(std::any_of(faces.begin(), faces.end(), [&](const Face2& f) { return inside(f, at); }));
  }
  for (const auto& join : cut.joins()) {
    if (is_wanted[join.one] != is_wanted[join.other]) label.segments.push_back(join.along);
  }
  return label;
}

std::vector<FlatSet> flooded(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                             const std::vector<FlatSet>& known, const ContourLabel& label) {
  const SurfaceParts cut(sides, mesh, known, label.segments);
  const auto component = cut.components();
  std::vector<bool> reached(cut.parts().size(), false);  // by component
  for (const Seed& seed : label.seeds) {
    for (std::size_t i = 0; i < cut.parts().size(); ++i) {
      const auto& part = cut.parts()[i];
      if (part.side == seed.side && inside(part.face, seed.at)) reached[component[i]] = true;
    }
  }
  std::vector<std::vector<Face2>> faces(sides.size());
  for (std::size_t i = 0; i < cut.parts().size(); ++i) {
    if (reached[component[i]]) faces[cut.parts()[i].side].push_back(cut.parts()[i].face);
  }
  std::vector<FlatSet> sets;
  for (std::size_t s = 0; s < sides.size(); ++s)
    sets.emplace_back(frame_of(mesh, sides[s].triangle).twice_area(), faces[s]);
  return sets;
}

std::vector<FlatSet> with_far_sides_of(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                       const std::vector<FlatSet>& known, std::vector<FlatSet> wanted,
                                       const exact::ConvexCell& cell, const FT& reach) {
  const ExactBox around(cell.vertices());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    std::vector<exact::Point3> corners;
    for (const auto c : mesh.triangles[sides[s].triangle]) corners.push_back(exact::to_exact(mesh.points[c]));
    if (ExactBox(corners).squared_distance(around) > reach * reach * around.squared_diameter()) wanted[s] = known[s];
  }
  return wanted;
}

}  // namespace clues::reference
