#include "scene/stream/contour_file.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <utility>

#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "scene/stream/sealed_bytes.h"
#include "scene/stream/varints.h"

namespace clues::scene {
namespace {

constexpr SealedKind contours_kind{"contours", "CLUESCON", 1};
constexpr std::uint64_t all_numbers = std::uint64_t{1} << 32;
constexpr std::uint64_t plane_kinds = 4, point_kinds = 5;
constexpr std::uint32_t most_bits = 52;

// How many of `points`, and of `cell`, a plane has.
std::size_t points_of(ContourPlane::Kind kind) {
  return kind == ContourPlane::Kind::vertex ? 1 : kind == ContourPlane::Kind::triangle ? 3 : 2;
}
std::size_t corners_of(ContourPlane::Kind kind) {
  return kind == ContourPlane::Kind::triangle ? 0 : kind == ContourPlane::Kind::edge ? 1 : 2;
}

// A point is written as 0 when it is the first that was not there yet, else as its number and 1.
class PointsOfSide {
 public:
  explicit PointsOfSide(std::uint64_t known) : next_(known) {}
  std::uint64_t code(std::uint32_t point) { return point == next_ ? (++next_, 0) : 1 + std::uint64_t{point}; }
  std::uint32_t point(std::uint64_t code) { return static_cast<std::uint32_t>(code == 0 ? next_++ : code - 1); }
  std::uint64_t next() const { return next_; }

 private:
  std::uint64_t next_;
};

void write_planes(const ContourCell& cell, VarintWriter& out) {
  out.number(cell.planes.size());
  for (const ContourPlane& plane : cell.planes) {
    out.number(static_cast<std::uint64_t>(plane.kind) + plane_kinds * plane.points[0]);
    for (std::size_t i = 1; i < points_of(plane.kind); ++i) out.number(plane.points[i]);
    for (std::size_t i = 0; i < corners_of(plane.kind); ++i) out.number(plane.cell[i]);
    if (plane.kind == ContourPlane::Kind::crossing) out.number(plane.crossed);
  }
}

bool is_whole_edge(const ContourSide::Block& block) {
  return block.ends == PointPair{block.edge, (block.edge + 1) % 3};
}

void write_side(const ContourSide& side, std::uint64_t known, VarintWriter& out) {
  const auto has = [](const auto& list, unsigned bit) { return list.empty() ? 0U : bit; };
  out.number(8 * side.points.size() + has(side.segments, 1) + has(side.blocks, 2) + has(side.bridges, 4));
  for (const ContourPoint& point : side.points) {
    out.number(static_cast<std::uint64_t>(point.kind) + point_kinds * point.first);
    if (point.kind == ContourPoint::Kind::in_full) {
      for (const std::string& x : point.at) out.text(x);
    } else {
      out.number(point.second);
    }
  }
  PointsOfSide points(known);
  if (!side.segments.empty()) out.number(side.segments.size() - 1);
  const PointPair* last = nullptr;
  for (const PointPair& segment : side.segments) {  // 0: from where the last one has ended
    const bool goes_on = last != nullptr && (*last)[1] == segment[0];
    out.number(goes_on ? 0 : 1 + points.code(segment[0]));
    out.number(points.code(segment[1]));
    last = &segment;
  }
  if (!side.blocks.empty()) out.number(side.blocks.size() - 1);
  for (const auto& block : side.blocks) {  // 0, 1, 2: all of an edge
    if (is_whole_edge(block)) {
      out.number(block.edge);
      continue;
    }
    out.number(3 + block.edge + 3 * points.code(block.ends[0]));
    out.number(points.code(block.ends[1]));
  }
  if (!side.bridges.empty()) out.number(side.bridges.size() - 1);
  for (const PointPair& bridge : side.bridges) {
    for (const std::uint32_t p : bridge) out.number(points.code(p));
  }
}

void write_seed(const ContourSeed& seed, VarintWriter& out) {
  out.number(seed.bits + (most_bits + 1) * std::uint64_t{seed.from});
  if (seed.bits == 0) {
    for (const std::string& x : seed.fractions) out.text(x);
  } else {
    for (const std::uint64_t x : seed.at) out.number(x);
  }
}

// "p/q", or "p": digits without a zero in front, q not 0 and not 1.
bool is_fraction(std::string_view text) {
  if (text == "-0") return false;
  if (text.starts_with('-')) text.remove_prefix(1);
  const auto is_number = [](std::string_view digits) {
    return !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos &&
           (digits == "0" || digits[0] != '0');
  };
  const std::size_t bar = text.find('/');
  if (bar == std::string_view::npos) return is_number(text);
  const std::string_view below = text.substr(bar + 1);
  return is_number(text.substr(0, bar)) && is_number(below) && below != "0" && below != "1";
}

std::string in_lowest_terms(const std::string& text) {
  mpq_class x(text);
  x.canonicalize();
  return x.get_str();
}

std::uint32_t read_number(VarintReader& in, std::uint64_t below) {
  return static_cast<std::uint32_t>(in.number(std::min(below, all_numbers)));
}

std::string read_fraction(VarintReader& in) {
  std::string text = in.text();
  if (!is_fraction(text) || in_lowest_terms(text) != text) in.fail("a coordinate in full is no fraction p/q");
  return text;
}

std::vector<ContourPlane> read_planes(VarintReader& in, std::uint64_t scene_points, std::uint64_t corners) {
  std::vector<ContourPlane> planes;
  for (std::uint64_t n = in.count(); n > 0; --n) {
    ContourPlane plane;
    const std::uint64_t begin = in.number(plane_kinds * scene_points);
    plane.kind = static_cast<ContourPlane::Kind>(begin % plane_kinds);
    plane.points[0] = static_cast<std::uint32_t>(begin / plane_kinds);
    for (std::size_t i = 1; i < points_of(plane.kind); ++i) plane.points[i] = read_number(in, scene_points);
    for (std::size_t i = 0; i < corners_of(plane.kind); ++i) plane.cell[i] = read_number(in, corners);
    if (plane.kind == ContourPlane::Kind::crossing) plane.crossed = read_number(in, planes.size());
    planes.push_back(plane);
  }
  return planes;
}

ContourPoint read_point(VarintReader& in, const DrawingSize& known, std::uint64_t planes) {
  ContourPoint point;
  const std::uint64_t begin = in.number(point_kinds * all_numbers);
  point.kind = static_cast<ContourPoint::Kind>(begin % point_kinds);
  point.first = static_cast<std::uint32_t>(begin / point_kinds);
  const auto require_first = [&](std::uint64_t below) {
    if (point.first >= below) in.fail();
  };
  switch (point.kind) {
    case ContourPoint::Kind::on_edge:
      require_first(3);
      point.second = read_number(in, planes);
      break;
    case ContourPoint::Kind::crossing:
      require_first(planes);
      point.second = read_number(in, planes);
      if (point.first == point.second) in.fail("a point where a plane crosses itself");
      break;
    case ContourPoint::Kind::on_segment:
      require_first(known.segments);
      point.second = read_number(in, planes);
      break;
    case ContourPoint::Kind::again:
      require_first(3);
      point.second = read_number(in, all_numbers);
      break;
    case ContourPoint::Kind::in_full:
      require_first(4 + known.segments);
      for (std::string& x : point.at) x = read_fraction(in);
      break;
  }
  return point;
}

void read_side(VarintReader& in, const DrawingSize& known, std::uint64_t planes, ContourSide& side) {
  const std::uint64_t begin = in.number(8 * all_numbers);
  for (std::uint64_t n = begin / 8; n > 0; --n) side.points.push_back(read_point(in, known, planes));
  // How many of a list there are, where there is one.
  const auto count = [&](unsigned bit) { return (begin & bit) == 0 ? 0 : 1 + in.count(); };
  PointsOfSide points(known.points);
  const std::uint64_t all = known.points + side.points.size();
  const auto point_of = [&](std::uint64_t code) {
    const std::uint32_t p = points.point(code);
    if (p >= points.next() || points.next() > all) in.fail("a point that its side does not have");
    return p;
  };
  const auto require_apart = [&](const PointPair& ends) {
    if (ends[0] == ends[1]) in.fail("a stretch from a point to itself");
  };
  for (std::uint64_t n = count(1); n > 0; --n) {
    PointPair segment{};
    const std::uint64_t from = in.number(all + 2);
    if (from == 0 && side.segments.empty()) in.fail("a segment that goes on from none");
    segment[0] = from == 0 ? side.segments.back()[1] : point_of(from - 1);
    segment[1] = point_of(in.number(all + 1));
    require_apart(segment);
    side.segments.push_back(segment);
  }
  for (std::uint64_t n = count(2); n > 0; --n) {
    ContourSide::Block block;
    const std::uint64_t from = in.number(3 * (all + 2));
    block.edge = static_cast<std::uint32_t>(from % 3);
    block.ends = {block.edge, (block.edge + 1) % 3};
    if (from >= 3) {
      block.ends[0] = point_of(from / 3 - 1);
      block.ends[1] = point_of(in.number(all + 1));
    }
    require_apart(block.ends);
    side.blocks.push_back(block);
  }
  for (std::uint64_t n = count(4); n > 0; --n) {
    PointPair bridge{};
    for (std::uint32_t& p : bridge) p = point_of(in.number(all + 1));
    require_apart(bridge);
    side.bridges.push_back(bridge);
  }
  if (points.next() != all) in.fail("a point that nothing uses");
  if (side.segments.empty() && side.blocks.empty()) in.fail("a side without a segment");
}

ContourSeed read_seed(VarintReader& in, std::uint32_t side, std::uint64_t points) {
  ContourSeed seed;
  seed.side = side;
  const std::uint64_t begin = in.number((most_bits + 1) * points);
  seed.from = static_cast<std::uint32_t>(begin / (most_bits + 1));
  seed.bits = static_cast<std::uint32_t>(begin % (most_bits + 1));
  if (seed.bits == 0) {
    for (std::string& x : seed.fractions) x = read_fraction(in);
    const mpq_class u(seed.fractions[0]), v(seed.fractions[1]);
    if (sgn(u) <= 0 || sgn(v) <= 0 || u + v >= 1) in.fail("a seed that is not inside of its triangle");
    return seed;
  }
  const std::uint64_t whole = std::uint64_t{1} << seed.bits;
  for (std::uint64_t& x : seed.at) x = in.number(whole);
  if (seed.at[0] == 0 || seed.at[1] == 0 || seed.at[0] + seed.at[1] >= whole)
    in.fail("a seed that is not inside of its triangle");
  return seed;
}

// A number that grows from item to item, as what was added; `least` is 1 where no item is there twice.
class Ascending {
 public:
  Ascending(std::uint64_t below, std::uint64_t least) : below_(below), least_(least) {}
  std::uint32_t next(VarintReader& in) {
    const std::uint64_t from = first_ ? 0 : at_ + least_;
    if (from >= below_) in.fail();
    at_ = from + in.number(below_ - from);
    first_ = false;
    return static_cast<std::uint32_t>(at_);
  }
  void write(std::uint64_t x, VarintWriter& out) {
    out.number(first_ ? x : x - at_ - least_);
    at_ = x;
    first_ = false;
  }

 private:
  std::uint64_t below_, least_, at_ = 0;
  bool first_ = true;
};

DrawingSize size_on(const DrawingSizes& sizes, std::uint32_t side) {
  const auto at = sizes.find(side);
  return at == sizes.end() ? DrawingSize{} : at->second;
}

void add_to(DrawingSizes& sizes, const ContourCell& cell) {
  for (const ContourSide& side : cell.sides) {
    sizes[side.side].points += side.points.size();
    sizes[side.side].segments += side.segments.size();
  }
}

// The drawings within which cell number `at` is.
DrawingSizes sizes_around(const std::vector<ContourCell>& cells, std::uint32_t within) {
  return within == 0 ? DrawingSizes{} : drawing_sizes(cells, within - 1);
}

void write_contours(const ContourCell& cell, const DrawingSizes& around, VarintWriter& out) {
  write_planes(cell, out);
  out.number(cell.sides.size());
  Ascending sides(all_numbers, 1);
  for (const ContourSide& side : cell.sides) {
    sides.write(side.side, out);
    write_side(side, size_on(around, side.side).points, out);
  }
  out.number(cell.seeds.size());
  Ascending seeds(all_numbers, 0);
  for (const ContourSeed& seed : cell.seeds) {
    seeds.write(seed.side, out);
    write_seed(seed, out);
  }
}

void read_cell(VarintReader& in, ContourFile& file) {
  const bool is_solid = file.mode == "solid";
  ContourCell cell;
  cell.name = in.text();
  cell.within = read_number(in, file.cells.size() + 1);
  cell.exact = in.number(2) == 1;
  cell.fallbacks = in.number(std::uint64_t{1} << 60);
  for (std::uint64_t n = in.count(); n > 0; --n) {
    for (double& x : cell.points.emplace_back()) x = in.real();
  }
  if (cell.points.empty()) in.fail("a cell without points");
  read_ascending(in, file.scene_triangles, cell.besides);
  cell.planes = read_planes(in, file.scene_points, cell.points.size());
  const DrawingSizes around = sizes_around(file.cells, cell.within);
  Ascending sides(2 * file.scene_triangles, 1);
  const auto side_of = [&](Ascending& numbers) {
    const std::uint32_t side = numbers.next(in);
    if (is_solid && side % 2 == 1) in.fail("the back of a triangle, in solid mode");
    return side;
  };
  for (std::uint64_t n = in.count(); n > 0; --n) {
    ContourSide& side = cell.sides.emplace_back();
    side.side = side_of(sides);
    read_side(in, size_on(around, side.side), cell.planes.size(), side);
  }
  DrawingSizes drawn = around;
  add_to(drawn, cell);
  Ascending seeds(2 * file.scene_triangles, 0);
  for (std::uint64_t n = in.count(); n > 0; --n) {
    const std::uint32_t side = side_of(seeds);
    cell.seeds.push_back(read_seed(in, side, size_on(drawn, side).points));
  }
  file.cells.push_back(std::move(cell));
}

std::string unsealed_bytes(const ContourFile& file) {
  VarintWriter out = begun(contours_kind);
  out.bytes += bytes_of_hash(file.scene_sha256);
  out.number(file.scene_points);
  out.number(file.scene_triangles);
  out.number(file.mode == "solid" ? 1 : 0);
  out.real(file.reach);
  out.number(file.cells.size());
  for (const ContourCell& cell : file.cells) {
    out.text(cell.name);
    out.number(cell.within);
    out.number(cell.exact ? 1 : 0);
    out.number(cell.fallbacks);
    out.number(cell.points.size());
    for (const Point& p : cell.points) {
      for (const double x : p) out.real(x);
    }
    write_ascending(cell.besides, out);
    write_contours(cell, sizes_around(file.cells, cell.within), out);
  }
  return out.bytes;
}

}  // namespace

std::uint32_t lies_on(const ContourPoint& point) {
  switch (point.kind) {
    case ContourPoint::Kind::on_edge:
    case ContourPoint::Kind::again:
      return 1 + point.first;
    case ContourPoint::Kind::on_segment:
      return 4 + point.first;
    case ContourPoint::Kind::in_full:
      return point.first;
    case ContourPoint::Kind::crossing:
      break;
  }
  return 0;
}

std::optional<std::uint32_t> edge_that_gets(const ContourPoint& point) {
  const std::uint32_t on = lies_on(point);
  if (on == 0 || on > 3 || point.kind == ContourPoint::Kind::again) return std::nullopt;
  return on - 1;
}

DrawingSizes drawing_sizes(const std::vector<ContourCell>& cells, std::uint32_t cell) {
  DrawingSizes sizes;
  for (const std::uint32_t c : chain_of(cells, cell)) add_to(sizes, cells[c]);
  return sizes;
}

std::vector<std::uint32_t> chain_of(const std::vector<ContourCell>& cells, std::uint32_t cell) {
  std::vector<std::uint32_t> chain{cell};
  while (cells[chain.back()].within != 0) chain.push_back(cells[chain.back()].within - 1);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

std::string contour_bytes(const std::vector<ContourCell>& cells, std::uint32_t cell) {
  VarintWriter out;
  write_contours(cells[cell], sizes_around(cells, cells[cell].within), out);
  return out.bytes;
}

std::string to_bytes(const ContourFile& file) { return sealed_bytes(unsealed_bytes(file)); }

ContourFile parse_unsealed_contours(std::string_view bytes, const std::string& where) {
  VarintReader in = begin_reading(contours_kind, bytes, where);
  ContourFile file;
  file.scene_sha256 = digits_of_hash(in.bytes(hash_bytes));
  file.scene_points = in.number(all_numbers);
  file.scene_triangles = in.number(all_numbers / 2);
  file.mode = in.number(2) == 1 ? "solid" : "sheet";
  file.reach = in.real();
  if (file.reach < 0) in.fail("a reach below 0");
  const std::uint64_t cells = in.count();
  if (cells == 0) in.fail("without a cell");
  while (file.cells.size() < cells) read_cell(in, file);
  if (!in.done()) in.fail("something stands behind the last cell");
  if (unsealed_bytes(file) != bytes) in.fail("is not written in the one form that such a file has");
  return file;
}

ContourFile parse_contours(std::string_view bytes, const std::string& where) {
  return parse_unsealed_contours(opened_bytes(contours_kind, bytes, where), where);
}

ContourFile read_contours(const std::filesystem::path& path) {
  return parse_contours(read_file_bytes(path), path.string());
}

}  // namespace clues::scene
