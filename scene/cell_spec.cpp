// D2: reads what the user wrote for a view cell: a box, a grid of boxes, or a file of points.
#include "scene/cell_spec.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "scene/formats/number.h"
#include "scene/formats/place.h"
#include "scene/formats/readers.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

constexpr std::string_view box_prefix = "box:";
constexpr std::string_view grid_prefix = "grid:";
constexpr std::int64_t most_cells = std::int64_t{1} << 24;

struct Box {
  Point low{}, high{};
};

[[noreturn]] void fail_cell(const std::string& text, ErrorCode code, const std::string& what) {
  throw Error(code, "cell " + excerpt(text) + ": " + what);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// `numbers` is what follows "box:"; `text` is all that the user wrote.
Box parse_box(std::string_view numbers, const std::string& text) {
  const auto parts = split(numbers, ',');
  if (parts.size() != 6) {
    fail_cell(text, ErrorCode::bad_cell,
              fmt::format("a box has 6 numbers, not {}; write: box:x0,y0,z0,x1,y1,z1", parts.size()));
  }
  Box box;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto parsed = parse_number(parts[i]);
    if (parsed.kind == NumberKind::not_a_number) {
      fail_cell(text, ErrorCode::bad_cell, excerpt(parts[i]) + " is not a number; write: box:x0,y0,z0,x1,y1,z1");
    }
    if (parsed.kind == NumberKind::non_finite) {
      fail_cell(text, ErrorCode::non_finite, excerpt(parts[i]) + " is not a finite double; give finite bounds");
    }
    (i < 3 ? box.low : box.high)[i % 3] = parsed.value;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.low[axis] > box.high[axis]) {
      fail_cell(text, ErrorCode::bad_cell,
                fmt::format("the box is inverted on axis {0}: {0}0 = {1} is above {0}1 = {2}; swap them", "xyz"[axis],
                            box.low[axis], box.high[axis]));
    }
  }
  return box;
}

// The distinct corners, x fastest.
std::vector<Point> corners_of(const Box& box) {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i) {
    Point corner = box.low;
    bool is_repeated = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (((i >> axis) & 1) == 0) continue;
      is_repeated = is_repeated || box.low[axis] == box.high[axis];
      corner[axis] = box.high[axis];
    }
    if (!is_repeated) corners.push_back(corner);
  }
  return corners;
}

// The double nearest to low + (high - low) * i / n; the ends are the bounds themselves. Monotone in i.
double bound_between(double low, double high, std::int64_t i, std::int64_t n) {
  if (i == 0) return low;
  if (i == n) return high;
  mpq_class share(static_cast<long>(i), static_cast<unsigned long>(n));
  share.canonicalize();
  const mpq_class exact = mpq_class(low) + (mpq_class(high) - mpq_class(low)) * share;
  const double inner = exact.get_d();  // towards zero
  const double outer = std::nextafter(inner, sgn(exact) * std::numeric_limits<double>::infinity());
  const mpq_class inner_gap = abs(exact - mpq_class(inner));
  if (inner_gap == 0) return inner;
  const mpq_class outer_gap = abs(mpq_class(outer) - exact);
  if (inner_gap != outer_gap) return inner_gap < outer_gap ? inner : outer;
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(inner, &exponent), std::numeric_limits<double>::digits);
  return std::fmod(mantissa, 2) == 0 ? inner : outer;
}

std::vector<double> cut(double low, double high, std::int64_t n, char axis, const std::string& text) {
  std::vector<double> bounds;
  for (std::int64_t i = 0; i <= n; ++i) {
    bounds.push_back(bound_between(low, high, i, n));
    if (i > 0 && n > 1 && bounds[static_cast<std::size_t>(i) - 1] == bounds.back()) {
      fail_cell(text, ErrorCode::bad_cell,
                fmt::format("the box is too flat on axis {} to be cut into {}; use a smaller count", axis, n));
    }
  }
  return bounds;
}

std::array<std::int64_t, 3> parse_counts(std::string_view counts, const std::string& text) {
  const auto parts = split(counts, 'x');
  std::array<std::int64_t, 3> n{};
  std::int64_t product = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto count = parts.size() == 3 ? parse_integer(parts[axis]) : std::nullopt;
    if (!count || *count < 1) {
      fail_cell(text, ErrorCode::bad_cell,
                excerpt(counts) + " is not three counts from 1 up; write: grid:NXxNYxNZ:box:...");
    }
    if (*count > most_cells / product) {
      fail_cell(text, ErrorCode::bad_cell, fmt::format("more than {} cells; use smaller counts", most_cells));
    }
    n[axis] = *count;
    product *= *count;
  }
  return n;
}

std::vector<CellSpec> parse_grid(const std::string& text) {
  const auto rest = std::string_view(text).substr(grid_prefix.size());
  const auto counts = rest.substr(0, rest.find(':'));
  const auto box_text = rest.substr(std::min(counts.size() + 1, rest.size()));
  if (!box_text.starts_with(box_prefix)) {
    fail_cell(text, ErrorCode::bad_cell, "a grid needs a box; write: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1");
  }
  const auto n = parse_counts(counts, text);
  const auto box = parse_box(box_text.substr(box_prefix.size()), text);
  std::array<std::vector<double>, 3> bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds[axis] = cut(box.low[axis], box.high[axis], n[axis], "xyz"[axis], text);
  }
  const auto& [xs, ys, zs] = bounds;
  std::vector<CellSpec> cells;
  for (std::size_t k = 0; k + 1 < zs.size(); ++k) {
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const Box part{{xs[i], ys[j], zs[k]}, {xs[i + 1], ys[j + 1], zs[k + 1]}};
        cells.push_back({fmt::format("{},{},{}", i, j, k), corners_of(part)});
      }
    }
  }
  return cells;
}

}  // namespace

CellSpec parse_cell(const std::string& text) {
  if (text.empty()) throw Error(ErrorCode::bad_cell, "the cell is empty; give box:x0,y0,z0,x1,y1,z1 or a file");
  if (text.starts_with(box_prefix)) return {text, corners_of(parse_box(text.substr(box_prefix.size()), text))};
  if (text.starts_with(grid_prefix)) fail_cell(text, ErrorCode::bad_cell, "one cell is wanted, not a grid; give a box");
  auto mesh = read_mesh_or_points(text);
  if (mesh.points.empty()) {
    throw Error(ErrorCode::bad_cell, text + ": no point; a cell needs at least one vertex");
  }
  return {text, std::move(mesh.points)};
}

std::vector<CellSpec> parse_cells(const std::string& text) {
  if (text.starts_with(grid_prefix)) return parse_grid(text);
  return {parse_cell(text)};
}

}  // namespace clues::scene
