// First any triangulation: chains of the polygon, each closed by a triangle that turns counter-clockwise. That all turn so suffices: a
// polygon of K corners cut into K - 2 positive triangles along diagonals is covered by each of its points' multiplicity, which is 1 for a
// simple one. Then flips to local Delaunay. A flip lowers the surface over the paraboloid (with corners of lower number pushed
// down by amounts that are infinitely small, and infinitely smaller each than the one before), so that they end; without forbidden
// diagonals in the one constrained Delaunay triangulation.
#include "reference/multires/stars/hole.h"

#include <algorithm>
#include <array>

namespace clues::reference {
namespace {

using Corners = std::array<std::size_t, 3>;
using Forbidden = std::function<bool(std::uint32_t, std::uint32_t)>;

class Chains {
 public:
  Chains(const HolePolygon& polygon, const Forbidden& forbidden) : n_(polygon.points.size()) {
    const std::size_t none = n_;
    middle_.assign(n_ * n_, none);
    for (std::size_t width = 2; width < n_; ++width) {
      for (std::size_t i = 0; i + width < n_; ++i) {
        const std::size_t j = i + width;
        if (width + 1 < n_ && forbidden(polygon.vertices[i], polygon.vertices[j])) continue;
        for (std::size_t k = i + 1; k < j && middle_[i * n_ + j] == none; ++k) {
          if (closes(i, k) && closes(k, j) &&
              exact::orientation(polygon.points[i], polygon.points[k], polygon.points[j]) > 0) {
            middle_[i * n_ + j] = k;
          }
        }
      }
    }
  }
  bool found() const { return closes(0, n_ - 1); }
  void collect(std::size_t i, std::size_t j, std::vector<Corners>& out) const {
    if (j == i + 1) return;
    const std::size_t k = middle_[i * n_ + j];
    out.push_back({i, k, j});
    collect(i, k, out);
    collect(k, j, out);
  }

 private:
  bool closes(std::size_t i, std::size_t j) const { return j == i + 1 || middle_[i * n_ + j] != n_; }
  std::size_t n_;
  std::vector<std::size_t>
      middle_;  // of the chain from i to j: the third corner over its end; n_: the chain cannot be closed
};

// The corner of t that follows on the edge from a to b; n: it has no such edge.
std::size_t beyond(const Corners& t, std::size_t a, std::size_t b, std::size_t n) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (t[k] == a && t[(k + 1) % 3] == b) return t[(k + 2) % 3];
  }
  return n;
}

// Makes one flip; false when there is none to make.
bool flip_one(const HolePolygon& polygon, const Forbidden& forbidden, std::vector<Corners>& triangles) {
  const auto& p = polygon.points;
  const std::size_t n = p.size();
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = triangles[s][k], b = triangles[s][(k + 1) % 3], c = triangles[s][(k + 2) % 3];
      for (std::size_t t = s + 1; t < triangles.size(); ++t) {
        const std::size_t d = beyond(triangles[t], b, a, n);
        if (d == n) continue;
        int wanted = exact::in_circle(p[a], p[b], p[c], p[d]);
        if (wanted == 0) {
          const auto number = [&](std::size_t i) { return polygon.vertices[i]; };
          wanted = std::min(number(c), number(d)) < std::min(number(a), number(b)) ? 1 : -1;
        }
        if (wanted < 0 || forbidden(polygon.vertices[c], polygon.vertices[d]) ||
            exact::orientation(p[d], p[b], p[c]) <= 0 || exact::orientation(p[d], p[c], p[a]) <= 0) {
          continue;
        }
        triangles[s] = {d, b, c};
        triangles[t] = {d, c, a};
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::optional<std::vector<scene::Triangle>> triangulated(const HolePolygon& polygon, const Forbidden& forbidden) {
  const Chains chains(polygon, forbidden);
  if (!chains.found()) return std::nullopt;
  std::vector<Corners> triangles;
  chains.collect(0, polygon.points.size() - 1, triangles);
  while (flip_one(polygon, forbidden, triangles)) {
  }
  std::vector<scene::Triangle> out;
  for (const Corners& t : triangles) {
    scene::Triangle numbers{polygon.vertices[t[0]], polygon.vertices[t[1]], polygon.vertices[t[2]]};
    std::rotate(numbers.begin(), std::min_element(numbers.begin(), numbers.end()), numbers.end());
    out.push_back(numbers);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace clues::reference
