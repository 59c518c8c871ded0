#include "fuzz/findings/store.h"

#include <fmt/format.h>

#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/stores/database.h"

namespace clues::fuzz {

using scene::Database;
using scene::Error;
using scene::ErrorCode;
using scene::Statement;

namespace {

constexpr const char* schema =
    "CREATE TABLE IF NOT EXISTS about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS counters (name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS contradictions (id INTEGER PRIMARY KEY, text TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS findings (id INTEGER PRIMARY KEY, signature TEXT NOT NULL UNIQUE,"
    " case_number INTEGER NOT NULL, occurrences INTEGER NOT NULL, finding TEXT NOT NULL, folder TEXT);";

}  // namespace

Store::Store(const std::filesystem::path& file, const std::string& plan)
    : db_(std::make_unique<Database>(file, Database::Access::write, "the store of findings",
                                     "choose another folder for the campaign")) {
  db_->run("BEGIN IMMEDIATE");
  db_->run(schema);
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

std::uint64_t Store::cases_done() const {
  Statement s(*db_, "SELECT value FROM about WHERE name = 'cases done'");
  if (!s.next() || s.number(0) < 0 || s.text(0) != std::to_string(s.number(0)))
    throw Error(ErrorCode::malformed,
                db_->file() + ": the number of cases that are done is none; the store was changed");
  return static_cast<std::uint64_t>(s.number(0));
}

Counters Store::counters() const {
  Counters out;
  for (Statement s(*db_, "SELECT name, value FROM counters"); s.next();)
    out[s.text(0)] = static_cast<std::uint64_t>(s.number(1));
  return out;
}

std::vector<std::string> Store::contradictions() const {
  std::vector<std::string> out;
  for (Statement s(*db_, "SELECT text FROM contradictions ORDER BY id"); s.next();) out.push_back(s.text(0));
  return out;
}

std::vector<StoredFinding> Store::findings() const {
  std::vector<StoredFinding> out;
  for (Statement s(*db_, "SELECT id, case_number, occurrences, finding, folder FROM findings ORDER BY id"); s.next();) {
    StoredFinding f{
        s.number(0), static_cast<std::uint64_t>(s.number(1)), static_cast<std::uint64_t>(s.number(2)), {}, {}};
    try {
      f.finding = finding_from_json_text(s.text(3));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}: finding {}: {}", db_->file(), f.id, error.what()));
    }
    if (!s.null(4)) f.folder = s.text(4);
    out.push_back(std::move(f));
  }
  return out;
}

void Store::commit(const std::vector<Outcome>& outcomes) {
  const std::uint64_t done = cases_done();
  db_->run("BEGIN IMMEDIATE");
  try {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      for (const auto& [name, value] : outcomes[i].counters) {
        Statement(
            *db_,
            "INSERT INTO counters VALUES (?1, ?2) ON CONFLICT (name) DO UPDATE SET value = value + excluded.value")
            .with(name)
            .with(static_cast<std::int64_t>(value))
            .next();
      }
      for (const auto& text : outcomes[i].contradictions)
        Statement(*db_, "INSERT INTO contradictions (text) VALUES (?)").with(text).next();
      for (const Finding& f : outcomes[i].findings) {
        Statement(*db_,
                  "INSERT INTO findings (signature, case_number, occurrences, finding) VALUES (?1, ?2, 1, ?3)"
                  " ON CONFLICT (signature) DO UPDATE SET occurrences = occurrences + 1")
            .with(f.signature())
            .with(static_cast<std::int64_t>(done + i))
            .with(to_json_text(f))
            .next();
      }
    }
    Statement(*db_, "UPDATE about SET value = ? WHERE name = 'cases done'")
        .with(std::to_string(done + outcomes.size()))
        .next();
    db_->run("COMMIT");
  } catch (...) {
    db_->rollback();
    throw;
  }
}

void Store::saved(std::int64_t id, const std::string& folder) {
  Statement(*db_, "UPDATE findings SET folder = ?1 WHERE id = ?2").with(folder).with(id).next();
}

void Store::contradict(const std::string& text) {
  Statement(*db_, "INSERT INTO contradictions (text) VALUES (?)").with(text).next();
}

}  // namespace clues::fuzz
