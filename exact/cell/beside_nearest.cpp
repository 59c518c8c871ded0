#include "exact/cell/beside_nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "exact/mix.h"

namespace clues::exact {
namespace {

using scene::Point;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Of the hull of up to three vertices the point nearest to x, if it is inside of that hull.
struct Nearest {
  std::array<std::size_t, 3> vertices{};
  std::array<double, 3> weights{1, 0, 0};
  double squared_distance = std::numeric_limits<double>::infinity();
};

class Search {
 public:
  Search(const std::vector<Point>& vertices, const Point& x) : vertices_(vertices), x_(x) {}

  Nearest run() {
    const std::size_t n = vertices_.size();
    for (std::size_t i = 0; i < n; ++i) {
      take({{i, i, i}, {1, 0, 0}, 0});
      for (std::size_t j = 0; j < i; ++j) {
        on_segment(i, j);
        for (std::size_t k = 0; k < j; ++k) on_triangle(i, j, k);
      }
    }
    return best_;
  }

 private:
  void on_segment(std::size_t i, std::size_t j) {
    const Point u = minus(vertices_[j], vertices_[i]);
    const double t = dot(minus(x_, vertices_[i]), u) / dot(u, u);
    if (t > 0 && t < 1) take({{i, j, i}, {1 - t, t, 0}, 0});
  }

  void on_triangle(std::size_t i, std::size_t j, std::size_t k) {
    const Point u = minus(vertices_[j], vertices_[i]), w = minus(vertices_[k], vertices_[i]),
                way = minus(x_, vertices_[i]);
    const double uu = dot(u, u), uw = dot(u, w), ww = dot(w, w), xu = dot(way, u), xw = dot(way, w);
    const double area = uu * ww - uw * uw, s = (xu * ww - xw * uw) / area, t = (xw * uu - xu * uw) / area;
    if (s > 0 && t > 0 && s + t < 1) take({{i, j, k}, {1 - s - t, s, t}, 0});
  }

  void take(Nearest found) {
    Point p{0, 0, 0};
    for (std::size_t m = 0; m < 3; ++m) {
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += found.weights[m] * vertices_[found.vertices[m]][axis];
    }
    const Point way = minus(x_, p);
    found.squared_distance = dot(way, way);
    if (found.squared_distance < best_.squared_distance) best_ = found;
  }

  const std::vector<Point>& vertices_;
  const Point& x_;
  Nearest best_;
};

// Farther from V than V is large: what is near x then is no nearer to one place of V than to another.
bool is_far(const std::vector<Point>& vertices, const Point& x) {
  double squared_size = 0;
  for (const Point& v : vertices) {
    const Point across = minus(v, vertices[0]);
    squared_size = std::max(squared_size, dot(across, across));
  }
  const Point way = minus(x, vertices[0]);
  return dot(way, way) > 4 * squared_size;
}

// Somewhere in V, seldom about the middle, and from there towards the nearest point as far as is asked for. Empty where doubles do not tell the two apart: nothing hangs on how close
// that is, as it only proposes.
std::vector<double> weights_beside(const Nearest& nearest, const std::vector<Point>& vertices, std::uint64_t number) {
  std::vector<double> weights;
  double total = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    weights.push_back(std::ldexp(1.0, -static_cast<int>(mix(number * 1009 + i) % 8)));
    total += weights.back();
  }
  Point u{0, 0, 0};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    weights[i] /= total;
    for (std::size_t axis = 0; axis < 3; ++axis) u[axis] += weights[i] * vertices[i][axis];
  }
  for (std::size_t m = 0; m < 3; ++m) {
    for (std::size_t axis = 0; axis < 3; ++axis) u[axis] -= nearest.weights[m] * vertices[nearest.vertices[m]][axis];
  }
  const double far = std::ldexp(std::sqrt(nearest.squared_distance), 1 - static_cast<int>(mix(number) % 5));
  const double share = std::min(0.5, far / std::sqrt(dot(u, u)));
  if (dot(u, u) == 0 || !(share > std::numeric_limits<double>::epsilon())) return {};
  for (double& w : weights) w *= share;
  for (std::size_t m = 0; m < 3; ++m) weights[nearest.vertices[m]] += (1 - share) * nearest.weights[m];
  return weights;
}

}  // namespace

std::vector<std::vector<double>> weights_beside_nearest(const std::vector<Point>& vertices, const Point& x,
                                                        std::uint64_t seed, std::size_t count) {
  std::vector<std::vector<double>> found;
  if (is_far(vertices, x)) return found;
  const Nearest nearest = Search(vertices, x).run();
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> weights = weights_beside(nearest, vertices, mix(seed + i));
    if (!weights.empty()) found.push_back(std::move(weights));
  }
  return found;
}

}  // namespace clues::exact
