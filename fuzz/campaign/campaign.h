// A campaign: cases of all generators by turns, put to a subject and judged by the oracles, in worker processes of one machine or many. Case number n is scene first + n / G of generator
// n modulo G, a pure function of the seed; outcomes are committed in the order of the cases, so the findings do not depend on the number of jobs. The order is that of
// their numbers, or, with seek_pairs, one in which those come first that may show pairs of rules that were never met in one case.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/campaign/given_files.h"
#include "fuzz/findings/store.h"
#include "fuzz/shrinking/shrink.h"
#include "validate/processes/work_pool.h"

namespace clues::fuzz {

struct CampaignOptions {
  std::uint64_t seed = 1, first = 0;
  std::vector<std::string> generators, oracles;  // empty: all
  GivenScenes given;
  bool dials = false;                             // turn dials in half of the cases (dials.h)
  bool seek_pairs = false;                        // choose the cases (pair_seeker.h); not with shards
  std::optional<std::uint64_t> cases;             // in all, those of earlier runs included
  std::optional<std::chrono::milliseconds> time;  // of this run, before shrinking
  int jobs = 1;
  std::uint64_t errors = 0;  // stop at so many different findings; 0: never
  std::filesystem::path out = "fuzz-out";
  // Of the cases only those whose number leaves `shard` when divided by `shards`; nothing is shrunk then, and `cases` must be given.
  std::uint64_t shard = 0, shards = 1;
  std::vector<std::filesystem::path> merged;  // folders of all shards, which are taken over first
  ShrinkLimits shrink;
  std::uint64_t block = 16;  // cases committed together
  std::chrono::seconds time_for_one{300};
  std::function<void(const std::string& stage, std::uint64_t done, std::uint64_t total)> progress;
  bool require_coverage = false;            // a campaign that is too short to be judged is vacuous too
  const std::atomic<bool>* stop = nullptr;  // set by a signal: finish what is begun, commit, leave
  validate::PoolMaker pool;                 // that judges cases, by number; none: `jobs` processes of this machine
};

struct CampaignSummary {
  std::string subject;
  std::uint64_t cases = 0, cases_now = 0;  // in all; in this run
  std::size_t generators = 0;
  std::uint64_t enough = 0;  // so many cases, and the campaign is judged by what never occurred
  bool judged = false;       // it has them, or was asked to be judged all the same
  double seconds_now = 0;
  bool interrupted = false;
  bool is_shard = false, is_trial = false;
  Counters counters;
  std::vector<StoredFinding> findings;
  std::vector<std::string> contradictions;
  std::vector<std::string> never_occurred;  // not empty: the campaign is vacuous, if it is judged

  // 0 none, 1 findings, 3 vacuous or interrupted, 4 contradictions.
  int exit_code() const;
};

// Continues the campaign in options.out, or begins one. Throws scene::Error for bad options and an unusable folder.
CampaignSummary run_campaign(const CampaignOptions& options, const Subject& subject);

// Judges cases of another process' campaign: `serve` is told its plan, and how. No file is touched.
void serve_campaign(const CampaignOptions& options, const Subject& subject, const validate::Serve& serve);

std::string to_text(const CampaignSummary& summary, const std::filesystem::path& out);

}  // namespace clues::fuzz
