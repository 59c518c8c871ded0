#include "scene/stream/list_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "scene/stream/sealed_bytes.h"
#include "scene/stream/varints.h"

namespace clues::scene {
namespace {

using Kind = ListRecord::Kind;

constexpr SealedKind lists_kind{"lists", "CLUESLST", 1};
constexpr std::uint64_t most_listed = (std::uint64_t{1} << 32) / 3;  // so that edges have numbers of 32 bits

void write_record(const ListRecord& record, std::uint32_t place, VarintWriter& out) {
  out.number(static_cast<std::uint64_t>(record.kind));
  if (has_of(record.kind)) out.number(place - record.of - 1);
  if (has_first(record.kind)) write_ascending(record.first, out);
  if (has_second(record.kind)) write_ascending(record.second, out);
}

ListRecord read_record(VarintReader& in, std::uint32_t place, std::uint64_t triangles) {
  ListRecord record;
  record.kind = static_cast<Kind>(in.number(ListRecord::kinds));
  if (has_of(record.kind)) record.of = place - 1 - static_cast<std::uint32_t>(in.number(place));
  if (has_first(record.kind)) read_ascending(in, triangles, record.first);
  if (has_second(record.kind))
    read_ascending(in, record.kind == Kind::delta ? triangles : 3 * triangles, record.second);
  return record;
}

// Corners of cells have few coordinates that differ, so these are written once: by bits, ascending.
std::vector<std::uint64_t> coordinates_of(const ListFile& file) {
  std::vector<std::uint64_t> bits;
  for (const ListedCell& cell : file.cells) {
    for (const auto* points : {&cell.points, &cell.inner}) {
      for (const Point& p : *points) {
        for (const double x : p) bits.push_back(std::bit_cast<std::uint64_t>(x));
      }
    }
  }
  std::sort(bits.begin(), bits.end());
  bits.erase(std::unique(bits.begin(), bits.end()), bits.end());
  return bits;
}

void write_corners(const std::vector<Point>& points, const std::vector<std::uint64_t>& coordinates, VarintWriter& out) {
  out.number(points.size());
  for (const Point& p : points) {
    for (const double x : p) {
      const auto at = std::lower_bound(coordinates.begin(), coordinates.end(), std::bit_cast<std::uint64_t>(x));
      out.number(static_cast<std::uint64_t>(at - coordinates.begin()));
    }
  }
}

std::vector<Point> read_corners(VarintReader& in, const std::vector<double>& coordinates) {
  std::vector<Point> points;
  for (std::uint64_t n = in.count(); n > 0; --n) {
    Point p{};
    for (double& x : p) x = coordinates[in.number(coordinates.size())];
    points.push_back(p);
  }
  return points;
}

std::string unsealed(const ListFile& file) {
  VarintWriter out = begun(lists_kind);
  out.bytes += bytes_of_hash(file.scene_sha256);
  out.number(file.scene_triangles);
  out.text(file.question);
  const auto coordinates = coordinates_of(file);
  out.number(coordinates.size());
  for (const std::uint64_t bits : coordinates) out.raw(bits, 8);
  out.number(file.cells.size());
  for (const ListedCell& cell : file.cells) {
    out.text(cell.name);
    write_corners(cell.points, coordinates, out);
    write_corners(cell.inner, coordinates, out);
  }
  out.number(file.levels.size());
  for (std::size_t level = 0; level < file.levels.size(); ++level) {
    const auto& places = file.levels[level];
    if (level + 1 < file.levels.size()) out.number(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      if (level > 0) out.number(places[i].within);
      write_record(places[i].record, i, out);
    }
  }
  return out.bytes;
}

}  // namespace

bool has_of(Kind kind) { return kind == Kind::same || kind == Kind::changed || kind == Kind::delta; }
bool has_first(Kind kind) { return kind != Kind::all && kind != Kind::same; }
bool has_second(Kind kind) { return kind == Kind::contour || kind == Kind::changed || kind == Kind::delta; }

std::string record_bytes(const ListRecord& record, std::uint32_t place) {
  VarintWriter out;
  write_record(record, place, out);
  return out.bytes;
}

std::string to_bytes(const ListFile& file) { return sealed_bytes(unsealed(file)); }

ListFile parse_unsealed_lists(std::string_view bytes, const std::string& where) {
  VarintReader in = begin_reading(lists_kind, bytes, where);
  ListFile file;
  file.scene_sha256 = digits_of_hash(in.bytes(hash_bytes));
  file.scene_triangles = in.number(most_listed);
  file.question = in.text();
  std::vector<double> coordinates;
  for (std::uint64_t n = in.count(); n > 0; --n) coordinates.push_back(in.real());
  for (std::uint64_t n = in.count(); n > 0; --n) {
    ListedCell cell;
    cell.name = in.text();
    cell.points = read_corners(in, coordinates);
    cell.inner = read_corners(in, coordinates);
    if (cell.points.empty()) in.fail("a cell without a corner");
    if (cell.inner == cell.points) in.fail("an inner cell that is the cell, which is not written");
    file.cells.push_back(std::move(cell));
  }
  if (file.cells.empty()) in.fail("without a cell");
  const std::uint64_t levels = in.count();
  if (levels == 0) in.fail("without a list");
  for (std::uint64_t level = 0; level < levels; ++level) {
    const std::uint64_t places = level + 1 < levels ? in.count() : file.cells.size();
    file.levels.emplace_back();
    for (std::uint32_t i = 0; i < places; ++i) {
      ListPlace place;
      if (level > 0) place.within = static_cast<std::uint32_t>(in.number(file.levels[level - 1].size()));
      place.record = read_record(in, i, file.scene_triangles);
      file.levels.back().push_back(std::move(place));
    }
  }
  if (!in.done()) in.fail("something stands behind the last cell");
  if (unsealed(file) != bytes) in.fail("is not written in the one form that such a file has");
  return file;
}

ListFile parse_lists(std::string_view bytes, const std::string& where) {
  return parse_unsealed_lists(opened_bytes(lists_kind, bytes, where), where);
}

ListFile read_lists(const std::filesystem::path& path) { return parse_lists(read_file_bytes(path), path.string()); }

}  // namespace clues::scene
