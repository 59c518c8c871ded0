#include "fuzz/targets/scene_bytes.h"

#include <cmath>

namespace clues::fuzz {
namespace {

constexpr int most_points = 12, least_points = 3, most_triangles = 4, most_cell_points = 8;

class Bytes {
 public:
  explicit Bytes(std::string_view left) : left_(left) {}
  bool empty() const { return left_.empty(); }
  int next() {
    if (left_.empty()) return 0;
    const int value = static_cast<unsigned char>(left_.front());
    left_.remove_prefix(1);
    return value;
  }
  double coordinate() {
    const int low = next(), high = next();
    return static_cast<std::int16_t>(low | high << 8) / 16.0;
  }
  scene::Point point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

 private:
  std::string_view left_;
};

double moved(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, HUGE_VAL);
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -HUGE_VAL);
  return x;
}

}  // namespace

Case scene_of_bytes(std::string_view text) {
  Bytes bytes(text);
  Case out{"bytes", 0, 0, {}, {}};
  const int points = least_points + bytes.next() % (most_points - least_points + 1);
  const int triangles = 1 + bytes.next() % most_triangles, cell = 1 + bytes.next() % most_cell_points;
  for (int i = 0; i < points; ++i) out.mesh.points.push_back(bytes.point());
  for (int i = 0; i < cell; ++i) out.cell.push_back(bytes.point());
  for (int i = 0; i < triangles; ++i) {
    scene::Triangle t;
    for (auto& corner : t) corner = static_cast<std::uint32_t>(bytes.next() % points);
    out.mesh.triangles.push_back(t);
    out.mesh.face_of.push_back(static_cast<std::uint32_t>(i));
  }
  while (!bytes.empty()) {
    const auto which = static_cast<std::size_t>(bytes.next() % (3 * (points + cell)));
    const auto p = which / 3;
    auto& point = p < out.mesh.points.size() ? out.mesh.points[p] : out.cell[p - out.mesh.points.size()];
    point[which % 3] = moved(point[which % 3], static_cast<std::int8_t>(bytes.next()));
  }
  return out;
}

std::optional<std::string> bytes_of_scene(const Case& scene) {
  const std::size_t points = scene.mesh.points.size(), triangles = scene.mesh.triangles.size(),
                    cell = scene.cell.size();
  if (points < least_points || points > most_points || triangles < 1 || triangles > most_triangles || cell < 1 ||
      cell > most_cell_points)
    return std::nullopt;
  std::string out{static_cast<char>(points - least_points), static_cast<char>(triangles - 1),
                  static_cast<char>(cell - 1)};
  for (const auto* list : {&scene.mesh.points, &scene.cell}) {
    for (const auto& p : *list) {
      for (const double x : p) {
        const double sixteenths = x * 16;
        if (std::nearbyint(sixteenths) != sixteenths || std::abs(sixteenths) > 32767) return std::nullopt;
        const auto bits = static_cast<std::uint16_t>(static_cast<std::int16_t>(sixteenths));
        out += static_cast<char>(bits & 0xff);
        out += static_cast<char>(bits >> 8);
      }
    }
  }
  for (const auto& t : scene.mesh.triangles) {
    for (const auto corner : t) out += static_cast<char>(corner);
  }
  return out;
}

}  // namespace clues::fuzz
