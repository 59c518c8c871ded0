// Sight lines in plain rationals (mpq): what the checkers of certificates (D18) are made of. Side products of Pluecker coordinates, one pass
// over all triangles: no tree, no filter, nothing shared with the algorithms whose answers are checked.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh/mesh.h"

namespace clues::exact::plain {

using Rational = mpq_class;
using Vec = std::array<Rational, 3>;

Vec read(const Point3& p);

// A constraint on V: the points with value <= 0; the boundary has value 0.
struct Bound {
  Vec normal;
  Rational offset;
  Rational at(const Vec& x) const;
};

// V as int V = {all bounds < 0}, within the flat when it is lower-dimensional.
//
// What int V takes from S (D3): only the inside of a solid cell is no part of S. A flat cell, a segment and a
// point have no interior in space: S is all of the triangles there, those that lie in int V included, and S
// is closed in every dimension.
class Cell {
 public:
  // Believes nothing: facet planes must support the vertices and close. `fault` says what is wrong, empty when nothing is.
  explicit Cell(const ConvexCell& cell);
  const std::string& fault() const { return fault_; }

  bool contains(const Vec& x) const;
  bool interior_contains(const Vec& x) const;

  // The part of the open segment from v, in int V, to p in which triangles block: v + s (p - v) for begin < s
  // < 1, and for s = begin when `closed`. What lies inside a solid cell is left out. Of other cells nothing
  // is, also where p is in their plane or on their line: all of 0 < s < 1.
  struct Outside {
    Rational begin = 0;
    bool closed = false;
  };
  std::optional<Outside> outside_of(const Vec& v, const Vec& p) const;  // none: the cell is solid and p in int V

  bool solid() const { return flat_.empty(); }
  // Vectors that span the affine hull of V; none for a point.
  const std::vector<Vec>& span() const { return span_; }

 private:
  std::string read_solid(const ConvexCell& cell);
  std::string read_flat(const ConvexCell& cell);
  std::string read_any(const ConvexCell& cell);

  std::string fault_;
  std::vector<Vec> vertices_;
  std::vector<Bound> flat_;  // equations of the affine hull, each zero; none for a solid cell
  std::vector<Vec> span_;
  std::vector<Bound> bounds_;
};

class Scene {
 public:
  explicit Scene(const scene::TriangleMesh& mesh) : mesh_(&mesh) {}

  // The first triangle with area that meets v + s (p - v) for some s < 1 that is at least (closed) or above (not closed) part.begin.
  std::optional<std::uint32_t> blocker(const Vec& v, const Vec& p, const Cell::Outside& part) const;
  // All that do, ascending.
  std::vector<std::uint32_t> blockers(const Vec& v, const Vec& p, const Cell::Outside& part) const;

  // The first triangle that spoils the viewpoint v for p: it holds v, and may stop what is beside v from
  // seeing p. None for solid cells. A triangle that holds v is harmless only where its plane holds all of V,
  // and p is not in that plane or the triangle holds all of V near v. Then, if (v,p) is free, so is (v',p)
  // for all v' of int V near v. Argument: a triangle without v misses (v',p) near v as it misses (v,p), for
  // it is closed, and if it holds p it does so in a closed cone of directions that v is not in. One whose
  // plane holds V, but not p, meets no (v',p) at all. One with p in its plane that holds V near v has the
  // same closed cone of directions at v' as at v, and the direction to p is not in it. The same holds for p'
  // near p, if no triangle holds p but in a plane that v is not in.
  std::optional<std::uint32_t> spoiler(const Cell& cell, const Vec& v, const Vec& p) const;

  // Why a sight line that arrives from `before` does not end on that side of the triangle, at a point p of its relative interior; empty when it does.
  std::string flaw_of_target(std::uint32_t triangle, bool front, const Vec& p, const Vec& before,
                             const char* name_of_before) const;
  // Which triangle of another plane touches the triangle at p; empty when none does. Then free sight lines near one that ends at p reach points
  // all around p, and the triangle is visible with an area, not in a line or a point.
  std::string flaw_beside(std::uint32_t triangle, const Vec& p) const;

 private:
  std::array<Vec, 3> corners(std::uint32_t triangle) const;
  // Tells `found` of each until it answers true.
  template <class Found>
  void each_blocker(const Vec& v, const Vec& p, const Cell::Outside& part, const Found& found) const;
  const scene::TriangleMesh* mesh_;
};

}  // namespace clues::exact::plain
