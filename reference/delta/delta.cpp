#include "reference/delta/delta.h"

#include <algorithm>
#include <iterator>

#include "exact/cell/standard_range.h"
#include "reference/visibility/first_order.h"
#include "reference/visibility/map/flat_sides.h"

namespace clues::reference {

namespace {

void add_regions(const InputSide& side, SeenFrom seen, const FlatSet& set, const TriangleFrame& frame,
                 std::vector<UnifiedRegion>& out) {
  for (const Face2& face : set.faces()) {
    UnifiedRegion region{side, seen, {}, exact::FT(0)};
    for (const Ring2& ring : face) {
      region.area_fraction += twice_area(ring);  // holes run clockwise
      region.rings.emplace_back();
      for (const exact::Point2& q : ring) region.rings.back().push_back(frame.lift(q));
      if (!side.front) std::reverse(region.rings.back().begin(), region.rings.back().end());
    }
    region.area_fraction = exact::collapsed(region.area_fraction / frame.twice_area());
    out.push_back(std::move(region));
  }
}

// One range for scene and both cells, so that their maps are in the same coordinates.
exact::StandardRange common_range(const scene::TriangleMesh& mesh, const exact::ConvexCell& from,
                                  const exact::ConvexCell& to) {
  std::vector<exact::Point3> points = from.vertices();
  points.insert(points.end(), to.vertices().begin(), to.vertices().end());
  return {mesh, exact::ConvexCell(points)};
}

}  // namespace

DeltaPackets packets_of(const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
  DeltaPackets packets;
  std::set_difference(to.begin(), to.end(), from.begin(), from.end(), std::back_inserter(packets.plus));
  std::set_difference(from.begin(), from.end(), to.begin(), to.end(), std::back_inserter(packets.minus));
  return packets;
}

std::vector<UnifiedRegion> unified_map(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                       const std::vector<FlatSet>& from, const std::vector<FlatSet>& to) {
  std::vector<UnifiedRegion> regions;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const TriangleFrame frame = frame_of(mesh, sides[i].triangle);
    const FlatSet whole = whole_of(frame);
    const FlatSet &a = from[i], &b = to[i];
    add_regions(sides[i], SeenFrom::neither, subtract(whole, unite(a, b)), frame, regions);
    add_regions(sides[i], SeenFrom::from, subtract(a, b), frame, regions);
    add_regions(sides[i], SeenFrom::to, subtract(b, a), frame, regions);
    add_regions(sides[i], SeenFrom::both, intersect(a, b), frame, regions);
  }
  return regions;
}

Delta delta_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& from, const exact::ConvexCell& to,
               const Options& options) {
  const exact::StandardRange range = common_range(mesh, from, to);
  const scene::TriangleMesh moved = range.moves() ? range.moved_in(mesh) : mesh;
  const VisibilityMap a = first_order_visibility(moved, range.moved_in(from), options);
  const VisibilityMap b = first_order_visibility(moved, range.moved_in(to), options);

  Delta delta;
  delta.input_triangles = mesh.triangles.size();
  delta.visible_from = a.visible;
  delta.visible_to = b.visible;
  delta.packets = packets_of(a.visible, b.visible);
  delta.fallbacks = a.statistics.conservative_fallbacks + b.statistics.conservative_fallbacks;
  const std::vector<InputSide> sides = input_sides(moved, options.mode);
  delta.regions = unified_map(sides, moved, visible_on(sides, moved, a), visible_on(sides, moved, b));
  for (UnifiedRegion& region : delta.regions) {
    for (auto& ring : region.rings) {
      for (exact::Point3& p : ring) p = range.moved_back(p);
    }
  }
  return delta;
}

}  // namespace clues::reference
