#include "scene/stores/database.h"

#include <sqlite3.h>

#include <utility>

#include "scene/messages/error.h"
#include "scene/messages/printable.h"

namespace clues::scene {
namespace {

constexpr int most_bytes = 100 << 20;  // of one value
constexpr int most_links = 40;         // as many as the system follows

// Where a link leads, be it to a file that is not there yet.
std::filesystem::path followed(std::filesystem::path file) {
  std::error_code error;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(file, error); ++i) {
    const auto target = std::filesystem::read_symlink(file, error);
    if (error) break;
    file = file.parent_path() / target;  // which is the target where that is absolute
  }
  return file;
}

}  // namespace

Database::Database(const std::filesystem::path& file, Access access, std::string what, std::string advice)
    : file_(file.string()), what_(std::move(what)), access_(access) {
  const auto code = access == Access::write ? ErrorCode::file_unwritable : ErrorCode::file_unreadable;
  // SQLite would wait for the other end of a pipe.
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  if (access == Access::read && kind == std::filesystem::file_type::not_found)
    throw Error(code, file_ + ": no such file");
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    throw Error(code, file_ + ": is not a regular file; " + advice);
  const int flags = access == Access::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
  if (sqlite3_open_v2(file_.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string why = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw Error(code, file_ + ": cannot open " + what_ + ": " + why);
  }
  try {
    sqlite3_limit(handle_, SQLITE_LIMIT_LENGTH, most_bytes);
    sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(handle_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    if (access == Access::write) {
      run("PRAGMA synchronous=FULL; PRAGMA locking_mode=EXCLUSIVE; BEGIN IMMEDIATE;");
      require_tables_only();
      run("COMMIT");
    } else {
      require_tables_only();
    }
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::require_tables_only() const {
  Statement others(*this, "SELECT name FROM sqlite_master WHERE type NOT IN ('table', 'index')");
  if (others.next())
    throw Error(ErrorCode::malformed,
                file_ + ": holds '" + printable(others.text(0), 40) + "', which clues did not make");
}

void Database::fail() const {
  throw Error(access_ == Access::write ? ErrorCode::file_unwritable : ErrorCode::malformed,
              file_ + ": " + what_ + " cannot be used: " + sqlite3_errmsg(handle_));
}

void Database::run(const char* sql) const {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void Database::rollback() const noexcept { sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr); }

Statement::Statement(const Database& database, const char* sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle(), sql, -1, &statement_, nullptr) != SQLITE_OK) database_.fail();
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::with(std::int64_t value) {
  if (sqlite3_bind_int64(statement_, ++bound_, value) != SQLITE_OK) database_.fail();
  return *this;
}

Statement& Statement::with(const std::string& text) {
  if (sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT) !=
      SQLITE_OK)
    database_.fail();
  return *this;
}

Statement& Statement::with_bytes(const std::string& bytes) {
  if (sqlite3_bind_blob64(statement_, ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT) != SQLITE_OK)
    database_.fail();
  return *this;
}

bool Statement::next() {
  const int result = sqlite3_step(statement_);
  if (result != SQLITE_ROW && result != SQLITE_DONE) database_.fail();
  return result == SQLITE_ROW;
}

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(statement_, column); }

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : "";
}

std::string Statement::bytes(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : "";
}

bool Statement::null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

void replace_database(const std::filesystem::path& name,
                      const std::function<void(const std::filesystem::path& copy)>& write) {
  const std::filesystem::path file = followed(name);
  const std::filesystem::path copy = file.string() + ".finishing";
  std::error_code error;
  const auto remove_copy = [&] {
    std::filesystem::remove(copy, error);
    std::filesystem::remove(copy.string() + "-journal", error);
  };
  remove_copy();  // of a process that was killed
  try {
    write(copy);
    std::filesystem::rename(copy, file, error);
    if (error) throw Error(ErrorCode::file_unwritable, file.string() + ": cannot be replaced: " + error.message());
  } catch (...) {
    remove_copy();
    throw;
  }
}

}  // namespace clues::scene
