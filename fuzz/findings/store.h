// The campaign's memory: DIR/findings.sqlite. Progress, counters and findings of a block of cases are committed in one transaction, so that after kill -9
// nothing is lost or counted twice. Findings are kept once for each signature, with the number of times they occurred. A run that ends in order leaves
// the store written anew: its bytes tell what was found, and not by how many runs, ranks or shards (store_content.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/findings/finding.h"
#include "scene/stores/database.h"

namespace clues::fuzz {

struct StoredFinding {
  std::int64_t id = 0;
  std::uint64_t case_number = 0, occurrences = 1;
  Finding finding;                    // the first one of its signature
  std::optional<std::string> folder;  // once it is shrunk and saved
};

// What came of the case of this number.
struct Judged {
  std::uint64_t number = 0;
  Outcome outcome;
  std::optional<std::uint64_t> new_pairs{};  // of rules, in a campaign that chooses its cases by them
};

// A case that was chosen (pair_seeker.h), and of how many pairs of rules it was the first.
struct SoughtCase {
  std::uint64_t number = 0, new_pairs = 0;
};

class Store {
 public:
  // Opens or makes it. `plan` says what the campaign does; throws scene::Error bad_argument when the store was made for another plan,
  // file_unwritable when it cannot be used.
  Store(const std::filesystem::path& file, const std::string& plan);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  // All cases below this number that the campaign, or this shard of it, has; where they are chosen, how many.
  std::uint64_t cases_done() const;
  Counters counters() const;
  std::vector<std::string> contradictions() const;
  std::vector<SoughtCase> sought() const;       // in the order in which they were chosen
  std::vector<StoredFinding> findings() const;  // by id, which is the order in which they were found

  // The next cases, in order; `done` is what cases_done() says from now on. All or nothing.
  void commit(const std::vector<Judged>& judged, std::uint64_t done);
  void saved(std::int64_t id, const std::string& folder);
  void contradict(const StoredFinding& finding, const std::string& text);
  // Writes the file anew; nothing may be asked afterwards.
  void finish();

 private:
  std::unique_ptr<scene::Database> db_;
};

}  // namespace clues::fuzz
