// Proves what one case of the suite says, with nothing taken on trust: witnesses by exact/sight/witness.h, contacts with the cell exactly,
// umbra by the first-order map (T1) and by the exhaustive visible set, and each answer once more by the point-occlusion oracle (D18), which shares
// no algorithm with them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "validate/vectors/suite.h"

namespace clues::validate {

struct CaseFinding {
  std::string field;  // "expect.umbra, triangle 3"
  std::string message;
  bool contradiction = false;  // not the case is wrong but clues: two of its means disagree
};

struct CaseProofs {
  std::vector<CaseFinding> findings;  // empty: all is proved
  std::uint64_t cell_contacts = 0, witnesses = 0;
  std::uint64_t umbra_by_map = 0, umbra_exhaustive = 0;  // the same triangle may count in both
  std::uint64_t oracle_points = 0;  // points of hidden triangles and ends of witnesses that the oracle was asked for
};

// Checks c.expect, which must be there. One map, a few oracle calls per triangle and, for what is exhaustively hidden, one visible set.
CaseProofs prove_case(const VectorCase& c);

// The expectation of a scene, computed; with every good witness of the old expectation kept. Nothing when a triangle could not be
// decided, which `why` then says.
std::optional<Expectation> derive_expectation(const VectorCase& c, std::string& why);

}  // namespace clues::validate
