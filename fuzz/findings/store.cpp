#include "fuzz/findings/store.h"

#include <fmt/format.h>

#include "fuzz/findings/store_content.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/stores/database.h"

namespace clues::fuzz {

using scene::Database;
using scene::Error;
using scene::ErrorCode;
using scene::Statement;

namespace {

// The number of a contradiction is that of its case and its place there; what does not replay comes in the second half.
constexpr std::int64_t places = 1 << 20;

std::int64_t first_place(std::uint64_t case_number) { return static_cast<std::int64_t>(case_number) * places; }

void add_contradiction(const Database& db, std::int64_t from, const std::string& text) {
  Statement(db,
            "INSERT INTO contradictions (id, text) VALUES "
            "((SELECT coalesce(max(id) + 1, ?1) FROM contradictions WHERE id >= ?1 AND id < ?2), ?3)")
      .with(from)
      .with(from + places / 2)
      .with(text)
      .next();
}

}  // namespace

Store::Store(const std::filesystem::path& file, const std::string& plan)
    : db_(std::make_unique<Database>(file, Database::Access::write, "the store of findings",
                                     "choose another folder for the campaign")) {
  db_->run("BEGIN IMMEDIATE");
  db_->run(store_schema);
  Statement(*db_, "INSERT OR IGNORE INTO about VALUES ('plan', ?)").with(plan).next();
  db_->run("INSERT OR IGNORE INTO about VALUES ('cases done', '0'); COMMIT;");
  Statement stored(*db_, "SELECT value FROM about WHERE name = 'plan'");
  stored.next();
  if (stored.text(0) != plan) {
    throw Error(ErrorCode::bad_argument, file.string() + ": holds another campaign (" +
                                             scene::printable(stored.text(0), 400) +
                                             "); continue that one, or choose another folder");
  }
}

Store::~Store() = default;

std::uint64_t Store::cases_done() const { return stored_cases_done(*db_); }
Counters Store::counters() const { return stored_counters(*db_); }
std::vector<StoredFinding> Store::findings() const { return stored_findings(*db_); }
std::vector<SoughtCase> Store::sought() const { return stored_sought(*db_); }

std::vector<std::string> Store::contradictions() const {
  std::vector<std::string> out;
  for (auto& [id, text] : stored_contradictions(*db_)) out.push_back(std::move(text));
  return out;
}

void Store::commit(const std::vector<Judged>& judged, std::uint64_t done) {
  db_->run("BEGIN IMMEDIATE");
  try {
    Counters sums;
    std::uint64_t place = cases_done();
    for (const auto& [number, outcome, new_pairs] : judged) {
      if (new_pairs) insert_sought(*db_, place++, {number, *new_pairs});
      for (const auto& [name, value] : outcome.counters) sums[name] += value;
      for (const auto& text : outcome.contradictions) add_contradiction(*db_, first_place(number), text);
      for (const Finding& f : outcome.findings) {
        Statement(*db_,
                  "INSERT INTO findings (signature, case_number, occurrences, finding) VALUES (?1, ?2, 1, ?3)"
                  " ON CONFLICT (signature) DO UPDATE SET occurrences = occurrences + 1")
            .with(f.signature())
            .with(static_cast<std::int64_t>(number))
            .with(to_json_text(f))
            .next();
      }
    }
    for (const auto& [name, value] : sums) {
      Statement(*db_,
                "INSERT INTO counters VALUES (?1, ?2) ON CONFLICT (name) DO UPDATE SET value = value + excluded.value")
          .with(name)
          .with(static_cast<std::int64_t>(value))
          .next();
    }
    Statement(*db_, "UPDATE about SET value = ? WHERE name = 'cases done'").with(std::to_string(done)).next();
    db_->run("COMMIT");
  } catch (...) {
    db_->rollback();
    throw;
  }
}

void Store::saved(std::int64_t id, const std::string& folder) {
  Statement(*db_, "UPDATE findings SET folder = ?1 WHERE id = ?2").with(folder).with(id).next();
}

void Store::contradict(const StoredFinding& finding, const std::string& text) {
  add_contradiction(*db_, first_place(finding.case_number) + places / 2, text);
}

void Store::finish() {
  const StoreContent content = content_of(*db_);
  const std::filesystem::path file = db_->file();
  db_.reset();
  write_store(file, content);
}

}  // namespace clues::fuzz
