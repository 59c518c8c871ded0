// SQLite with our errors: a file that keeps what a long run has found, whatever happens to the run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace clues::scene {

class Database {
 public:
  enum class Access { write, read };

  // Opens the file, or makes it. `what` and `advice` are for messages: "the store of findings", "choose another folder". No other process may write as
  // long as this one does. Refuses a file that holds more than tables: triggers and views are statements of strangers.
  // Throws Error file_unwritable (file_unreadable), malformed.
  Database(const std::filesystem::path& file, Access access, std::string what, std::string advice);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const char* sql) const;
  void rollback() const noexcept;
  [[noreturn]] void fail() const;
  const std::string& file() const { return file_; }
  sqlite3* handle() const { return handle_; }

 private:
  void require_tables_only() const;

  std::string file_, what_;
  Access access_;
  sqlite3* handle_ = nullptr;
};

// One prepared statement; parameters and columns count from the left.
class Statement {
 public:
  Statement(const Database& database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& with(std::int64_t value);
  Statement& with(const std::string& text);
  Statement& with_bytes(const std::string& bytes);
  bool next();  // whether there is a row
  std::int64_t number(int column) const;
  std::string text(int column) const;  // what a text or a blob holds; empty where there is none
  std::string bytes(int column) const;
  bool null(int column) const;

 private:
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

// Another database in the place of `file`: `write` makes it in the file beside it whose name it is given, and that is moved there. What
// `write` throws is thrown on; then nothing is left beside `file`, which is as it was. Where `file` is a link, that stays,
// and what it leads to is replaced. Throws Error file_unwritable where it cannot be moved.
void replace_database(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& copy)>& write);

}  // namespace clues::scene
