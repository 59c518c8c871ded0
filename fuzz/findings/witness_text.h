// Witnesses between text and exact numbers, and what they prove in a scene with flags (D22).
#pragma once

#include "exact/cell/convex_cell.h"
#include "exact/sight/witness.h"
#include "fuzz/findings/finding.h"
#include "validate/verdicts/judge.h"

namespace clues::fuzz {

WitnessText to_text(const validate::Witness& witness);
validate::Witness to_witness(const WitnessText& text);  // throws scene::Error malformed

// exact/sight/witness.h in the scene of all that blocks and the triangle of the witness, which the scene must have. O(n).
exact::WitnessVerdict check_flagged_witness(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell,
                                            const validate::Witness& witness);

}  // namespace clues::fuzz
