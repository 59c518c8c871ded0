// The dials of a case: settings that make rare paths of the engines common (exact/dials.h), and where and how large the scene is. They are part of the case, a pure
// function of its name, so that a finding is repeated and shrunk with the same. With any setting an answer must be sound (D7).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exact/dials.h"
#include "fuzz/findings/finding.h"

namespace clues::fuzz {

struct NamedDial {
  enum class Of { scene, engine };
  const char* name;
  const char* what;  // one line
  Of of;
  std::vector<std::int64_t> values;  // it is turned to one of these
  bool limits = false;               // the answer may hold more than Omega (D17)
};
const std::vector<NamedDial>& all_dials();

// The case with its dials turned: nothing in half of the cases, else one to three. The numbers are of a stream of their own: what the generators make stays as
// it was. Dials of engines are left alone for subjects that do not take them. A scene is scaled and moved only where no coordinate rounds.
Case with_dials(Case scene, bool of_engines);

bool is_a_setting(const std::string& name, std::int64_t value);  // of a dial that there is
bool is_limited(const CaseDials& dials);                         // some dial is turned that limits

exact::Dials map_dials(const CaseDials& dials);
exact::ProcessDials process_dials(const CaseDials& dials);
int refinement_depth(const CaseDials& dials, int otherwise);
bool by_traversal(const CaseDials& dials);

}  // namespace clues::fuzz
