// `clues lint` of vectors/multires: every expectation is proved anew. Of a surface: its census by the reference and by OpenMesh; each vertex by a
// hierarchy in which all others are fixed, which the judge has to verify, with the reason why a vertex stays; a refusal by the reference, and by a loop
// of its own that sees the defect at the place. Of a file or a plain map: by the judge.
#pragma once

#include "validate/multires/multires_suite.h"
#include "validate/vectors/side_lint.h"

namespace clues::validate {

SideLintReport lint_multires_suite(const std::filesystem::path& folder, const SideLintOptions& options);
// What one case gets wrong; nothing when it is proved.
std::vector<std::string> flaws_of(const MultiresVector& test);
// The expectation, computed. The place of a refusal cannot be: Error malformed where the mesh is no surface.
void fill_in(MultiresVector& test);

}  // namespace clues::validate
