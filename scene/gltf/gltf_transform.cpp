#include "scene/gltf/gltf_transform.h"

#include <gmpxx.h>

#include <cmath>

namespace clues::scene {
namespace {

Transform from_columns(const GltfObject& node, const std::vector<double>& m) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) node.fail("the last row of its matrix is not 0 0 0 1");
  Transform t;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) t.rows[row][column] = m[4 * column + row];
  }
  return t;
}

Transform from_parts(const GltfObject& node) {
  const auto translation = node.numbers("translation", 3).value_or(std::vector<double>{0, 0, 0});
  const auto rotation = node.numbers("rotation", 4).value_or(std::vector<double>{0, 0, 0, 1});
  const auto scale = node.numbers("scale", 3).value_or(std::vector<double>{1, 1, 1});
  const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
  const double length = x * x + y * y + z * z + w * w;
  if (!(std::abs(length - 1) < 0.01))
    node.fail("its rotation is no unit quaternion");  // floats of an exporter are a little off
  Transform t;
  t.rows = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), translation[0]},
             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), translation[1]},
             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), translation[2]}}};
  for (auto& row : t.rows) {
    for (std::size_t column = 0; column < 3; ++column) row[column] *= scale[column];
  }
  return t;
}

}  // namespace

Point Transform::operator()(const Point& p) const {
  Point q;
  for (std::size_t row = 0; row < 3; ++row) {
    q[row] = rows[row][0] * p[0] + rows[row][1] * p[1] + rows[row][2] * p[2] + rows[row][3];
  }
  return q;
}

// Exactly: in doubles the determinant of a matrix that makes things very small is 0.
bool Transform::mirrors() const {
  std::array<std::array<mpq_class, 3>, 3> m;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      if (!std::isfinite(rows[row][column])) return false;  // no point has a place
      m[row][column] = rows[row][column];
    }
  }
  const auto& [a, b, c] = m;
  const mpq_class determinant =
      a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  return sgn(determinant) < 0;
}

Transform product(const Transform& outer, const Transform& inner) {
  Transform t;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& o = outer.rows[row];
    for (std::size_t column = 0; column < 4; ++column) {
      t.rows[row][column] = o[0] * inner.rows[0][column] + o[1] * inner.rows[1][column] + o[2] * inner.rows[2][column];
    }
    t.rows[row][3] += o[3];
  }
  return t;
}

Transform transform_of(const GltfObject& node) {
  const auto matrix = node.numbers("matrix", 16);
  const bool parts =
      node.find("translation") != nullptr || node.find("rotation") != nullptr || node.find("scale") != nullptr;
  if (matrix && parts) node.fail("has a matrix, and translation, rotation or scale too");
  return matrix ? from_columns(node, *matrix) : from_parts(node);
}

}  // namespace clues::scene
