// n.m < c |n| |m|: a sign, and a comparison of squares.
#include "reference/multires/stars/features.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <map>

#include "scene/messages/error.h"

namespace clues::reference {
namespace {

using Normal = std::array<mpq_class, 3>;

Normal normal_of(const scene::TriangleMesh& mesh, std::uint32_t triangle) {
  std::array<mpq_class, 3> u, v;
  const auto& t = mesh.triangles[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = mpq_class(mesh.points[t[1]][i]) - mpq_class(mesh.points[t[0]][i]);
    v[i] = mpq_class(mesh.points[t[2]][i]) - mpq_class(mesh.points[t[0]][i]);
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

mpq_class inner(const Normal& a, const Normal& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_sharp(const Normal& n, const Normal& m, const mpq_class& cosine) {
  const mpq_class product = inner(n, m), lengths = inner(n, n) * inner(m, m);
  if (lengths == 0) return false;
  const int left = sgn(product), right = sgn(cosine);
  if (left != right) return left < right;
  const mpq_class a = product * product, b = cosine * cosine * lengths;
  return left >= 0 ? a < b : a > b;
}

}  // namespace

std::vector<scene::Edge> sharp_edges(const scene::TriangleMesh& mesh, double cosine) {
  if (!(cosine >= -1 && cosine <= 1)) {
    throw scene::Error(scene::ErrorCode::bad_argument, fmt::format("features: {} is no cosine", cosine));
  }
  std::vector<Normal> normals;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) normals.push_back(normal_of(mesh, t));
  std::map<scene::Edge, std::vector<std::uint32_t>> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) sides[scene::edge_of(c[k], c[(k + 1) % 3])].push_back(t);
  }
  std::vector<scene::Edge> out;
  const mpq_class exact(cosine);
  for (const auto& [edge, triangles] : sides) {
    if (triangles.size() == 2 && is_sharp(normals[triangles[0]], normals[triangles[1]], exact)) out.push_back(edge);
  }
  return out;
}

}  // namespace clues::reference
