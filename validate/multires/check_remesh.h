// E7: a remesh beside the hierarchy that it was made from. Everything is recomputed from the three files; shares no code with what makes remeshes.
//
//   the triangles of the mesh, in their order, are those of the proof; of its vertices only the positions count, so that formats may split them, but
//   not join them
//   the remesh is a surface, with the Euler number and boundaries of the input; by the parameters of its vertices it covers the base domain once
//   pieces are a common triangulation of input and remesh: turned right on both, paired at edges, areas 1 in every triangle
//   every vertex is the point of the input that the pieces give it, rounded
//   every corner of a piece is within the first bound of the remesh triangle that the piece lies in, and its place there within the second of the
//   input triangle that the file names. As distances to convex sets are convex, that bounds them on the pieces, and so everywhere (D34)
#pragma once

#include "scene/multires/remesh_proof.h"
#include "validate/multires/check_hierarchy.h"

namespace clues::validate {

// Adds to the report. `single`: the positions were rounded to floats. O(n log n), with fractions only where doubles do not tell.
void check_remesh(const scene::Hierarchy& hierarchy, const scene::TriangleMesh& remesh, const scene::RemeshProof& proof,
                  bool single, HierarchyReport& report);

}  // namespace clues::validate
