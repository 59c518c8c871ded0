#include "fuzz/multires/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "fuzz/generators/parts.h"
#include "fuzz/generators/random.h"

namespace clues::fuzz {
namespace {

using scene::Point;
using scene::Triangle;
using scene::TriangleMesh;

using Cell = std::array<int, 3>;

// Vertices by whole coordinates, so that pieces that are made apart share them.
class Welder {
 public:
  std::uint32_t at(const Cell& place) {
    const auto [found, fresh] = numbers_.try_emplace(place, static_cast<std::uint32_t>(mesh.points.size()));
    if (fresh) mesh.points.push_back({double(place[0]), double(place[1]), double(place[2])});
    return found->second;
  }
  void triangle(const Cell& a, const Cell& b, const Cell& c) {
    mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back({at(a), at(b), at(c)});
  }
  // A square from `corner` along u and v, cut into n * n.
  void square(const Cell& corner, const Cell& u, const Cell& v, int n) {
    const auto place = [&](int i, int j) {
      Cell out{};
      for (std::size_t k = 0; k < 3; ++k) out[k] = corner[k] * n + u[k] * i + v[k] * j;
      return out;
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        triangle(place(i, j), place(i + 1, j), place(i + 1, j + 1));
        triangle(place(i, j), place(i + 1, j + 1), place(i, j + 1));
      }
    }
  }
  TriangleMesh mesh;

 private:
  std::map<Cell, std::uint32_t> numbers_;
};

// Who lies around each vertex; what changes of it is found anew by looking through all triangles of short lists.
struct Stars {
  explicit Stars(const TriangleMesh& mesh) : of(mesh.points.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) of[v].insert(t);
    }
  }
  std::vector<std::set<std::uint32_t>> of;
};

std::set<std::uint32_t> neighbours(const TriangleMesh& mesh, const Stars& stars, std::uint32_t v) {
  std::set<std::uint32_t> out;
  for (const std::uint32_t t : stars.of[v]) out.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
  out.erase(v);
  return out;
}

bool is_inner(const TriangleMesh& mesh, const Stars& stars, std::uint32_t v) {
  return !stars.of[v].empty() && neighbours(mesh, stars, v).size() == stars.of[v].size();
}

void flip_edges(TriangleMesh& mesh, Random& random, int times) {
  Stars stars(mesh);
  for (int k = 0; k < times; ++k) {
    const auto s = static_cast<std::uint32_t>(random.next() % mesh.triangles.size());
    const auto turn = static_cast<std::size_t>(random.between(0, 2));
    const std::uint32_t a = mesh.triangles[s][turn], b = mesh.triangles[s][(turn + 1) % 3],
                        c = mesh.triangles[s][(turn + 2) % 3];
    for (const std::uint32_t t : stars.of[a]) {
      const auto& other = mesh.triangles[t];
      if (t == s || std::find(other.begin(), other.end(), b) == other.end()) continue;
      const std::uint32_t d = other[0] + other[1] + other[2] - a - b;
      if (stars.of[a].size() < 4 || stars.of[b].size() < 4 || neighbours(mesh, stars, c).count(d) != 0) break;
      stars.of[b].erase(t);
      stars.of[a].erase(s);
      stars.of[c].insert(t);
      stars.of[d].insert(s);
      mesh.triangles[s] = {d, b, c};
      mesh.triangles[t] = {a, d, c};
      break;
    }
  }
}

TriangleMesh renumbered(const TriangleMesh& mesh, Random& random) {
  std::vector<std::uint32_t> order;
  const Stars stars(mesh);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (!stars.of[v].empty()) order.push_back(v);
  }
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  TriangleMesh out;
  std::vector<std::uint32_t> number(mesh.points.size(), 0);
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    number[order[k]] = k;
    out.points.push_back(mesh.points[order[k]]);
  }
  for (const auto& t : mesh.triangles) {
    out.face_of.push_back(static_cast<std::uint32_t>(out.triangles.size()));
    out.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  return out;
}

// Takes away the star of an inner vertex whose neighbours are all inner: one more boundary, genus as before.
bool cut_disc(TriangleMesh& mesh, Random& random) {
  const Stars stars(mesh);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto v = static_cast<std::uint32_t>(random.next() % mesh.points.size());
    if (!is_inner(mesh, stars, v)) continue;
    const auto around = neighbours(mesh, stars, v);
    const bool free = std::all_of(around.begin(), around.end(), [&](std::uint32_t w) {
      // With three triangles, one would be left at w when two go.
      return is_inner(mesh, stars, w);
    });
    if (!free) continue;
    TriangleMesh left = mesh;
    left.triangles.clear();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (stars.of[v].count(t) == 0) left.triangles.push_back(mesh.triangles[t]);
    }
    const Stars after(left);
    if (std::any_of(around.begin(), around.end(), [&](std::uint32_t w) { return after.of[w].empty(); })) continue;
    mesh = left;
    return true;
  }
  return false;
}

double shift(Random& random, double size) { return size * (static_cast<double>(random.next() >> 32) * 0x1p-31 - 1); }

void spoil(TriangleMesh& mesh, Random& random, int how) {
  switch (how) {
    case 1:
      for (auto& p : mesh.points) {
        for (double& x : p) x += shift(random, 0.3);
      }
      return;
    case 2:
      for (auto& p : mesh.points) {
        for (double& x : p) x = random.one_in(3) ? shift(random, 5) : x;
      }
      return;
    case 3:
      for (auto& p : mesh.points) {
        p[1] = std::ldexp(p[1], -20);
        p[2] = random.one_in(2) ? 0 : std::ldexp(p[2], -45);
      }
      return;
    case 4:
      for (auto& p : mesh.points) {
        if (random.one_in(2)) p = {1, 1, 1};
      }
      return;
    default:
      return;
  }
}

}  // namespace

TriangleMesh ball(int n) {
  Welder out;
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<int, 3> sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const bool turned = (sign[0] * sign[1] * sign[2]) < 0;
    const auto place = [&](int i, int j) { return Cell{sign[0] * i, sign[1] * j, sign[2] * (n - i - j)}; };
    const auto add = [&](const Cell& a, const Cell& b, const Cell& c) {
      turned ? out.triangle(a, c, b) : out.triangle(a, b, c);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(place(i, j), place(i + 1, j), place(i, j + 1));
        if (i + j + 1 < n) add(place(i + 1, j), place(i + 1, j + 1), place(i, j + 1));
      }
    }
  }
  for (auto& p : out.mesh.points) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (double& x : p) x /= length;
  }
  return out.mesh;
}

TriangleMesh frame(int holes, int n) {
  const int width = 2 * holes + 1;
  const auto solid = [&](int x, int y, int z) {
    return x >= 0 && x < width && y >= 0 && y < 3 && z == 0 && !(y == 1 && x % 2 == 1);
  };
  Welder out;
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (!solid(x, y, 0)) continue;
      if (!solid(x - 1, y, 0)) out.square({x, y, 0}, {0, 0, 1}, {0, 1, 0}, n);
      if (!solid(x + 1, y, 0)) out.square({x + 1, y, 0}, {0, 1, 0}, {0, 0, 1}, n);
      if (!solid(x, y - 1, 0)) out.square({x, y, 0}, {1, 0, 0}, {0, 0, 1}, n);
      if (!solid(x, y + 1, 0)) out.square({x, y + 1, 0}, {0, 0, 1}, {1, 0, 0}, n);
      out.square({x, y, 0}, {0, 1, 0}, {1, 0, 0}, n);
      out.square({x, y, 1}, {1, 0, 0}, {0, 1, 0}, n);
    }
  }
  return out.mesh;
}

TriangleMesh sheet(int n) {
  Welder out;
  out.square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n);
  return out.mesh;
}

TriangleMesh fan(int n, bool closed) {
  TriangleMesh mesh;
  mesh.points.push_back({0, 0, 0});
  const int rim = closed ? n : n + 1;
  for (int k = 0; k < rim; ++k) {
    const double angle = 2 * 3.14159265358979 * k / (closed ? n : 2 * n);
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (int k = 0; k < n; ++k) {
    mesh.face_of.push_back(static_cast<std::uint32_t>(k));
    mesh.triangles.push_back({0, static_cast<std::uint32_t>(1 + k), static_cast<std::uint32_t>(1 + (k + 1) % rim)});
  }
  return mesh;
}

TriangleMesh moebius(int n) {
  TriangleMesh mesh;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * 3.14159265358979 * k / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(angle / 2);
      mesh.points.push_back({r * std::cos(angle), r * std::sin(angle), side * std::sin(angle / 2)});
    }
  }
  for (int k = 0; k < n; ++k) {
    const auto a = static_cast<std::uint32_t>(2 * k), b = a + 1;
    const bool last = k + 1 == n;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
    mesh.face_of.push_back(2 * static_cast<std::uint32_t>(k));
    mesh.face_of.push_back(2 * static_cast<std::uint32_t>(k) + 1);
  }
  return mesh;
}

SurfaceCase surface_case(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 0x6d617073);
  SurfaceCase out;
  switch (random.between(0, 3)) {
    case 0:
      out.mesh = ball(random.between(1, 6));
      break;
    case 1:
      out.mesh = sheet(random.between(1, 9));
      out.boundaries = 1;
      break;
    default:
      out.genus = random.between(0, 3);
      out.mesh = frame(out.genus, random.between(1, 2));
      break;
  }
  if (!random.one_in(4))
    flip_edges(out.mesh, random, random.between(0, 3 * static_cast<int>(out.mesh.triangles.size())));
  for (int k = random.between(-2, 3); k > 0; --k) out.boundaries += cut_disc(out.mesh, random) ? 1 : 0;
  out.mesh = renumbered(out.mesh, random);
  spoil(out.mesh, random, static_cast<int>(index % 5));
  return out;
}

}  // namespace clues::fuzz
