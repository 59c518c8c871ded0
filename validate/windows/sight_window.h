// The window of a moving point: which directions d pass y(s) on a free way from the target triangle to the cell?
//
// The directions that come from the target, reach the cell and meet the extra conditions are a convex cone; every
// occluder takes a convex cone away. All cones are lists of planes through y(s), all decisions signs of triples of them, so one
// empty window is empty on a whole range of s (moving_planes.h).
#pragma once

#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "validate/windows/moving_planes.h"

namespace clues::validate {

using Polygon = std::vector<RVector>;  // strictly convex, planar, with area

RVector normal_of(const Polygon& polygon);  // right-hand rule
// The part on the closed side where normal . (x - at) >= 0; fewer than three corners: no area.
Polygon clipped(const Polygon& polygon, const RVector& normal, const RVector& at);

// The cell in plain rationals.
struct CellShape {
  struct Facet {
    Polygon corners;  // counter-clockwise from outside (dimension 2: from one side)
    RVector normal;
    std::vector<std::size_t> neighbours;  // across the edge from corner i to i + 1 (dimension 3)
  };
  explicit CellShape(const exact::ConvexCell& cell);

  int dimension = 0;
  std::vector<RVector> vertices;
  std::vector<Facet> facets;
};

// What the sight lines have to do with one target triangle and one side of it.
struct SightTarget {
  Polygon triangle;
  RVector up;                         // normal towards the side asked for
  std::vector<Polygon> before;        // occluders' parts on that side: between y and the target when the line hits them
  std::vector<Polygon> outside;       // occluders' parts outside int V (dimension 3)
  std::vector<Polygon> above, below;  // dimension 2: their parts on the front and the back of the cell's plane
};

// One line along which y moves.
struct SightEdge {
  RVector origin, direction;
  Rational low, high;  // y(s), low < s < high
  struct Sheet {
    RVector into;    // from the edge into a piece of surface that ends here
    RVector normal;  // into x direction, up to a positive factor
  };
  std::vector<Sheet> sheets;
};

enum class Passage {
  edge,     // y on an edge of an occluder, the line passes it from the target to the cell
  on_cell,  // y in int V: only the way from the target
};

struct Opening {
  Rational s;
  RVector y;
  IVector d;
  RVector nudge;  // moved a little this way, the line passes all sheets at y; zero unless Passage::edge
};

class SightWindow {
 public:
  // Keeps references.
  SightWindow(const CellShape& cell, const SightTarget& target, const SightEdge& edge, Passage passage);

  enum class Answer { covered, open, on_event };
  // The window at y(s). `wedge`, +1 or -1: the side of the plane (edge, d) on which all sheets lie (Passage::edge only).
  // covered: planes().valid_range() tells how far.
  Answer decide(const Rational& s, int wedge);
  const Opening& opening() const { return opening_; }
  MovingPlanes& planes() { return planes_; }

 private:
  struct Face {
    int plane;
    int sign;
  };
  using Cone = std::vector<Face>;
  struct Shadow {
    const Polygon* polygon;
    enum class Way { target, cell, cell_above, cell_below } way;
    int value;
    std::vector<int> lines;  // when first needed
    int before = 0;          // at this s: 0 unknown, 1 blocks, -1 lies behind the cell
    std::optional<Cone> cone;
  };

  int side(const Cone& cone, std::size_t ray, const Face& face, bool certain);
  std::optional<Cone> clip(const Cone& cone, const Face& face, bool certain);
  bool take_away(const Cone& cone, const Cone& taken, std::vector<Cone>& rest);
  Cone cone_of(const std::vector<int>& lines, bool forward) const;
  std::vector<int> add_lines(const Polygon& polygon);
  void add_shadows(const std::vector<Polygon>& polygons, Shadow::Way way);
  std::vector<Cone> start();
  bool clip_to_cell(std::vector<Cone>& cones);
  bool clip_to_sheets(std::vector<Cone>& cones, int wedge);
  IVector inner(const Cone& cone, int attempt);
  int where(const Cone& cone, const IVector& d);  // 1 inside, 0 on the boundary, -1 outside
  bool is_before(Shadow& shadow, const IVector& d);
  bool in_the_way(const Shadow& shadow) const;
  const Cone* shadow_cone(Shadow& shadow);  // null: flat
  Answer search(std::vector<Cone> cones, int wedge);

  const CellShape& cell_;
  const SightEdge& edge_;
  Passage passage_;
  MovingPlanes planes_;
  int target_value_;
  std::vector<int> target_lines_;
  struct CellFacet {
    int value, plane;
    std::vector<int> lines;
    int side = 0;
  };
  std::vector<CellFacet> facets_;
  std::vector<int> sheet_planes_;
  std::vector<Shadow> shadows_;
  bool on_boundary_ = false;  // y lies on the boundary of a solid cell
  RVector y_;
  Opening opening_;
};

}  // namespace clues::validate
