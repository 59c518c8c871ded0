#include "fuzz/findings/store_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scene/messages/error.h"

namespace clues::fuzz {

using scene::Database;
using scene::Error;
using scene::ErrorCode;
using scene::Statement;

const char* const store_schema =
    "CREATE TABLE IF NOT EXISTS about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS counters (name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS contradictions (id INTEGER PRIMARY KEY, text TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS findings (id INTEGER PRIMARY KEY, signature TEXT NOT NULL UNIQUE,"
    " case_number INTEGER NOT NULL, occurrences INTEGER NOT NULL, finding TEXT NOT NULL, folder TEXT);"
    "CREATE TABLE IF NOT EXISTS sought (place INTEGER PRIMARY KEY, case_number INTEGER NOT NULL,"
    " new_pairs INTEGER NOT NULL);";

namespace {

constexpr std::int64_t most_cases = std::int64_t{1} << 42;

bool is_case(std::int64_t number) { return number >= 0 && number <= most_cases; }

}  // namespace

std::uint64_t stored_cases_done(const Database& store) {
  Statement s(store, "SELECT value FROM about WHERE name = 'cases done'");
  if (!s.next() || !is_case(s.number(0)) || s.text(0) != std::to_string(s.number(0)))
    throw Error(ErrorCode::malformed,
                store.file() + ": the number of cases that are done is none; the store was changed");
  return static_cast<std::uint64_t>(s.number(0));
}

Counters stored_counters(const Database& store) {
  Counters out;
  for (Statement s(store, "SELECT name, value FROM counters"); s.next();)
    out[s.text(0)] = static_cast<std::uint64_t>(s.number(1));
  return out;
}

Contradictions stored_contradictions(const Database& store) {
  Contradictions out;
  for (Statement s(store, "SELECT id, text FROM contradictions ORDER BY id"); s.next();)
    out.emplace_back(s.number(0), s.text(1));
  return out;
}

std::vector<StoredFinding> stored_findings(const Database& store) {
  std::vector<StoredFinding> out;
  for (Statement s(store, "SELECT id, case_number, occurrences, finding, folder FROM findings ORDER BY id");
       s.next();) {
    if (!is_case(s.number(1)))
      throw Error(ErrorCode::malformed,
                  fmt::format("{}: finding {}: of no case; the store was changed", store.file(), s.number(0)));
    StoredFinding f{
        s.number(0), static_cast<std::uint64_t>(s.number(1)), static_cast<std::uint64_t>(s.number(2)), {}, {}};
    try {
      f.finding = finding_from_json_text(s.text(3));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}: finding {}: {}", store.file(), f.id, error.what()));
    }
    if (!s.null(4)) f.folder = s.text(4);
    out.push_back(std::move(f));
  }
  return out;
}

void insert_sought(const Database& store, std::uint64_t place, const SoughtCase& sought) {
  Statement(store, "INSERT INTO sought VALUES (?1, ?2, ?3)")
      .with(static_cast<std::int64_t>(place))
      .with(static_cast<std::int64_t>(sought.number))
      .with(static_cast<std::int64_t>(sought.new_pairs))
      .next();
}

std::vector<SoughtCase> stored_sought(const Database& store) {
  std::vector<SoughtCase> out;
  // Stores of older releases have no such table.
  Statement table(store, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'sought'");
  if (!table.next()) return out;
  for (Statement s(store, "SELECT place, case_number, new_pairs FROM sought ORDER BY place"); s.next();) {
    if (s.number(0) != static_cast<std::int64_t>(out.size()) || !is_case(s.number(1)) || s.number(2) < 0)
      throw Error(ErrorCode::malformed, store.file() + ": the order of its cases is none; the store was changed");
    out.push_back({static_cast<std::uint64_t>(s.number(1)), static_cast<std::uint64_t>(s.number(2))});
  }
  return out;
}

StoreContent content_of(const Database& store) {
  Statement plan(store, "SELECT value FROM about WHERE name = 'plan'");
  if (!plan.next()) throw Error(ErrorCode::malformed, store.file() + ": is no store of a campaign: it has no plan");
  return {plan.text(0),           stored_cases_done(store), stored_counters(store), stored_contradictions(store),
          stored_findings(store), stored_sought(store)};
}

StoreContent read_store(const std::filesystem::path& file) {
  return content_of(Database(file, Database::Access::read, "the store of findings", "name the folder of a campaign"));
}

void write_store(const std::filesystem::path& file, const StoreContent& content) {
  scene::replace_database(file, [&](const std::filesystem::path& copy) {
    const Database db(copy, Database::Access::write, "the store of findings", "remove it");
    db.run("BEGIN IMMEDIATE");
    db.run(store_schema);
    Statement(db, "INSERT INTO about VALUES ('plan', ?)").with(content.plan).next();
    Statement(db, "INSERT INTO about VALUES ('cases done', ?)").with(std::to_string(content.cases_done)).next();
    for (const auto& [name, value] : content.counters)
      Statement(db, "INSERT INTO counters VALUES (?1, ?2)").with(name).with(static_cast<std::int64_t>(value)).next();
    for (const auto& [id, text] : content.contradictions)
      Statement(db, "INSERT INTO contradictions VALUES (?1, ?2)").with(id).with(text).next();
    for (const auto& f : content.findings) {
      Statement(db, "INSERT INTO findings VALUES (?1, ?2, ?3, ?4, ?5, CASE WHEN ?6 = '' THEN NULL ELSE ?6 END)")
          .with(f.id)
          .with(f.finding.signature())
          .with(static_cast<std::int64_t>(f.case_number))
          .with(static_cast<std::int64_t>(f.occurrences))
          .with(to_json_text(f.finding))
          .with(f.folder.value_or(""))
          .next();
    }
    for (std::size_t place = 0; place < content.sought.size(); ++place) insert_sought(db, place, content.sought[place]);
    db.run("COMMIT");
  });
}

StoreContent merged(const std::vector<StoreContent>& shards, const std::string& plan) {
  StoreContent all;
  all.plan = plan;
  std::vector<const StoredFinding*> found;
  for (const auto& shard : shards) {
    all.cases_done = shard.cases_done;
    for (const auto& [name, value] : shard.counters) all.counters[name] += value;
    all.contradictions.insert(all.contradictions.end(), shard.contradictions.begin(), shard.contradictions.end());
    for (const auto& f : shard.findings) found.push_back(&f);
  }
  std::sort(all.contradictions.begin(), all.contradictions.end());
  // Those of one case are of one shard, where they are in order.
  std::stable_sort(found.begin(), found.end(),
                   [](const StoredFinding* a, const StoredFinding* b) { return a->case_number < b->case_number; });
  std::map<std::string, std::size_t> known;
  for (const StoredFinding* f : found) {
    const auto [at, is_new] = known.emplace(f->finding.signature(), all.findings.size());
    if (is_new) {
      all.findings.push_back({static_cast<std::int64_t>(all.findings.size()) + 1, f->case_number, 0, f->finding, {}});
    }
    all.findings[at->second].occurrences += f->occurrences;
  }
  return all;
}

}  // namespace clues::fuzz
