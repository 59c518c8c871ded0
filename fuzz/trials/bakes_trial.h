// The subject "bakes": the lists of all cells of a small scene as `clues bake` makes them, with groups (T6), in shards, and gone on with after an interruption.
#pragma once

#include <functional>
#include <memory>

#include "fastpath/bakes/baker.h"
#include "fuzz/trials/trial.h"

namespace clues::fuzz {

// What makes a bake. Tests plant mistakes in each.
struct BakeMakers {
  fastpath::bakes::ListerMaker fast, exact;
  // Gives a plan that has its cells the nodes of so many cells each.
  std::function<void(scene::BakePlan& plan, std::size_t most)> add_groups;
};

std::unique_ptr<Trial> make_bakes_trial();
std::unique_ptr<Trial> make_bakes_trial(BakeMakers makers);
BakeMakers our_bake_makers();

}  // namespace clues::fuzz
