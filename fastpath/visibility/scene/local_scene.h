// The conforming complex of a small scene (D16) and the cell (D2), taken over into points that keep their construction, with the segment
// queries that walks need (D5, D14).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "fastpath/visibility/points/points.h"
#include "fastpath/visibility/scene/box_tree.h"
#include "scene/mesh/mesh.h"

namespace clues::fastpath {

// Points and planes made on the way; addresses stay.
struct Pool {
  std::deque<ExactPoint> points;
  std::deque<Plane> planes;
  const ExactPoint* keep(ExactPoint p) { return &points.emplace_back(std::move(p)); }
  const Plane* plane(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
    return &planes.emplace_back(a, b, c);
  }
};

struct LocalCell {
  int dimension = 0;
  std::deque<ExactPoint> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> facets;  // dimension 3: counter-clockwise seen from outside; 2: the polygon
  std::deque<Plane> facet_planes;        // outward; of a polygon either
  IntervalBox bounds() const;
  bool lies_in(const Plane& plane) const;             // all of V, which is not solid
  bool interior_contains(const ExactPoint& p) const;  // dimension 3
  bool contains(const ExactPoint& p) const;           // any dimension
  // A point of int V near the combination of the vertices with these positive weights. Doubles if the cell has dimension 3 and rounding
  // stays inside, else exactly that combination.
  ExactPoint interior_point(const std::vector<double>& weights) const;
  // Whether the plane of a flat cell divides the two. No sight line crosses it, and labels on its two sides have nothing to
  // do with each other (T10): a leg of a walk that is not part of a sight line may not cross it either.
  bool divides(const ExactPoint& x, const ExactPoint& y) const {
    return dimension == 2 && facet_planes[0].side(x) * facet_planes[0].side(y) < 0;
  }
  // The point of a flat cell or a segment that is nearest to p, if that is in int V.
  std::optional<ExactPoint> foot(const ExactPoint& p) const;
  // Exactly that combination.
  ExactPoint combination(const std::vector<Rational>& weights) const;
};

struct LocalOrigin {
  std::uint32_t triangle = 0;
  bool same_side = true;
};

struct LocalPiece {
  std::array<std::uint32_t, 3> corners{}, edges{};  // edges: c0c1, c1c2, c2c0
  std::vector<LocalOrigin> origins;
  bool in_cell = false;     // in int V: no occluder (D3)
  bool meets_cell = false;  // has a point in V: visible
  // Known to be outside of Omega, with all that lies there: no occluder, and in none of the lists of edges and points but those of what is dark. Light never goes from one side of it to the
  // other, so it divides what is around a vertex (Apex).
  bool dark = false;
};

struct LocalEdge {
  std::uint32_t a = 0, b = 0;
  std::vector<std::uint32_t> pieces;  // none: of dark ones only, no edge of the scene
};

enum class Crossing : std::uint8_t { no, yes, touch };

class LocalScene {
 public:
  LocalScene(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell);
  // A part of a cell in a complex that was cut for the whole of it: what lies in the whole cell occludes for no part (D3, D21).
  // Of which triangles are `dark` may be left out: none.
  LocalScene(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& part,
             std::span<const std::uint8_t> dark = {});
  LocalScene(const LocalScene&) = delete;
  LocalScene& operator=(const LocalScene&) = delete;

  LocalCell cell;
  std::deque<ExactPoint> points;
  std::vector<LocalPiece> pieces;
  std::deque<Plane> planes;  // per piece; positive side = front
  std::vector<LocalEdge> edges;
  std::vector<std::vector<std::uint32_t>> point_pieces, point_edges;
  std::vector<std::vector<std::uint32_t>> dark_at_edge, dark_at_point;  // pieces
  std::uint64_t refined_triangles = 0;
  std::uint64_t triangles = 0;
  IntervalBox bounds{};  // of mesh and cell
  BoxTree tree;          // over the occluders: item i is pieces[occluders[i]]
  std::vector<std::uint32_t> occluders;

  const ExactPoint& corner(std::uint32_t piece, int i) const {
    return points[pieces[piece].corners[static_cast<std::size_t>(i)]];
  }

  // The open segment vp and a closed piece. A piece whose plane contains v or p only is not crossed; touch: the segment meets its
  // border, or runs in its plane and may meet it.
  Crossing crosses(const ExactPoint& v, const ExactPoint& p, std::uint32_t piece) const;
  // Whether it meets any piece, or may.
  bool may_meet(const ExactPoint& v, const ExactPoint& p) const;
  // Whether some point of V is strictly on this side of a piece (1: in front). Another side is reached by no sight line and no continuation (D8).
  bool faces_cell(std::uint32_t t, int side) const;
  // Whether a closed piece holds x. A place that is chosen to stand for the space beside something must be in free space:
  // the open segment to it does not show that, and its label would be that of one side of what it lies on.
  bool is_on_surface(const ExactPoint& x) const;

  struct Last {
    bool degenerate = false;
    std::optional<std::uint32_t> piece;  // crossed last, seen from v
  };
  Last last_crossing(const ExactPoint& v, const ExactPoint& p) const;
};

}  // namespace clues::fastpath
