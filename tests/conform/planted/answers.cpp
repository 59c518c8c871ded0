#include "answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/first_order.h"
#include "scene/messages/error.h"
#include "tests/point_within.h"

namespace clues::planted {
namespace {

using scene::Point;
using validate::CaseMode;
using validate::Request;

Ids reference_answer(const Request& request) {
  reference::Options options;
  options.mode = request.mode == CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet;
  options.threads = 1;
  return reference::first_order_visibility(request.mesh, exact::ConvexCell::from_doubles(request.cell), options)
      .visible;
}

Ids everything(const Request& request) {
  Ids all;
  for (std::uint32_t t = 0; t < request.mesh.triangles.size(); ++t) all.push_back(t);
  return all;
}

Ids all_but_one(const Request& request) {
  auto ids = reference_answer(request);
  if (!ids.empty()) ids.pop_back();
  return ids;
}

// Exact sight lines, but all from one point: the mean of the cell's corners.
Ids seen_from_centre(const Request& request) {
  const auto cell = exact::ConvexCell::from_doubles(request.cell);
  const auto complex = exact::build_complex(request.mesh);
  const exact::SceneQuery query(complex, cell);
  Ids seen;
  for (std::uint32_t t = 0; t < request.mesh.triangles.size(); ++t) {
    std::array<exact::Point3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = exact::to_exact(request.mesh.points[request.mesh.triangles[t][i]]);
    const auto middle = CGAL::centroid(corners[0], corners[1], corners[2]);
    bool is_seen = middle == cell.center() || query.is_free(cell.center(), middle);
    for (const auto& corner : corners)
      is_seen = is_seen || query.is_free(cell.center(), middle + (corner - middle) * exact::FT(0.9));
    if (is_seen) seen.push_back(t);
  }
  return seen;
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Moeller and Trumbore in doubles: the parameter of the hit, or infinity.
double hit(const Request& request, std::uint32_t t, const Point& from, const Point& direction) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto& [a, b, c] = request.mesh.triangles[t];
  const auto& p = request.mesh.points;
  const auto e1 = minus(p[b], p[a]), e2 = minus(p[c], p[a]), h = cross(direction, e2);
  const double det = dot(e1, h);
  if (det == 0) return never;
  const auto s = minus(from, p[a]), q = cross(s, e1);
  const double u = dot(s, h) / det, v = dot(direction, q) / det, along = dot(e2, q) / det;
  return u < 0 || v < 0 || u + v > 1 || along <= 0 ? never : along;
}

// What 1,000 rays in random directions from random points of the cell hit first.
Ids hit_by_random_rays(const Request& request) {
  std::mt19937_64 random(1);
  std::exponential_distribution<double> weight;
  std::normal_distribution<double> component;
  std::vector<bool> seen(request.mesh.triangles.size(), false);
  for (int ray = 0; ray < 1000; ++ray) {
    const Point from = point_within(request.cell, [&] { return weight(random); });
    const Point direction{component(random), component(random), component(random)};
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < seen.size(); ++t) {
      const double along = hit(request, t, from, direction);
      if (along < least) {
        least = along;
        nearest = t;
      }
    }
    if (std::isfinite(least)) seen[nearest] = true;
  }
  Ids ids;
  for (std::uint32_t t = 0; t < seen.size(); ++t) {
    if (seen[t]) ids.push_back(t);
  }
  return ids;
}

Ids with_float32_coordinates(Request request) {
  for (auto* points : {&request.mesh.points, &request.cell}) {
    for (auto& point : *points) {
      for (double& x : point) {
        x = static_cast<float>(x);
        if (!std::isfinite(x))
          throw scene::Error(scene::ErrorCode::non_finite, "a coordinate overflows single precision");
      }
    }
  }
  return reference_answer(request);
}

// Every corner is pulled towards the mean by a millionth.
Ids with_shrunk_cell(Request request) {
  Point mean{};
  for (const auto& corner : request.cell) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += corner[i] / static_cast<double>(request.cell.size());
  }
  for (auto& corner : request.cell) {
    for (std::size_t i = 0; i < 3; ++i) corner[i] += (mean[i] - corner[i]) * 1e-6;
  }
  return reference_answer(request);
}

// Triangles of less than a thousandth of the largest area are thought to be noise.
Ids without_small_triangles(const Request& request) {
  std::vector<double> areas;
  for (const auto& [a, b, c] : request.mesh.triangles) {
    const auto& p = request.mesh.points;
    const auto normal = cross(minus(p[b], p[a]), minus(p[c], p[a]));
    areas.push_back(std::sqrt(dot(normal, normal)) / 2);
  }
  const double least = *std::max_element(areas.begin(), areas.end()) / 1000;
  auto ids = reference_answer(request);
  std::erase_if(ids, [&](std::uint32_t t) { return areas[t] < least; });
  return ids;
}

using Method = std::function<Ids(const Request&)>;

const std::map<std::string, Method>& methods() {
  static const std::map<std::string, Method> all = {{"reference", reference_answer},
                                                    {"everything-visible", everything},
                                                    {"everything-hidden", [](const Request&) { return Ids(); }},
                                                    {"hides-one", all_but_one},
                                                    {"from-centre", seen_from_centre},
                                                    {"random-rays", hit_by_random_rays},
                                                    {"float32", with_float32_coordinates},
                                                    {"cell-shrunk", with_shrunk_cell},
                                                    {"drops-small", without_small_triangles}};
  return all;
}

}  // namespace

bool is_method(const std::string& mode) { return methods().contains(mode); }

Ids answer(const std::string& mode, const Request& request) {
  const auto found = methods().find(mode);
  if (found == methods().end()) throw std::invalid_argument("no such mode: " + mode);
  return found->second(request);
}

}  // namespace clues::planted
