// Random scenes about cells without an interior, with small numbers amid coincidences: what the checkers and the plain way
// (thin_cells.h) are compared on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/sight/point_occlusion.h"
#include "fuzz/generators/random.h"
#include "scene/mesh/mesh.h"
#include "tests/validate/thin_cells.h"
#include "validate/certificates/umbra_certificate.h"

namespace clues::validate::thin {

using fuzz::Random;

constexpr int kPoints = 10000;  // lines, triangles: of each dimension

// CLUES_SEED, or always the same; printed.
std::uint64_t seed_of_run();

Rational half(int n);
RVector mean(const RVector& a, const RVector& b);
exact::TriangleCorners exact_of(const Triangle& t);
std::string text(const RVector& x);

// A cell and a few triangles, with whole and halved coordinates. Many corners lie on the cell, its rim, its
// line or plane, on other triangles, or between.
struct Scene {
  Cell cell;
  std::vector<Triangle> soup;

  Scene(Cell of, std::vector<Triangle> triangles) : cell(std::move(of)), soup(std::move(triangles)) {}
  Scene(Random& random, int dimension, int most);

  static RVector grid(Random& random);
  RVector on_cell(Random& random) const;  // of the cell's point, line or plane; often of the cell itself
  RVector special(Random& random) const;
  const Triangle& any(Random& random) const;
  static RVector on(const Triangle& t, Random& random, bool inside);  // inside the triangle, or on its rim as well
  RVector in_cell(Random& random) const;                              // of int V

  exact::ConvexCell exact_cell() const;
  std::vector<exact::TriangleCorners> exact_soup() const;
  scene::TriangleMesh mesh() const;
  std::string words() const;
};

// Behind a plate, within the pyramid over it from a point q, nothing is seen from what lies in the pyramid
// before the plate.
struct Frustum {
  RVector q;
  Triangle plate;
  Cell cell;
  UmbraCertificate facets;

  Frustum(Random& random, int dimension);
  // In the pyramid, `share` of the way from q to the plate.
  RVector at(Random& random, Rational share, bool inside) const;
  // Behind the plate, in the frustum; or, if it is to be wild, in part anywhere.
  Triangle triangle(Random& random, const Scene& scene, bool wild) const;
};

struct Line {
  const Scene& scene;
  std::uint32_t target;
  bool front;
  RVector v, p;
};

// Free, p inside the target, v in int V and on the right side (D5).
bool is_sight_line(const Line& line);

}  // namespace clues::validate::thin
