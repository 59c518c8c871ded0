#include "fuzz/findings/store.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <functional>

#include "scene/messages/error.h"
#include "scene/messages/printable.h"

namespace clues::fuzz {

using scene::Error;
using scene::ErrorCode;

namespace {

constexpr const char* schema =
    "CREATE TABLE IF NOT EXISTS about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS counters (name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS contradictions (id INTEGER PRIMARY KEY, text TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS findings (id INTEGER PRIMARY KEY, signature TEXT NOT NULL UNIQUE,"
    " case_number INTEGER NOT NULL, occurrences INTEGER NOT NULL, finding TEXT NOT NULL, folder TEXT);";
constexpr int most_bytes = 100 << 20;  // of one finding

}  // namespace

struct Store::Database {
  sqlite3* handle = nullptr;
  std::string file;

  explicit Database(const std::filesystem::path& path) : file(path.string()) {
    // SQLite would wait for the other end of a pipe.
    std::error_code error;
    const auto kind = std::filesystem::status(path, error).type();
    if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
      throw Error(ErrorCode::file_unwritable, file + ": is not a regular file; choose another folder for the campaign");
    if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) {
      const std::string why = handle ? sqlite3_errmsg(handle) : "out of memory";
      sqlite3_close(handle);
      throw Error(ErrorCode::file_unwritable, file + ": cannot open the store of findings: " + why);
    }
  }
  ~Database() { sqlite3_close(handle); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  [[noreturn]] void fail() const {
    throw Error(ErrorCode::file_unwritable, file + ": the store of findings cannot be used: " + sqlite3_errmsg(handle));
  }
  void run(const char* sql) const {
    if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }
};

namespace {

// One prepared statement; parameters and columns count from the left.
class Statement {
 public:
  template <class Database>
  Statement(const Database& db, const char* sql) : fail_([&db] { db.fail(); }) {
    if (sqlite3_prepare_v2(db.handle, sql, -1, &statement_, nullptr) != SQLITE_OK) fail_();
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& with(std::int64_t value) {
    if (sqlite3_bind_int64(statement_, ++bound_, value) != SQLITE_OK) fail_();
    return *this;
  }
  Statement& with(const std::string& value) {
    if (sqlite3_bind_text(statement_, ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT) !=
        SQLITE_OK)
      fail_();
    return *this;
  }
  bool next() {  // whether there is a row
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) fail_();
    return result == SQLITE_ROW;
  }
  std::int64_t number(int column) const { return sqlite3_column_int64(statement_, column); }
  std::string text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : "";
  }
  bool null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
  std::function<void()> fail_;
};

}  // namespace

Store::Store(const std::filesystem::path& file, const std::string& plan) : db_(std::make_unique<Database>(file)) {
  sqlite3_limit(db_->handle, SQLITE_LIMIT_LENGTH, most_bytes);
  sqlite3_db_config(db_->handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(db_->handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  db_->run("PRAGMA synchronous=FULL; PRAGMA locking_mode=EXCLUSIVE; BEGIN IMMEDIATE;");
  require_tables_only();
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

// A store that was not made here may hold triggers and views in place of tables: statements of strangers.
void Store::require_tables_only() const {
  Statement others(*db_, "SELECT name FROM sqlite_master WHERE type NOT IN ('table', 'index')");
  if (others.next())
    throw Error(ErrorCode::malformed, db_->file + ": holds '" + scene::printable(others.text(0), 40) +
                                          "', which clues did not make; choose another folder");
}

Store::~Store() = default;

std::uint64_t Store::cases_done() const {
  Statement s(*db_, "SELECT value FROM about WHERE name = 'cases done'");
  if (!s.next() || s.number(0) < 0 || s.text(0) != std::to_string(s.number(0)))
    throw Error(ErrorCode::malformed, db_->file + ": the number of cases that are done is none; the store was changed");
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
      throw Error(error.code(), fmt::format("{}: finding {}: {}", db_->file, f.id, error.what()));
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
    sqlite3_exec(db_->handle, "ROLLBACK", nullptr, nullptr, nullptr);
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
