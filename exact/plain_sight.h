// Sight lines in plain rationals (mpq): what the checkers of certificates (D18) are made of. Side products of Pluecker coordinates, one pass
// over all triangles: no tree, no filter, nothing shared with the algorithms whose answers are checked.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact/convex_cell.h"
#include "exact/kernel.h"
#include "scene/mesh.h"

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
class Cell {
 public:
  // Believes nothing: facet planes must support the vertices and close. `fault` says what is wrong, empty when nothing is.
  explicit Cell(const ConvexCell& cell);
  const std::string& fault() const { return fault_; }

  bool contains(const Vec& x) const;
  bool interior_contains(const Vec& x) const;

  // Where the segment from v, in int V, to p leaves int V: v + s (p - v) is outside for s > begin, and at begin when `closed`.
  struct Outside {
    Rational begin = 0;
    bool closed = false;
  };
  std::optional<Outside> outside_of(const Vec& v, const Vec& p) const;  // none: p is in int V

 private:
  std::string read_solid(const ConvexCell& cell);
  std::string read_flat(const ConvexCell& cell);
  std::string read_any(const ConvexCell& cell);

  std::string fault_;
  std::vector<Vec> vertices_;
  std::vector<Bound> flat_;  // equations of the affine hull, each zero
  std::vector<Bound> bounds_;
};

class Scene {
 public:
  explicit Scene(const scene::TriangleMesh& mesh) : mesh_(&mesh) {}

  // The first triangle with area that meets v + s (p - v) for some s < 1 that is at least (closed) or above (not closed) part.begin.
  std::optional<std::uint32_t> blocker(const Vec& v, const Vec& p, const Cell::Outside& part) const;
  // All that do, ascending.
  std::vector<std::uint32_t> blockers(const Vec& v, const Vec& p, const Cell::Outside& part) const;

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
