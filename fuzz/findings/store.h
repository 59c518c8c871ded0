// The campaign's memory: DIR/findings.sqlite. Progress, counters and findings of a block of cases are committed in one transaction, so that after kill -9
// nothing is lost or counted twice. Findings are kept once for each signature, with the number of times they occurred.
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

class Store {
 public:
  // Opens or makes it. `plan` says what the campaign does; throws scene::Error bad_argument when the store was made for another plan,
  // file_unwritable when it cannot be used.
  Store(const std::filesystem::path& file, const std::string& plan);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  std::uint64_t cases_done() const;  // all cases below this number
  Counters counters() const;
  std::vector<std::string> contradictions() const;
  std::vector<StoredFinding> findings() const;  // by id, which is the order in which they were found

  // The outcomes of the cases cases_done(), cases_done() + 1, ...; all or nothing.
  void commit(const std::vector<Outcome>& outcomes);
  void saved(std::int64_t id, const std::string& folder);
  void contradict(const std::string& text);

 private:
  std::unique_ptr<scene::Database> db_;
};

}  // namespace clues::fuzz
