// The distance to a triangle is that to its plane where the foot of the perpendicular lies in it, else the least of those to its edges; each is a
// fraction when squared. Before fractions are computed, the distance to one point of the triangle is bounded in doubles: with u = 2^-53, a coordinate
// of either point is a sum of three products of numbers that are off by u at most, so that it is off by less than 5 u times the sum of the
// magnitudes; the rest of the computation is covered by taking 8 u of them, and 2^-49 of the result.
#include "validate/multires/triangle_distance.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace clues::validate {
namespace {

using scene::Point;
using Exact = std::array<mpq_class, 3>;

constexpr double u = 0x1p-53;

mpq_class weight_of(const WeightedPoint& point, std::size_t k) {
  mpq_class weight(mpz_class(point.at.weight[k]), mpz_class(scene::whole_weight));
  weight.canonicalize();
  return weight;
}

Exact exact(const WeightedPoint& point) {
  Exact out;
  for (std::size_t k = 0; k < point.at.size(); ++k) {
    const Point& corner = point.mesh.points[point.at.corner[k]];
    for (std::size_t i = 0; i < 3; ++i) out[i] += weight_of(point, k) * mpq_class(corner[i]);
  }
  for (auto& x : out) x.canonicalize();
  return out;
}
Exact exact(const Point& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }
Exact minus(const Exact& a, const Exact& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
mpq_class dot(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

mpq_class square_to_segment(const Exact& p, const Exact& a, const Exact& b) {
  const Exact along = minus(b, a), to = minus(p, a);
  const mpq_class length = dot(along, along), part = dot(to, along);
  if (part <= 0 || length == 0) return dot(to, to);
  if (part >= length) {
    const Exact end = minus(p, b);
    return dot(end, end);
  }
  return dot(to, to) - part * part / length;
}

mpq_class square_to_triangle(const Exact& p, const std::array<Exact, 3>& t) {
  const Exact v = minus(t[1], t[0]), w = minus(t[2], t[0]), to = minus(p, t[0]);
  const Exact normal{v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
  const mpq_class length = dot(normal, normal);
  if (length != 0) {
    const mpq_class vv = dot(v, v), vw = dot(v, w), ww = dot(w, w), tv = dot(to, v), tw = dot(to, w);
    const mpq_class b = ww * tv - vw * tw, c = vv * tw - vw * tv;
    if (b >= 0 && c >= 0 && b + c <= length) {
      const mpq_class height = dot(to, normal);
      return height * height / length;
    }
  }
  return std::min(
      {square_to_segment(p, t[0], t[1]), square_to_segment(p, t[1], t[2]), square_to_segment(p, t[2], t[0])});
}

// In doubles: a point, and by how much each coordinate may be off.
struct Rounded {
  Point at{}, off{};
};
Rounded rounded(const WeightedPoint& point) {
  Rounded out;
  for (std::size_t k = 0; k < point.at.size(); ++k) {
    const double weight = std::ldexp(static_cast<double>(point.at.weight[k]), -scene::weight_bits);
    for (std::size_t i = 0; i < 3; ++i) {
      const double part = weight * point.mesh.points[point.at.corner[k]][i];
      out.at[i] += part;
      out.off[i] += std::abs(part);
    }
  }
  for (double& x : out.off) x *= 8 * u;
  return out;
}

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double product(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Weights of the point of the triangle that is nearest, but for rounding: any would do.
std::array<double, 3> nearest(const Point& p, const std::array<Point, 3>& t) {
  const Point v = difference(t[1], t[0]), w = difference(t[2], t[0]), to = difference(p, t[0]);
  const double vv = product(v, v), vw = product(v, w), ww = product(w, w), tv = product(to, v), tw = product(to, w);
  const double whole = vv * ww - vw * vw, b = (ww * tv - vw * tw) / whole, c = (vv * tw - vw * tv) / whole;
  if (b >= 0 && c >= 0 && b + c <= 1) return {1 - b - c, b, c};
  std::array<double, 3> best{1, 0, 0};
  double least = product(to, to);
  for (std::size_t k = 0; k < 3; ++k) {
    const Point along = difference(t[(k + 1) % 3], t[k]), from = difference(p, t[k]);
    const double length = product(along, along);
    const double part = length > 0 ? std::clamp(product(from, along) / length, 0.0, 1.0) : 0;
    Point gap{};
    for (std::size_t i = 0; i < 3; ++i) gap[i] = from[i] - part * along[i];
    if (product(gap, gap) > least) continue;
    least = product(gap, gap);
    best = {0, 0, 0};
    best[k] = 1 - part;
    best[(k + 1) % 3] = part;
  }
  return best;
}

// True: the point is within the bound. Where it is false nothing is known.
bool surely_within(const Rounded& p, const std::array<Point, 3>& t, double bound) {
  // Outside of this range products overflow or lose bits, and nothing that follows would be a bound.
  constexpr double large = 0x1p400, small = 0x1p-400;
  if (!(bound > small && bound < large)) return false;
  const auto weights = nearest(p.at, t);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double q = 0, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      q += weights[k] * t[k][i];
      size += std::abs(weights[k] * t[k][i]) + 3 * std::abs(t[k][i]);
    }
    if (!(size < large && std::abs(p.at[i]) < large)) return false;
    // The weights sum to 1 but for 2 u: 3 u of every corner covers the point that has exactly the last two of them.
    const double gap = std::abs(p.at[i] - q) + p.off[i] + 8 * u * size;
    square += gap * gap;
  }
  return square * (1 + 0x1p-49) < bound * bound;
}

}  // namespace

bool is_within(const WeightedPoint& point, const std::array<Point, 3>& triangle, double bound) {
  if (surely_within(rounded(point), triangle, bound)) return true;
  const mpq_class exact_bound(bound);
  return square_to_triangle(exact(point), {exact(triangle[0]), exact(triangle[1]), exact(triangle[2])}) <=
         exact_bound * exact_bound;
}

bool is_rounded_from(const WeightedPoint& point, const Point& at, bool single) {
  const Exact where = exact(point);
  for (std::size_t i = 0; i < 3; ++i) {
    mpq_class size = 0;
    for (std::size_t k = 0; k < point.at.size(); ++k)
      size += weight_of(point, k) * abs(mpq_class(point.mesh.points[point.at.corner[k]][i]));
    // Below the normal numbers a product is off by half of the least one, whatever its size.
    mpq_class off = size * mpq_class(5 * u) + mpq_class(0x1p-1073);
    if (single) off += (abs(where[i]) + off) * mpq_class(0x1p-24) + mpq_class(0x1p-149);
    if (abs(mpq_class(at[i]) - where[i]) > off) return false;
  }
  return true;
}

std::array<Point, 3> corners_of(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

}  // namespace clues::validate
