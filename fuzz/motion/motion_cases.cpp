// Generators of motion bounds.
#include "fuzz/motion/motion_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "fuzz/generators/random.h"

namespace clues::fuzz {
namespace {

using scene::MotionPoint;

// From lo to hi, 2^32 values.
double real(Random& random, double lo, double hi) {
  return lo + (hi - lo) * static_cast<double>(random.next() >> 32) * 0x1p-32;
}

double det(const MotionPoint& a, const MotionPoint& b, const MotionPoint& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Whole vectors on the cone x^2 + y^2 = 25 z^2 / 4 times a depth that is a power of two: any four are seen on one circle.
constexpr std::array<std::array<int, 2>, 12> on_circle{
    {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-3, 4}, {-4, 3}, {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}}};

void place_on_circle(Random& random, std::array<MotionPoint, 4>& p) {
  std::array<int, 4> at{};
  do {
    for (int& i : at) i = random.between(0, 11);
    std::sort(at.begin(), at.end());
  } while (std::adjacent_find(at.begin(), at.end()) != at.end());
  // Counter-clockwise 0 1 3 2: the edge 1-2 is a diagonal.
  constexpr std::size_t order[] = {0, 1, 3, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    const double depth = std::ldexp(1.0, random.between(-3, 3));
    const auto& xy = on_circle[static_cast<std::size_t>(at[i])];
    p[order[i]] = {xy[0] * depth, xy[1] * depth, 2 * depth};
  }
}

void place_in_view(Random& random, MotionKind kind, std::array<MotionPoint, 4>& p) {
  const double size = kind == MotionKind::small ? std::exp2(real(random, -8, -2)) : real(random, 0.05, 0.6);
  const double slope_x = real(random, -0.7, 0.7), slope_y = real(random, -0.7, 0.7);
  // Corners 0 1 3 2 around a square, each somewhere in its quarter.
  constexpr std::array<std::array<int, 2>, 4> quarter{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = quarter[i][0] * size * real(random, 0.05, 1), y = quarter[i][1] * size * real(random, 0.05, 1);
    double depth = real(random, 1, 4);
    if (kind == MotionKind::wall) depth = 2 / (1 - slope_x * x - slope_y * y);
    if (kind == MotionKind::far) depth = 1e6 * real(random, 1, 1 + 1e-6);
    p[i] = {x * depth, y * depth, depth};
    if (kind == MotionKind::far) p[i] = {x, y, depth};
  }
}

}  // namespace

MotionCase motion_case(MotionKind kind, std::uint64_t seed, std::uint64_t index) {
  Random random(seed * 0x9e3779b97f4a7c15ULL + index * motion_kinds + static_cast<std::uint64_t>(kind) + 0x6d6f74);
  MotionCase out;
  std::array<MotionPoint, 4> p{};
  std::array<bool, 4> direction{};
  do {
    if (kind == MotionKind::cocircular || kind == MotionKind::one_ulp) {
      place_on_circle(random, p);
    } else {
      place_in_view(random, kind, p);
    }
    if (kind == MotionKind::one_ulp) {
      auto& at = p[static_cast<std::size_t>(random.between(0, 3))];
      double* x = &at[static_cast<std::size_t>(random.between(0, 2))];
      if (*x == 0) x = &at[2];
      *x = std::nextafter(*x, random.one_in(2) ? 100.0 : -100.0);
    }
    if (kind == MotionKind::thin) {
      const double t = real(random, 0.1, 0.9), off = std::exp2(-random.between(2, 40));
      for (std::size_t i = 0; i < 3; ++i) {
        const double foot = p[1][i] + t * (p[2][i] - p[1][i]);
        p[0][i] = foot + off * (p[0][i] - foot);
      }
    }
    if (kind == MotionKind::sky) {
      for (int n = random.between(1, 3); n > 0; --n) direction[static_cast<std::size_t>(random.between(0, 3))] = true;
    }
    // Any of the 24 ways to name the axes, so that no axis is special; two of the same sign keep the orientation.
  } while (!(det(p[0], p[1], p[2]) > 0));
  const int turn = random.between(0, 2);
  const double flip = random.one_in(2) ? -1 : 1;
  out.viewpoint = {0, 0, 0};
  if (kind != MotionKind::cocircular && kind != MotionKind::one_ulp && random.one_in(2)) {
    for (double& x : out.viewpoint) x = random.between(-64, 64) * 0x1p-6;
  }
  if (kind == MotionKind::near) {
    const double close = std::exp2(-random.between(1, 30));
    for (auto& x : p) {
      for (double& c : x) c *= &x == &p[1] ? close : 1;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    MotionPoint at{flip * p[i][0], flip * p[i][1], p[i][2]};
    std::rotate(at.begin(), at.begin() + turn, at.end());
    for (std::size_t k = 0; k < 3 && !direction[i]; ++k) at[k] += out.viewpoint[k];
    out.mesh.samples.push_back({at, direction[i], direction[i] && random.one_in(2)});
  }
  if (kind == MotionKind::scaled) {
    const int k = random.between(-300, 300);
    for (auto& sample : out.mesh.samples) {
      for (double& x : sample.at) x = std::ldexp(x, k);
    }
    for (double& x : out.viewpoint) x = std::ldexp(x, k);
  }
  out.mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  constexpr std::array<double, 7> kappas{-1, 0, 0.5, 1, 3, 20, 2000};
  out.thresholds.kappa = kappas[static_cast<std::size_t>(random.between(0, 6))];
  out.thresholds.sigma = random.one_in(8) ? 0 : std::exp2(-random.between(4, 50));
  out.thresholds.delaunay = true;
  return out;
}

scene::DepthMesh globe(int n, double relief, std::uint64_t seed, bool sky) {
  Random random(seed ^ 0x676c6f6265ULL);
  scene::DepthMesh mesh;
  std::map<std::tuple<int, int, int>, std::uint32_t> known;
  const auto sample = [&](int x, int y, int z) {
    const auto [at, is_new] = known.try_emplace({x, y, z}, static_cast<std::uint32_t>(mesh.samples.size()));
    if (is_new) {
      const double length = std::sqrt(static_cast<double>(x * x + y * y + z * z));
      const double depth = (1 + relief * real(random, 0, 1)) / length;
      scene::DepthSample made;
      made.is_direction = made.is_base = sky && z > 0;
      made.at = {x * depth, y * depth, z * depth};
      mesh.samples.push_back(made);
    }
    return at->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = (octant & 1) != 0 ? -1 : 1, sy = (octant & 2) != 0 ? -1 : 1, sz = (octant & 4) != 0 ? -1 : 1;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (sx * sy * sz > 0) {
        mesh.triangles.push_back({a, b, c});
      } else {
        mesh.triangles.push_back({a, c, b});
      }
    };
    const auto at = [&](int i, int j) { return sample(sx * i, sy * j, sz * (n - i - j)); };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 2 <= n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return mesh;
}

}  // namespace clues::fuzz
