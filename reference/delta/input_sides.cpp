#include "reference/delta/input_sides.h"

#include <algorithm>
#include <map>

#include "reference/delta/sewn_mesh.h"
#include "reference/visibility/map/sides.h"

namespace clues::reference {

namespace {

// What one side of an input triangle has of a map.
struct SideParts {
  std::vector<Rings3> rings;  // as the front turns
};

FlatSet set_of(const SideParts& parts, const TriangleFrame& frame) {
  const exact::FT twice = frame.twice_area();
  // Sewn, so that neighbours share the corners of their common border, which FlatSet asks for.
  const SewnMesh sewn = sew(parts.rings);
  std::vector<Face2> faces;
  for (const SewnMesh::Triangle& t : sewn.triangles) {
    Ring2 ring;
    for (const std::uint64_t c : t.corners) ring.push_back(frame.frame()(sewn.points[c]));
    faces.push_back({ring});
  }
  return {twice, faces};
}

}  // namespace

std::vector<InputSide> input_sides(const scene::TriangleMesh& mesh, Mode mode) {
  const std::vector<std::uint32_t> flat = scene::degenerate_triangles(mesh);
  std::vector<InputSide> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::binary_search(flat.begin(), flat.end(), t)) continue;
    sides.push_back({t, true});
    if (mode == Mode::sheet) sides.push_back({t, false});
  }
  return sides;
}

TriangleFrame frame_of(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  std::array<exact::Point3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = exact::to_exact(mesh.points[mesh.triangles[triangle][i]]);
  return TriangleFrame(corners);
}

std::vector<FlatSet> visible_on(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                const VisibilityMap& map) {
  std::map<std::pair<std::uint32_t, bool>, SideParts> parts;  // triangle, front
  for (const Region& r : map.regions) {
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      if (!counts(map.mode, o, r.front)) continue;
      Rings3 rings = r.rings;  // turn as the front of the piece does
      if (!o.same_side) {
        for (auto& ring : rings) std::reverse(ring.begin(), ring.end());
      }
      parts[{o.triangle, r.front == o.same_side}].rings.push_back(std::move(rings));
    }
  }
  std::vector<FlatSet> sets;
  for (const InputSide& side : sides) {
    const TriangleFrame frame = frame_of(mesh, side.triangle);
    const auto at = parts.find({side.triangle, side.front});
    sets.push_back(at == parts.end() ? FlatSet(frame.twice_area()) : set_of(at->second, frame));
  }
  return sets;
}

}  // namespace clues::reference
