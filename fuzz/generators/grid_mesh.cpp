// Integer-grid meshes (D1): vertex sharing and ear clipping.
#include "fuzz/generators/grid_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

std::int64_t area(const GridPoint2& a, const GridPoint2& b, const GridPoint2& c) {
  const std::int64_t ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
  return ux * vy - uy * vx;
}

bool in_closed_triangle(const GridPoint2& p, const GridPoint2& a, const GridPoint2& b, const GridPoint2& c) {
  return area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(const std::vector<GridPoint2>& polygon) {
  std::vector<std::size_t> rest(polygon.size());
  std::iota(rest.begin(), rest.end(), std::size_t{0});
  const auto is_ear = [&](std::size_t i) {
    const std::size_t n = rest.size();
    const GridPoint2 &a = polygon[rest[(i + n - 1) % n]], &b = polygon[rest[i]], &c = polygon[rest[(i + 1) % n]];
    return area(a, b, c) > 0 && std::none_of(rest.begin(), rest.end(), [&](std::size_t k) {
             const GridPoint2& p = polygon[k];
             return p != a && p != b && p != c && in_closed_triangle(p, a, b, c);
           });
  };
  // What an ear leaves must not be a flat triangle or a fan of them: keep at least one corner off every straight chain.
  const auto leaves_area = [&](std::size_t i) {
    std::vector<std::size_t> left = rest;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    if (left.size() < 3) {
      return true;
    }
    for (std::size_t k = 2; k < left.size(); ++k) {
      if (area(polygon[left[0]], polygon[left[1]], polygon[left[k]]) != 0) {
        return true;
      }
    }
    return false;
  };
  std::vector<std::array<std::size_t, 3>> triangles;
  while (rest.size() >= 3) {
    const std::size_t n = rest.size();
    std::size_t i = 0;
    while (i < n && !(is_ear(i) && leaves_area(i))) {
      ++i;
    }
    if (i == n) {
      throw scene::Error(scene::ErrorCode::internal, "a generator made a polygon that has no ear");
    }
    triangles.push_back({rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return triangles;
}

std::int64_t volume(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto u = [&](const GridPoint& p, std::size_t i) { return std::int64_t{p[i]} - a[i]; };
  return u(b, 0) * (u(c, 1) * u(d, 2) - u(c, 2) * u(d, 1)) - u(b, 1) * (u(c, 0) * u(d, 2) - u(c, 2) * u(d, 0)) +
         u(b, 2) * (u(c, 0) * u(d, 1) - u(c, 1) * u(d, 0));
}

bool collinear(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return std::int64_t{b[i] - a[i]} * (c[j] - a[j]) - std::int64_t{b[j] - a[j]} * (c[i] - a[i]);
  };
  return minor(0, 1) == 0 && minor(1, 2) == 0 && minor(2, 0) == 0;
}

scene::Point GridMesh::scaled(const GridPoint& p) const {
  const double u = units_;
  return {p[0] / u, p[1] / u, p[2] / u};
}

std::uint32_t GridMesh::vertex(const GridPoint& p) {
  const auto [at, added] = index_.emplace(p, static_cast<std::uint32_t>(mesh_.points.size()));
  if (added) {
    mesh_.points.push_back(scaled(p));
  }
  return at->second;
}

void GridMesh::triangle(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const std::uint32_t i = vertex(a), j = vertex(b), k = vertex(c);
  mesh_.triangles.push_back({i, j, k});
  mesh_.face_of.push_back(faces_++);
}

void GridMesh::polygon(const std::vector<GridPoint>& corners, const std::vector<GridPoint2>& flat) {
  for (const auto& t : triangulate(flat)) {
    triangle(corners[t[0]], corners[t[1]], corners[t[2]]);
  }
}

void GridMesh::quad(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void GridMesh::box(const GridPoint& lo, const GridPoint& hi) {
  const std::vector<GridPoint> c = box_corners(lo, hi);
  quad(c[0], c[2], c[3], c[1]);
  quad(c[4], c[5], c[7], c[6]);
  quad(c[0], c[1], c[5], c[4]);
  quad(c[2], c[6], c[7], c[3]);
  quad(c[0], c[4], c[6], c[2]);
  quad(c[1], c[3], c[7], c[5]);
}

GridPoint GridMesh::lowest() const {
  GridPoint low = index_.begin()->first;
  for (const auto& entry : index_) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], entry.first[i]);
    }
  }
  return low;
}

GridPoint GridMesh::highest() const {
  GridPoint high = index_.begin()->first;
  for (const auto& entry : index_) {
    for (std::size_t i = 0; i < 3; ++i) {
      high[i] = std::max(high[i], entry.first[i]);
    }
  }
  return high;
}

std::vector<GridPoint> box_corners(const GridPoint& lo, const GridPoint& hi) {
  std::vector<GridPoint> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? hi[0] : lo[0], (i & 2) != 0 ? hi[1] : lo[1], (i & 4) != 0 ? hi[2] : lo[2]});
  }
  return corners;
}

}  // namespace clues::fuzz
