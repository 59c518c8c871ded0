// FIGS. 31, 32: which edge or vertex made a wedge. The plane of each wedge (D10-D12) follows from a few numbers: of an edge
// of the scene and a vertex of the cell (SV-ME, SE-ME), of a vertex of the scene and two of the cell (SE-MV), or of the
// point where an edge crosses the plane of another wedge, a CSV, and two vertices of the cell. From the scene, the cell and
// these numbers the plane is made again, exactly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/map/visibility_map.h"
#include "scene/mesh/mesh.h"
#include "scene/stream/contour_file.h"

namespace clues::reference {

// Its points are of the scene's file, of points with the same coordinates the first.
using PlaneLabel = scene::ContourPlane;

class PlaneTable {
 public:
  // `corners`: of the cell, as labels name them.
  PlaneTable(const scene::TriangleMesh& mesh, std::vector<exact::Point3> corners)
      : mesh_(&mesh), corners_(std::move(corners)) {}
  PlaneTable(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) : PlaneTable(mesh, cell.vertices()) {}

  // The planes of the wedges of the map, of this scene and cell, each once; and of triangles that were cut (D16).
  // Wedges whose planes do not follow from such numbers (where an edge's line meets the cell) are counted and left out.
  // O(planes * edges of the scene).
  void add_wedges(const VisibilityMap& map);

  // From the numbers alone. Its label `label.crossed` must be there. Throws scene::Error malformed.
  exact::Plane3 plane_of(const PlaneLabel& label) const;
  std::size_t add(const PlaneLabel& label);

  const std::vector<PlaneLabel>& labels() const { return labels_; }
  const exact::Plane3& plane(std::size_t label) const { return planes_[label]; }
  // The first label whose plane holds both points; none: `npos`.
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  std::size_t holding(const exact::Point3& a, const exact::Point3& b) const;
  std::uint64_t left_out() const { return left_out_; }

 private:
  std::optional<PlaneLabel> label_of(const Wedge& wedge) const;
  std::optional<PlaneLabel> label_at_apex(const Wedge& wedge) const;

  const scene::TriangleMesh* mesh_;
  std::vector<exact::Point3> corners_;
  std::vector<std::array<std::uint32_t, 2>> edges_;  // of the scene, by points as in PlaneLabel
  std::vector<PlaneLabel> labels_;
  std::vector<exact::Plane3> planes_;
  std::uint64_t left_out_ = 0;
};

}  // namespace clues::reference
