// A finding becomes a case of a conformance suite: with an expectation that is proved, never copied from the finding.
#pragma once

#include <filesystem>
#include <string>

#include "fuzz/findings/finding.h"

namespace clues::fuzz {

// Adds the scene and cell of the finding as case `id` to SUITE/found.json, has lint prove what is visible and what is hidden, and brings the index up to date. Where
// lint has anything against it, the suite stays as it was. Throws scene::Error: bad_argument (the id is no slug or was used before), malformed (the suite, or
// what lint says).
void promote(const Finding& finding, const std::string& id, const std::filesystem::path& suite);

}  // namespace clues::fuzz
