#include "scene/bakes/bake_store.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "scene/bakes/bake_deltas.h"
#include "scene/bakes/packed_list.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"

namespace clues::scene {
namespace {

namespace fs = std::filesystem;

constexpr const char* format = "clues-bake/1";
// An INTEGER PRIMARY KEY is the row's number, so that tables are in order whatever the order was in which rows came.
constexpr const char* schema =
    "CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE nodes (id INTEGER PRIMARY KEY, node INTEGER NOT NULL, points BLOB NOT NULL,"
    " list BLOB, listed INTEGER, fallbacks INTEGER, mapped INTEGER, passes INTEGER);"
    "CREATE TABLE cells (id INTEGER PRIMARY KEY, name TEXT NOT NULL, node INTEGER NOT NULL, cluster INTEGER,"
    " points BLOB NOT NULL, inner BLOB,"
    " list BLOB, listed INTEGER, fallbacks INTEGER, mapped INTEGER, passes INTEGER);";

static_assert(std::endian::native == std::endian::little, "points are stored as little-endian doubles");

std::string bytes_of(const std::vector<Point>& points) {
  std::string bytes(points.size() * sizeof(Point), '\0');
  if (!points.empty()) std::memcpy(bytes.data(), points.data(), bytes.size());
  return bytes;
}

std::vector<Point> points_of(const std::string& bytes, const std::string& where) {
  std::vector<Point> points(bytes.size() / sizeof(Point));
  bool finite = !points.empty() && bytes.size() % sizeof(Point) == 0;
  if (finite) std::memcpy(points.data(), bytes.data(), bytes.size());
  for (const auto& p : points) finite = finite && std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  if (!finite) throw Error(ErrorCode::malformed, where + ": no points; the store was damaged");
  return points;
}

std::string where(const Database& db, PlaceKind kind, std::int64_t index) {
  return fmt::format("{}: {} {}", db.file(), kind == PlaceKind::cell ? "cell" : "node", index);
}

std::string about(const Database& db, const std::string& name) {
  Statement s(db, "SELECT value FROM about WHERE name = ?");
  s.with(name);
  if (!s.next()) throw Error(ErrorCode::malformed, db.file() + ": is no bake of clues: it does not say its " + name);
  return s.text(0);
}

bool is_empty(const Database& db) { return !Statement(db, "SELECT 1 FROM sqlite_master").next(); }

void require_format(const Database& db) {
  if (!Statement(db, "SELECT 1 FROM sqlite_master WHERE name = 'about'").next() || about(db, "format") != format)
    throw Error(ErrorCode::malformed, db.file() + ": is no bake of clues (" + format + ")");
}

bool says_finished(const Database& db) { return about(db, "finished") == "yes"; }

BakedPlace place_of(const Statement& row, std::uint32_t triangles, const std::string& where) {
  BakedPlace place;
  place.list = unpacked_list(row.bytes(0), triangles, where);
  if (row.number(1) != static_cast<std::int64_t>(place.list.size()))
    throw Error(ErrorCode::malformed, where + ": a list that is not as long as the store says; it was damaged");
  place.fallbacks = row.number(2);
  place.mapped = row.number(3);
  place.passes = row.number(4);
  return place;
}

std::optional<BakedPlace> find_place(const Database& db, PlaceKind kind, std::uint32_t index, std::uint32_t triangles) {
  Statement row(db, kind == PlaceKind::cell ? "SELECT list, listed, fallbacks, mapped, passes FROM cells WHERE id = ?"
                                            : "SELECT list, listed, fallbacks, mapped, passes FROM nodes WHERE id = ?");
  row.with(static_cast<std::int64_t>(index));
  if (!row.next()) throw Error(ErrorCode::malformed, where(db, kind, index) + ": is missing; the store was damaged");
  if (row.null(0)) return std::nullopt;
  return place_of(row, triangles, where(db, kind, index));
}

}  // namespace

BakeStore::BakeStore(const fs::path& file, const BakePlan& plan)
    : file_(file),
      plan_(plan),
      db_(std::make_unique<Database>(file, Database::Access::write, "the bake", "name another file")) {
  if (is_empty(*db_)) {
    make(plan);
  } else {
    require_same(plan, *db_);
  }
  finished_ = says_finished(*db_);
}

void BakeStore::make(const BakePlan& plan) {
  db_->run("BEGIN IMMEDIATE");
  try {
    db_->run(schema);
    for (const auto& [name, value] : {std::pair<std::string, std::string>{"format", format},
                                      {"scene", plan.scene_file},
                                      {"scene_sha256", plan.scene_sha256},
                                      {"triangles", std::to_string(plan.triangles)},
                                      {"question", plan.question},
                                      {"note", plan.note},
                                      {"finished", "no"}})
      Statement(*db_, "INSERT INTO about VALUES (?1, ?2)").with(name).with(value).next();
    for (std::size_t i = 1; i < plan.nodes.size(); ++i) {
      Statement(*db_, "INSERT INTO nodes (id, node, points) VALUES (?1, ?2, ?3)")
          .with(static_cast<std::int64_t>(i))
          .with(static_cast<std::int64_t>(plan.nodes[i].node))
          .with_bytes(bytes_of(plan.nodes[i].points))
          .next();
    }
    for (std::size_t i = 0; i < plan.cells.size(); ++i) {
      const auto& cell = plan.cells[i];
      Statement insert(*db_,
                       "INSERT INTO cells (id, name, node, points, cluster, inner) VALUES (?1, ?2, ?3, ?4, ?5, "
                       "CASE WHEN length(?6) = 0 THEN NULL ELSE ?6 END)");
      insert.with(static_cast<std::int64_t>(i)).with(cell.name).with(static_cast<std::int64_t>(cell.node));
      insert.with_bytes(bytes_of(cell.points)).with(cell.group).with_bytes(bytes_of(cell.inner)).next();
    }
    db_->run("COMMIT");
  } catch (...) {
    db_->rollback();
    throw;
  }
}

void BakeStore::require_store_of(const BakePlan& plan, const fs::path& file) {
  require_same(plan, Database(file, Database::Access::read, "the bake", "name a bake"));
}

void BakeStore::require_same(const BakePlan& plan, const Database& db) {
  require_format(db);
  for (const auto& [name, value] : {std::pair<std::string, std::string>{"scene_sha256", plan.scene_sha256},
                                    {"triangles", std::to_string(plan.triangles)},
                                    {"question", plan.question}}) {
    if (about(db, name) == value) continue;
    throw Error(ErrorCode::bad_argument, db.file() + ": holds another bake (" +
                                             (name == "question" ? "of other cells or options" : "of another scene") +
                                             "); repeat its command to go on with it, or name another file");
  }
  Statement count(db, "SELECT (SELECT count(*) FROM cells), (SELECT count(*) FROM nodes)");
  count.next();
  if (count.number(0) != static_cast<std::int64_t>(plan.cells.size()) ||
      count.number(1) != static_cast<std::int64_t>(plan.nodes.size()) - 1)
    throw Error(ErrorCode::malformed, db.file() + ": cells are missing; the store was damaged");
}

bool BakeStore::has(PlaceKind kind, std::uint32_t index) const {
  Statement row(*db_, kind == PlaceKind::cell ? "SELECT 1 FROM cells WHERE id = ? AND list IS NOT NULL"
                                              : "SELECT 1 FROM nodes WHERE id = ? AND list IS NOT NULL");
  return row.with(static_cast<std::int64_t>(index)).next();
}

bool BakeStore::has_all_cells() const { return !Statement(*db_, "SELECT 1 FROM cells WHERE list IS NULL").next(); }

std::optional<BakedPlace> BakeStore::find(PlaceKind kind, std::uint32_t index) const {
  return find_place(*db_, kind, index, plan_.triangles);
}

void BakeStore::commit(const std::vector<Done>& done) {
  db_->run("BEGIN IMMEDIATE");
  try {
    for (const auto& [kind, index, place] : done) {
      Statement(*db_,
                kind == PlaceKind::cell
                    ? "UPDATE cells SET list = ?1, listed = ?2, fallbacks = ?3, mapped = ?4, passes = ?5 WHERE id = ?6"
                    : "UPDATE nodes SET list = ?1, listed = ?2, fallbacks = ?3, mapped = ?4, passes = ?5 WHERE id = ?6")
          .with_bytes(packed_list(place.list, plan_.triangles))
          .with(static_cast<std::int64_t>(place.list.size()))
          .with(place.fallbacks)
          .with(place.mapped)
          .with(place.passes)
          .with(static_cast<std::int64_t>(index))
          .next();
    }
    db_->run("COMMIT");
  } catch (...) {
    db_->rollback();
    throw;
  }
}

std::uint64_t BakeStore::take_from(const fs::path& file) {
  const Database other(file, Database::Access::read, "the bake", "name a bake");
  require_same(plan_, other);
  std::vector<Done> taken;
  std::uint64_t cells = 0;
  const auto take = [&](PlaceKind kind, std::uint32_t index) {
    if (has(kind, index)) return;
    auto place = find_place(other, kind, index, plan_.triangles);
    if (!place) return;
    taken.push_back({kind, index, std::move(*place)});
    cells += kind == PlaceKind::cell ? 1 : 0;
  };
  for (std::uint32_t i = 1; i < plan_.nodes.size(); ++i) take(PlaceKind::node, i);
  for (std::uint32_t i = 0; i < plan_.cells.size(); ++i) take(PlaceKind::cell, i);
  commit(taken);
  return cells;
}

void BakeStore::finish() {
  // All rows in their order; before that is in place the bake is one that can be gone on with.
  replace_database(file_, [&](const fs::path& copy) {
    try {
      Statement(*db_, "VACUUM INTO ?").with(copy.string()).next();
      const Database finished(copy, Database::Access::write, "the copy", "remove it");
      finished.run("BEGIN");
      write_deltas(finished, plan_.cells, plan_.triangles);
      finished.run("UPDATE about SET value = 'yes' WHERE name = 'finished'");
      finished.run("COMMIT");
    } catch (const Error& cause) {
      throw Error(cause.code(), db_->file() + ": is all there but cannot be written anew: " + cause.what());
    }
    db_.reset();
  });
}

FinishedBake::FinishedBake(const fs::path& file) : db_(file, Database::Access::read, "the bake", "name a bake") {
  require_format(db_);
  if (!says_finished(db_)) {
    Statement count(db_, "SELECT count(list), count(*) FROM cells");
    count.next();
    throw Error(ErrorCode::bad_argument,
                fmt::format("{}: is not finished: {} of {} cells; repeat the command of its bake to go on", db_.file(),
                            count.number(0), count.number(1)));
  }
  plan_.scene_file = about(db_, "scene");
  plan_.scene_sha256 = about(db_, "scene_sha256");
  plan_.question = about(db_, "question");
  plan_.note = about(db_, "note");
  const auto triangles = about(db_, "triangles");
  Statement number(db_, "SELECT CAST(?1 AS INTEGER)");
  number.with(triangles).next();
  if (number.number(0) < 1 || number.number(0) > 0xffffffffLL || std::to_string(number.number(0)) != triangles)
    throw Error(ErrorCode::malformed, db_.file() + ": no number of triangles; the store was damaged");
  plan_.triangles = static_cast<std::uint32_t>(number.number(0));
  plan_.nodes.emplace_back();
  for (Statement s(db_, "SELECT id, node, points FROM nodes ORDER BY id"); s.next();) {
    const auto at = where(db_, PlaceKind::node, s.number(0));
    if (s.number(0) != static_cast<std::int64_t>(plan_.nodes.size()) || s.number(1) < 0 || s.number(1) >= s.number(0))
      throw Error(ErrorCode::malformed, at + ": is out of order; the store was damaged");
    plan_.nodes.push_back({"",
                           static_cast<std::uint32_t>(s.number(1)),
                           s.bytes(2).empty() ? std::vector<Point>{} : points_of(s.bytes(2), at),
                           {},
                           -1});
  }
  for (Statement s(db_, "SELECT id, name, node, points, inner, cluster FROM cells ORDER BY id"); s.next();) {
    const auto at = where(db_, PlaceKind::cell, s.number(0));
    if (s.number(0) != static_cast<std::int64_t>(plan_.cells.size()) || s.number(2) < 0 ||
        s.number(2) >= static_cast<std::int64_t>(plan_.nodes.size()))
      throw Error(ErrorCode::malformed, at + ": is out of order; the store was damaged");
    plan_.cells.push_back({s.text(1), static_cast<std::uint32_t>(s.number(2)), points_of(s.bytes(3), at),
                           s.null(4) ? std::vector<Point>{} : points_of(s.bytes(4), at), s.number(5)});
  }
}

BakedPlace FinishedBake::cell(std::uint32_t index) const {
  auto place = find_place(db_, PlaceKind::cell, index, plan_.triangles);
  if (!place)
    throw Error(ErrorCode::malformed, where(db_, PlaceKind::cell, index) + ": has no list; the store was damaged");
  return std::move(*place);
}

}  // namespace clues::scene
