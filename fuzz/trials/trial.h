// What is tested though it answers no scene and cell: hierarchies of surfaces (D31-D34), motion bounds (D28-D30), transitions (D24), bakes (T6), streams (D25); and lists of whole levels,
// for which the oracles of small scenes are too slow. A trial has cases of its own, and checks in place of oracles; campaigns, findings, shards and replays are those of visibility.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/findings/finding.h"
#include "fuzz/findings/named_generator.h"
#include "fuzz/generators/given_scenes.h"

namespace clues::fuzz {

class Trial {
 public:
  struct Check {
    const char* name;
    const char* what;                // one line for --help
    std::vector<const char*> needs;  // counters that must not stay 0 in a campaign
  };

  virtual ~Trial() = default;
  virtual const char* what() const = 0;  // one line for --help
  // All that there are; what some miss of what is given, they say. `given` must outlive them.
  virtual std::vector<NamedGenerator> generators(const GivenScenes& given) const = 0;
  // Whether it takes --scenes, read by read_given_levels().
  virtual bool takes_levels() const { return false; }
  virtual const std::vector<Check>& checks() const = 0;
  // Whether the check looks at the cases of this generator.
  virtual bool looks_at(const std::string& /*check*/, const std::string& /*generator*/) const { return true; }
  // Whether a case is all in its mesh, so that it can be shrunk; else its name makes it again.
  virtual bool is_a_mesh(const Case& scene) const = 0;
  // Makes those of the checks that are asked for. At most one finding of each. Throws scene::Error where a kernel does.
  virtual void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const = 0;
  // What the check of a finding finds in this scene, in which its triangle has the number that it names. Throws scene::Error where a kernel does, unless that is the finding.
  virtual std::optional<Finding> found_again(const Finding& finding, const Case& scene) const;
};

// The subjects that are trials, as make_subject() knows them.
inline constexpr std::array trial_names{"maps", "motion", "deltas", "bakes", "streams", "levels"};

// Checks with these names, in the trial's order; all without a name. Generators likewise, of those that one of the checks looks at and that miss nothing. Throw scene::Error bad_argument.
std::vector<Trial::Check> checks_named(const Trial& trial, const std::vector<std::string>& names);
std::vector<NamedGenerator> generators_named(const Trial& trial, const std::vector<std::string>& names,
                                             const std::vector<Trial::Check>& checks, const GivenScenes& given);

// What a kernel throws is a finding: it gave no answer.
Outcome judge_case(const Case& scene, const Trial& trial, const std::vector<Trial::Check>& checks);
// One of those checks: what is wrong is empty where nothing is.
void file(const Case& scene, const char* check, const std::string& wrong, Outcome& outcome);
bool is_asked(const std::vector<std::string>& asked, const char* check);

}  // namespace clues::fuzz
