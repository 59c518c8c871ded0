#include "exact/cell/standard_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <string>

#include "exact/cell/cell_plane.h"
#include "scene/messages/error.h"

namespace clues::exact {
namespace {

constexpr int kStandard = 64;    // binary exponents up to this, and down to its negative, are left alone
constexpr int kLargest = 128;    // of what cannot be moved all the way: products of seven coordinates are doubles
constexpr int kLastBit = -1074;  // of the smallest double

// The exponent of the last bit of x, which is not 0.
int last_bit(double x) {
  int exponent = 0;
  const auto m = static_cast<std::uint64_t>(std::ldexp(std::fabs(std::frexp(x, &exponent)), 53));
  return exponent - 53 + std::countr_zero(m);
}

// Calls look(x, vertex) for all coordinates that triangles use.
template <class Look>
void for_each_coordinate(const scene::TriangleMesh& mesh, const Look& look) {
  for (const scene::Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      for (const double x : mesh.points[corner]) look(x, corner);
    }
  }
}

struct Coordinate {
  double x = 0;
  std::string where;
  std::string text() const { return fmt::format("{} has a coordinate {}", where, x); }
};

int exponent_of(double largest) { return largest > 0 ? std::ilogb(largest) : 0; }
bool is_standard(double largest) { return std::abs(exponent_of(largest)) <= kStandard; }

// `exact_cell`: the cell's points are doubles that are to stay exact. Called for scenes that are not standard.
int exponent_for(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell, bool exact_cell) {
  Coordinate largest, lowest;
  int low = INT_MAX / 2;
  const auto add = [&](double x, const char* what, std::size_t number, bool exact) {
    if (x == 0) return;
    if (std::fabs(x) > std::fabs(largest.x)) largest = {x, fmt::format("{} {}", what, number)};
    if (const int bit = last_bit(x); exact && bit < low) {
      low = bit;
      lowest = {x, fmt::format("{} {}", what, number)};
    }
  };
  for_each_coordinate(mesh, [&](double x, std::uint32_t vertex) { add(x, "vertex", vertex, true); });
  for (std::size_t i = 0; i < cell.size(); ++i) {
    for (const double x : cell[i]) add(x, "point of the cell", i, exact_cell);
  }
  const int top = exponent_of(std::fabs(largest.x));
  // Moving up is always exact; moving down until the lowest bit is the last that a double has.
  const int exponent = top < 0 ? top : std::max(0, std::min(top, low - kLastBit));
  if (top - exponent > kLargest) {
    throw scene::Error(
        scene::ErrorCode::unsupported,
        fmt::format("{}, too small beside {}: no power of two brings both into the range that is computed "
                    "in without rounding; move the scene, or set the small one to 0",
                    lowest.text(), largest.text()));
  }
  return exponent;
}

double largest_of(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) {
  double largest = 0;
  for_each_coordinate(mesh, [&](double x, std::uint32_t) { largest = std::max(largest, std::fabs(x)); });
  for (const scene::Point& p : cell) {
    for (const double x : p) largest = std::max(largest, std::fabs(x));
  }
  return largest;
}

}  // namespace

StandardRange::StandardRange(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) {
  if (!is_standard(largest_of(mesh, cell))) exponent_ = exponent_for(mesh, cell, true);
}

// Rationals can be moved by any power of two: only their size counts.
StandardRange::StandardRange(const scene::TriangleMesh& mesh, const ConvexCell& cell) {
  std::vector<scene::Point> estimates;
  for (const Point3& s : cell.vertices()) estimates.push_back(to_double_estimate(s));
  if (!is_standard(largest_of(mesh, estimates))) exponent_ = exponent_for(mesh, estimates, false);
}

scene::TriangleMesh StandardRange::moved_in(const scene::TriangleMesh& mesh) const {
  scene::TriangleMesh out = mesh;
  out.points = moved_in(mesh.points);
  return out;
}

std::vector<scene::Point> StandardRange::moved_in(const std::vector<scene::Point>& points) const {
  std::vector<scene::Point> out = points;
  for (scene::Point& p : out) {
    for (double& x : p) x = std::clamp(std::ldexp(x, -exponent_), -0x1p1000, 0x1p1000);  // a vertex that is not used
  }
  return out;
}

ConvexCell StandardRange::moved_in(const ConvexCell& cell) const { return scaled(cell, -exponent_); }

Plane3 StandardRange::moved_back(const Plane3& h) const {
  return Plane3(h.a(), h.b(), h.c(), scaled(h.d(), exponent_));
}

scene::Point StandardRange::estimate_moved_back(const scene::Point& p) const {
  return {std::ldexp(p[0], exponent_), std::ldexp(p[1], exponent_), std::ldexp(p[2], exponent_)};
}

double StandardRange::area_moved_in(double area) const { return std::ldexp(area, -2 * exponent_); }
double StandardRange::area_moved_back(double area) const { return std::ldexp(area, 2 * exponent_); }

FT StandardRange::scaled(const FT& x, int exponent) {
  const int half = exponent / 2;  // 2^exponent itself need not be a double
  return x * FT(std::ldexp(1.0, half)) * FT(std::ldexp(1.0, exponent - half));
}

Point3 StandardRange::scaled(const Point3& p, int exponent) {
  if (exponent == 0) return p;
  return collapsed(Point3(scaled(p.x(), exponent), scaled(p.y(), exponent), scaled(p.z(), exponent)));
}

// In an order that keeps the orientation of a polygon.
ConvexCell StandardRange::scaled(const ConvexCell& cell, int exponent) {
  if (exponent == 0) return cell;
  std::vector<Point3> points;
  if (cell.dimension() == 2) {
    for (const Point3& s : corners_of(cell, cell.facets().front())) points.push_back(scaled(s, exponent));
  } else {
    for (const Point3& s : cell.vertices()) points.push_back(scaled(s, exponent));
  }
  return ConvexCell(points);
}

}  // namespace clues::exact
