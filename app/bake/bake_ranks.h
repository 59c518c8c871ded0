// A bake by many ranks: pieces go out, those with most to do first, and what comes back goes into rank 0's store, whichever comes first: rows have their places, and the
// finished file tells nothing of the order. A rank is told what the store holds of a piece, as lists depend on those before them by what they cost.
#pragma once

#include <atomic>

#include "app/cluster/cluster.h"
#include "app/shard.h"
#include "fastpath/bakes/baker.h"

namespace clues::app {

// Rank 0. Throws what kernels and the store throw; what was committed stays.
void bake_by_ranks(Cluster& cluster, int threads, const scene::FlaggedMesh& scene, const scene::BakePlan& plan,
                   scene::BakeStore& store, const fastpath::bakes::ListerMaker& make_lister, Shard shard,
                   const std::atomic<bool>& stop, const fastpath::bakes::BakeProgress& progress);

// The others, with the same scene and plan. Throws scene::Error bad_argument where rank 0 has others.
void serve_bake(Cluster& cluster, int threads, const scene::FlaggedMesh& scene, const scene::BakePlan& plan,
                const fastpath::bakes::ListerMaker& make_lister, const std::string& question);

std::string question_to_ranks(const scene::BakePlan& plan);

}  // namespace clues::app
