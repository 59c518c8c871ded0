#include "reference/multires/stars/priority.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clues::reference {
namespace {

using Vector = scene::Point;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector product(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(inner(a, a)); }
bool normalize(Vector& a) {
  const double l = length(a);
  if (!(l > 0)) return false;
  for (double& x : a) x /= l;
  return true;
}

// h = (a u^2 + 2 b u v + c v^2) / 2 by least squares over the neighbours.
double curvature(const Vector& at, const Vector& normal, const std::vector<Vector>& around) {
  Vector u = std::abs(normal[0]) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  u = product(normal, u);
  if (!normalize(u)) return 0;
  const Vector v = product(normal, u);
  std::array<std::array<double, 4>, 3> rows{};
  for (const Vector& p : around) {
    const Vector d = difference(p, at);
    const double x = inner(d, u), y = inner(d, v), h = inner(d, normal);
    const std::array<double, 4> terms{x * x / 2, x * y, y * y / 2, h};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) rows[i][j] += terms[i] * terms[j];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 3; ++i) {
      if (std::abs(rows[i][k]) > std::abs(rows[best][k])) best = i;
    }
    std::swap(rows[k], rows[best]);
    if (!(std::abs(rows[k][k]) > 0)) return 0;  // fewer than three directions: no quadric, no curvature
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == k) continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 4; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  const double a = rows[0][3] / rows[0][0], b = rows[1][3] / rows[1][1], c = rows[2][3] / rows[2][2];
  const double mean = (a + c) / 2, apart = std::sqrt((a - c) * (a - c) / 4 + b * b);
  const double kappa = std::abs(mean + apart) + std::abs(mean - apart);
  return std::isfinite(kappa) ? kappa : 0;
}

}  // namespace

std::vector<scene::Point> points_for_estimates(const scene::TriangleMesh& mesh) {
  std::vector<scene::Point> points = mesh.points;
  double largest = 0;
  for (const auto& p : points) {
    for (const double x : p) largest = std::max(largest, std::abs(x));
  }
  if (!(largest > 0)) return points;
  int exponent = 0;
  (void)std::frexp(largest, &exponent);
  Vector low{2, 2, 2}, high{-2, -2, -2};
  for (auto& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = std::ldexp(p[i], -exponent);  // at most 1
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!(extent > 0)) return points;
  (void)std::frexp(extent, &exponent);
  for (auto& p : points) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = std::ldexp(p[i] - low[i], -exponent);
  }
  return points;
}

std::vector<double> removal_weights_estimate(const StarComplex& complex, const std::vector<scene::Point>& points) {
  std::vector<double> area(points.size(), 0), kappa(points.size(), 0);
  std::vector<Vector> around;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    Vector normal{0, 0, 0};
    around.clear();
    for (const std::uint32_t number : complex.star(v)) {
      const auto& t = complex.triangle(number);
      const Vector n = product(difference(points[t[1]], points[t[0]]), difference(points[t[2]], points[t[0]]));
      area[v] += length(n) / 2;
      for (std::size_t i = 0; i < 3; ++i) normal[i] += n[i];
      for (const std::uint32_t w : t) {
        if (w != v) around.push_back(points[w]);  // inner neighbours twice, which is no harm
      }
    }
    if (normalize(normal)) kappa[v] = curvature(points[v], normal, around);
  }
  const double most_area = *std::max_element(area.begin(), area.end());
  const double most_kappa = *std::max_element(kappa.begin(), kappa.end());
  std::vector<double> weight(points.size(), 0);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (most_area > 0) weight[v] += area[v] / most_area / 2;
    if (most_kappa > 0) weight[v] += kappa[v] / most_kappa / 2;
  }
  return weight;
}

}  // namespace clues::reference
