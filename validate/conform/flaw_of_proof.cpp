// The suite is not believed either: before a program is called unsound, the sight line that says so is checked once more.
#include <string>

#include "exact/cell/convex_cell.h"
#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "validate/conform/grade.h"
#include "validate/see_through/layers.h"
#include "validate/vectors/rational_point.h"

namespace clues::validate {

std::string flaw_of_proof(const VectorCase& test, const MustBeVisible& proof) {
  const auto cell = exact::ConvexCell::from_doubles(test.cell);
  if (!proof.meets_cell) {
    if (test.mode == CaseMode::solid && !proof.front) return "a back side does not count in solid mode (D4)";
    const AskedAlone alone = asked_alone(test.flagged(), proof.triangle);
    const auto verdict =
        exact::check_witness(alone.mesh, cell, alone.triangle, proof.front, point_of(proof.v), point_of(proof.p));
    return verdict.valid ? "" : verdict.reason;
  }
  const auto& [a, b, c] = test.mesh.triangles[proof.triangle];
  const auto corner = [&](std::uint32_t i) { return exact::to_exact(test.mesh.points[i]); };
  if (CGAL::collinear(corner(a), corner(b), corner(c))) return "a triangle without area is no surface (D1)";
  return exact::meets_cell({corner(a), corner(b), corner(c)}, cell) ? "" : "it does not meet the cell";
}

}  // namespace clues::validate
