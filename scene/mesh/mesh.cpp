// D1: which triangles are no surface. Exact: the doubles of a triangle are brought to one power of two and become
// whole numbers, whose cross product is computed in full.
#include "scene/mesh/mesh.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clues::scene {
namespace {

constexpr int mantissa_bits = std::numeric_limits<double>::digits;
using Integers = std::array<mpz_class, 3>;

// The three corners times one power of two, as whole numbers.
std::array<Integers, 3> scaled_to_integers(const std::array<Point, 3>& corners) {
  std::array<std::array<double, 3>, 3> mantissas{};
  std::array<std::array<int, 3>, 3> exponents{};
  int smallest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mantissas[i][axis] = std::ldexp(std::frexp(corners[i][axis], &exponents[i][axis]), mantissa_bits);
      if (corners[i][axis] != 0) smallest = std::min(smallest, exponents[i][axis]);
    }
  }
  std::array<Integers, 3> scaled;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (corners[i][axis] == 0) continue;
      scaled[i][axis] = mantissas[i][axis];
      scaled[i][axis] <<= static_cast<mp_bitcnt_t>(exponents[i][axis] - smallest);
    }
  }
  return scaled;
}

bool is_degenerate(const std::array<Point, 3>& corners) {
  const auto [a, b, c] = scaled_to_integers(corners);
  Integers u, v;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = b[axis] - a[axis];
    v[axis] = c[axis] - a[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto next = (axis + 1) % 3;
    const auto last = (axis + 2) % 3;
    if (u[next] * v[last] != u[last] * v[next]) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> degenerate_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (is_degenerate({mesh.points[a], mesh.points[b], mesh.points[c]})) ids.push_back(static_cast<std::uint32_t>(i));
  }
  return ids;
}

}  // namespace clues::scene
