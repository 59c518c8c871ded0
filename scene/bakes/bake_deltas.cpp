#include "scene/bakes/bake_deltas.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "scene/bakes/packed_list.h"
#include "scene/mesh/bounds.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

using Ids = std::vector<std::uint32_t>;

Ids list_of(const Database& db, std::size_t cell, std::uint32_t triangles) {
  Statement row(db, "SELECT list FROM cells WHERE id = ?");
  row.with(static_cast<std::int64_t>(cell));
  const auto where = fmt::format("{}: cell {}", db.file(), cell);
  if (!row.next() || row.null(0)) throw Error(ErrorCode::malformed, where + ": has no list; the store was damaged");
  return unpacked_list(row.bytes(0), triangles, where);
}

bool has_deltas(const Database& db) {
  return Statement(db, "SELECT 1 FROM sqlite_master WHERE name = 'deltas'").next();
}

Ids without(const Ids& list, const Ids& other) {
  Ids rest;
  std::set_difference(list.begin(), list.end(), other.begin(), other.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

void write_deltas(const Database& db, const std::vector<BakePlace>& cells, std::uint32_t triangles) {
  db.run(
      "DROP TABLE IF EXISTS deltas;"  // of a store that somebody made unfinished again
      "CREATE TABLE deltas (cell INTEGER NOT NULL, neighbour INTEGER NOT NULL, appears BLOB NOT NULL,"
      " disappears BLOB NOT NULL, PRIMARY KEY (cell, neighbour)) WITHOUT ROWID;");
  std::vector<Bounds> boxes;
  std::vector<Ids> lists;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    boxes.push_back(bounds_of(cells[c].points));
    lists.push_back(list_of(db, c, triangles));
  }
  for (std::size_t a = 0; a < cells.size(); ++a) {
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      if (!touch(boxes[a], boxes[b])) continue;
      Statement(db, "INSERT INTO deltas VALUES (?1, ?2, ?3, ?4)")
          .with(static_cast<std::int64_t>(a))
          .with(static_cast<std::int64_t>(b))
          .with_bytes(packed_list(without(lists[b], lists[a]), triangles))
          .with_bytes(packed_list(without(lists[a], lists[b]), triangles))
          .next();
    }
  }
}

void require_deltas_of_lists(const std::filesystem::path& file, const std::vector<Ids>& lists,
                             std::uint32_t triangles) {
  const Database db(file, Database::Access::read, "the bake", "name a bake");
  if (!has_deltas(db)) return;
  for (Statement row(db, "SELECT cell, neighbour, appears, disappears FROM deltas ORDER BY cell, neighbour");
       row.next();) {
    const auto where = fmt::format("{}: from cell {} to cell {}", db.file(), row.number(0), row.number(1));
    const auto list = [&](int column) -> const Ids& {
      const auto cell = static_cast<std::uint64_t>(row.number(column));
      if (cell >= lists.size())
        throw Error(ErrorCode::malformed, where + ": there is no such cell; the store was damaged");
      return lists[cell];
    };
    const Ids &from = list(0), &to = list(1);
    if (unpacked_list(row.bytes(2), triangles, where) != without(to, from) ||
        unpacked_list(row.bytes(3), triangles, where) != without(from, to))
      throw Error(ErrorCode::malformed, where + ": the delta is not what the two lists say; bake it anew");
  }
}

BakeDeltas::BakeDeltas(const std::filesystem::path& file)
    : db_(file, Database::Access::read, "the bake", "name a bake") {
  const FinishedBake bake(file);
  triangles_ = bake.plan().triangles;
  cells_ = bake.plan().cells.size();
  if (!has_deltas(db_)) throw Error(ErrorCode::malformed, db_.file() + ": has no deltas; bake it anew");
}

Ids BakeDeltas::neighbours_of(std::uint32_t cell) const {
  Ids ids;
  Statement row(db_,
                "SELECT neighbour FROM deltas WHERE cell = ?1 UNION SELECT cell FROM deltas WHERE neighbour = ?1"
                " ORDER BY 1");
  for (row.with(static_cast<std::int64_t>(cell)); row.next();) {
    if (row.number(0) < 0 || row.number(0) >= static_cast<std::int64_t>(cells_))
      throw Error(ErrorCode::malformed,
                  fmt::format("{}: cell {} has a neighbour that is none; the store was damaged", db_.file(), cell));
    ids.push_back(static_cast<std::uint32_t>(row.number(0)));
  }
  return ids;
}

std::optional<BakeDelta> BakeDeltas::between(std::uint32_t from, std::uint32_t to) const {
  Statement row(db_, "SELECT appears, disappears FROM deltas WHERE cell = ?1 AND neighbour = ?2");
  row.with(static_cast<std::int64_t>(std::min(from, to))).with(static_cast<std::int64_t>(std::max(from, to)));
  if (!row.next()) return std::nullopt;
  const auto where = fmt::format("{}: from cell {} to cell {}", db_.file(), from, to);
  BakeDelta delta{unpacked_list(row.bytes(0), triangles_, where), unpacked_list(row.bytes(1), triangles_, where)};
  if (from > to) std::swap(delta.appears, delta.disappears);
  return delta;
}

}  // namespace clues::scene
