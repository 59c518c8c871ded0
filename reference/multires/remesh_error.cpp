#include "reference/multires/remesh_error.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clues::reference {
namespace {

using exact::Wide;
using scene::Point;
using Interval = CGAL::Interval_nt<false>;  // the rounding mode is error_bound()'s
using Box = std::array<Interval, 3>;

// Whole numbers in parts that doubles hold.
Interval enclosed(Wide value) {
  if (value < 0) return -enclosed(-value);
  constexpr std::int64_t part = std::int64_t{1} << 40;
  const auto low = static_cast<double>(static_cast<std::int64_t>(value % part));
  const auto middle = static_cast<double>(static_cast<std::int64_t>(value / part % part));
  const auto high = static_cast<double>(static_cast<std::int64_t>(value / part / part));
  return (Interval(high) * Interval(0x1p40) + Interval(middle)) * Interval(0x1p40) + Interval(low);
}

Box on(const std::array<Point, 3>& triangle, const std::array<Interval, 3>& weights) {
  Box out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = weights[0] * Interval(triangle[0][i]) + weights[1] * Interval(triangle[1][i]) +
             weights[2] * Interval(triangle[2][i]);
  }
  return out;
}

// The largest component becomes 1 to 2: products of four lengths would vanish below 2^-268, and be infinite above 2^255.
void scale_together(const std::array<Point*, 3>& vectors) {
  double largest = 0;
  for (const Point* v : vectors) {
    for (const double x : *v) largest = std::max(largest, std::abs(x));
  }
  if (!(largest > 0) || !std::isfinite(largest)) return;
  const int exponent = std::ilogb(largest);
  for (Point* v : vectors) {
    for (double& x : *v) x = std::ldexp(x, -exponent);
  }
}

// Weights of a point of the triangle that is near to p; any will do, so that rounding is no harm.
std::array<double, 2> near_weights(const Point& p, const std::array<Point, 3>& t) {
  const auto minus = [](const Point& a, const Point& b) { return Point{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto dot = [](const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  Point u = minus(t[1], t[0]), v = minus(t[2], t[0]), w = minus(p, t[0]);
  scale_together({&u, &v, &w});
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double det = uu * vv - uv * uv;
  std::array<double, 2> best{0, 0};
  double least = dot(w, w);
  const auto consider = [&](double b, double c, bool inside) {
    // On the third edge the sum may be 1 but for rounding; square_bound() sees to that.
    if (!(b >= 0 && c >= 0) || (inside && b + c > 1)) return;
    const Point d{w[0] - b * u[0] - c * v[0], w[1] - b * u[1] - c * v[1], w[2] - b * u[2] - c * v[2]};
    const double square = dot(d, d);
    if (square < least) {
      least = square;
      best = {b, c};
    }
  };
  consider((vv * uw - uv * vw) / det, (uu * vw - uv * uw) / det, true);
  consider(std::clamp(uw / uu, 0.0, 1.0), 0, true);
  consider(0, std::clamp(vw / vv, 0.0, 1.0), true);
  const Point e = minus(v, u), f = minus(w, u);
  const double along = std::clamp(dot(e, f) / dot(e, e), 0.0, 1.0);
  consider(1 - along, along, false);
  return best;
}

// Not below the distance of p to the triangle, squared.
double square_bound(const Box& p, const std::array<Point, 3>& triangle) {
  Point middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = (p[i].inf() + p[i].sup()) / 2;
  const auto [b, c] = near_weights(middle, triangle);
  // b + c may be above 1 by the last rounding: then the point named is the one with c cut down, which the interval holds.
  Interval first = Interval(1) - Interval(b) - Interval(c);
  Interval third(c);
  if (first.inf() < 0) {
    third = Interval(std::max(0.0, (third + first).inf()), c);
    first = Interval(0.0, std::max(0.0, first.sup()));
  }
  const Box q = on(triangle, {first, Interval(b), third});
  Interval sum(0);
  for (std::size_t i = 0; i < 3; ++i) sum = sum + CGAL::square(p[i] - q[i]);
  return std::isnan(sum.sup()) ? std::numeric_limits<double>::infinity() : sum.sup();
}

std::array<Point, 3> corners_of(const scene::TriangleMesh& mesh, std::uint32_t t) {
  return {mesh.points[mesh.triangles[t][0]], mesh.points[mesh.triangles[t][1]], mesh.points[mesh.triangles[t][2]]};
}

}  // namespace

PatchError error_bound(const Patch& patch, const std::array<Point, 3>& triangle, const scene::TriangleMesh& input,
                       std::vector<std::uint32_t>* near, double enough) {
  const CGAL::Protect_FPU_rounding<true> protect(CGAL_FE_UPWARD);
  const Interval whole = enclosed(exact::area_in(patch.triangle, patch.corners[0], patch.corners[1], patch.corners[2]));
  std::vector<Box> remeshed;
  for (const StarPoint& point : patch.pieces.points) {
    std::array<Interval, 3> weights;
    for (std::size_t k = 0; k < 3; ++k) {
      weights[k] = enclosed(exact::area_in(patch.triangle, patch.corners[(k + 1) % 3], patch.corners[(k + 2) % 3],
                                           point.at.image)) /
                   whole;
    }
    remeshed.push_back(on(triangle, weights));
  }
  double to_remesh = 0, to_input = 0;
  const auto root = [](double square) { return std::isfinite(square) ? CGAL::sqrt(Interval(square)).sup() : square; };
  const auto roots = [&] { return PatchError{root(to_remesh), root(to_input)}; };
  const double enough_square = std::isfinite(enough) ? CGAL::square(Interval(enough)).sup() : enough;
  std::vector<bool> seen(patch.pieces.points.size(), false);
  // Beyond `limit` it does not matter by how much.
  const auto farthest = [&](const StarPiece& piece, std::uint32_t t, double limit) {
    const auto source = corners_of(input, t);
    double most = 0;
    for (std::size_t k = 0; k < 3 && most < limit; ++k)
      most = std::max(most, square_bound(remeshed[piece.corners[k]], source));
    return most;
  };
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::size_t>> own;  // distances of pieces of the remesh to their own input triangles
  std::vector<std::uint32_t> tried, nearest;
  for (std::size_t i = 0; i < patch.pieces.pieces.size(); ++i) {
    const StarPiece& piece = patch.pieces.pieces[i];
    own.emplace_back(farthest(piece, piece.input, unlimited), i);
    tried.push_back(piece.input);
    const auto source = corners_of(input, piece.input);
    const auto& numbers = input.triangles[piece.input];
    for (const std::uint32_t v : piece.corners) {
      if (seen[v]) continue;
      seen[v] = true;
      const auto& at = patch.pieces.points[v].at.source;
      std::array<Interval, 3> weights;
      for (std::size_t k = 0; k < 3; ++k) weights[k] = enclosed(at.weight_of(numbers[k])) * Interval(0x1p-60);
      to_remesh = std::max(to_remesh, square_bound(on(source, weights), triangle));
    }
  }
  if (to_remesh > enough_square) return roots();
  // Any input triangle will do, so where its own is far, others of the patch are tried: the farthest pieces first, until one cannot be bettered.
  nearest = tried;
  std::sort(tried.begin(), tried.end());
  tried.erase(std::unique(tried.begin(), tried.end()), tried.end());
  std::sort(own.begin(), own.end(),
            [](const auto& p, const auto& q) { return p.first != q.first ? p.first > q.first : p.second < q.second; });
  for (const auto& [square, i] : own) {
    if (square <= to_input || to_input > enough_square) break;
    double best = square;
    for (const std::uint32_t t : tried) {
      const double other = farthest(patch.pieces.pieces[i], t, best);
      if (!(other < best)) continue;
      best = other;
      nearest[i] = t;
      if (best <= to_input) break;  // the largest is another one
    }
    to_input = std::max(to_input, best);
  }
  if (near != nullptr) *near = std::move(nearest);
  return roots();
}

Point position_estimate(const scene::CarrierPoint& source, const scene::TriangleMesh& input) {
  Point out{0, 0, 0}, low = input.points[source.corner[0]], high = low;
  for (std::size_t k = 0; k < source.size(); ++k) {
    const double weight = std::ldexp(static_cast<double>(source.weight[k]), -scene::weight_bits);
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = input.points[source.corner[k]][i];
      out[i] += weight * x;
      low[i] = std::min(low[i], x);
      high[i] = std::max(high[i], x);
    }
  }
  // Rounding takes a point out of its simplex: beside the largest double that would be infinity.
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::clamp(out[i], low[i], high[i]);
  return out;
}

}  // namespace clues::reference
