// A scene and a cell as the exact visible set needs them: occluders outside int V, the edges at which a set of free sight lines can
// end, and for one target triangle what of that matters.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/complex/complex.h"
#include "exact/sight/point_occlusion.h"
#include "scene/mesh/mesh.h"
#include "validate/windows/sight_window.h"

namespace clues::validate {

// One side of one triangle.
struct SightQuestion {
  std::uint32_t triangle = 0;
  bool front = true;
  SightTarget target;
  exact::Plane3 plane;           // positive side: the side asked for
  std::vector<SightEdge> edges;  // that can bound the free sight lines, cut to the part that matters
  std::vector<exact::TriangleCorners>
      soup;  // for the point-occlusion oracle: what may stop a line, or touch the target or a flat cell
  std::vector<exact::Point3> samples;  // a point in each part of the target that no occluder touches
};

class SightScene {
 public:
  // Keeps a reference to the cell. Throws Error not_solid for solid mode on a mesh that is not (D4).
  SightScene(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, bool solid);

  const exact::Complex& complex() const { return complex_; }
  const CellShape& shape() const { return shape_; }
  bool has_surface(std::uint32_t triangle) const { return !polygons_[triangle].empty(); }
  std::size_t edge_count() const { return edges_.size(); }

  // nullopt: no sight line can reach this side, as no point of int V lies before it.
  std::optional<SightQuestion> question(std::uint32_t triangle, bool front) const;

  // A segment as cell: where the planes of triangles cross it, in parts of its length, ascending. All
  // triangles that hold a point between two of these hold those beside it too, or end there in a plane with
  // the segment.
  const std::vector<Rational>& stops() const { return stops_; }

 private:
  void find_edges();
  void find_cut_edges();
  void find_stops();
  SightEdge edge_on_input(const exact::Edge& edge) const;
  SightEdge::Sheet sheet_of(std::uint32_t piece, const RVector& into, const RVector& direction) const;
  std::vector<SightEdge::Sheet> sheets_at(const exact::Edge& edge, const RVector& direction) const;
  bool along_boundary(const exact::Edge& edge) const;
  void find_places(SightQuestion& question) const;

  const exact::ConvexCell& cell_;
  exact::Complex complex_;
  CellShape shape_;
  std::vector<Polygon> polygons_;                    // per input triangle; empty: no surface
  std::vector<std::vector<Polygon>> outside_;        // per input triangle, dimension 3: its convex parts outside int V
  std::vector<std::vector<Polygon>> above_, below_;  // dimension 2: its parts on the two sides of the cell's plane
  std::vector<RVector> points_;                      // of the complex
  struct Candidate {
    SightEdge edge;
    bool along_boundary;  // some sheets may lead into the cell
  };
  std::vector<Candidate> edges_;
  std::vector<Rational> stops_;
};

// Cuts the range of y(s) to where normal . (y - at) > 0; false when nothing is left.
bool cut_range(SightEdge& edge, const RVector& normal, const RVector& at);

}  // namespace clues::validate
