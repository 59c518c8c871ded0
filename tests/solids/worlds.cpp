#include "tests/solids/worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "exact/sight/scene_query.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/solids/find_solids.h"
#include "fastpath/solids/shafts.h"

namespace clues::tests {

using scene::Point;

std::vector<Face> faces_of_box(const Point& low, const Point& high) {
  std::vector<Face> faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      Face face(4);
      for (std::size_t i = 0; i < 4; ++i) {
        face[i][axis] = upper ? high[axis] : low[axis];
        face[i][(axis + 1) % 3] = i == 1 || i == 2 ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
        face[i][(axis + 2) % 3] = i >= 2 ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
      }
      if (!upper) std::reverse(face.begin(), face.end());
      faces.push_back(face);
    }
  }
  return faces;
}

namespace {

void add_fan(scene::FlaggedMeshBuilder& builder, const Face& face, scene::FlaggedMeshBuilder::Flags flags) {
  for (std::size_t i = 1; i + 1 < face.size(); ++i) builder.add({face[0], face[i], face[i + 1]}, 0, flags);
}

// Of corners with short coordinates: a point of the interior of their hull, exactly.
Point mixed(const std::vector<Point>& corners, std::mt19937_64& random, double sharpness) {
  constexpr double kWhole = 0x1p24;
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += weights.emplace_back(std::pow(unit(random), sharpness) + 1e-4);
  double left = kWhole;
  for (double& weight : weights) left -= weight = std::max(1.0, std::floor(weight / sum * kWhole) - 1);
  weights[0] += left;
  Point out{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) out[k] += weights[i] / kWhole * corners[i][k];
  }
  return out;
}

}  // namespace

World random_world(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const auto point = [&](int most) {
    return Point{static_cast<double>(number(0, most)), static_cast<double>(number(0, most)),
                 static_cast<double>(number(0, most))};
  };
  scene::FlaggedMeshBuilder builder;
  const int solids = number(3, 12), most = number(4, 12);
  for (int i = 0; i < solids; ++i) {
    Point low = point(most), high = low;
    const int thin = number(0, 2);
    for (int axis = 0; axis < 3; ++axis)
      high[static_cast<std::size_t>(axis)] += axis == thin ? 1 : number(1, 2 * most / 3);
    if (number(0, 3) == 0) high[static_cast<std::size_t>(number(0, 2))] -= 0x1p-5;  // a crack
    auto faces = faces_of_box(low, high);
    const int kind = number(0, 7);
    if (kind == 0) faces.erase(faces.begin() + number(0, 5));
    if (kind == 1) {  // a tetrahedron
      faces = {{low, {high[0], low[1], low[2]}, {low[0], high[1], low[2]}},
               {low, {high[0], low[1], low[2]}, {low[0], low[1], high[2]}},
               {low, {low[0], high[1], low[2]}, {low[0], low[1], high[2]}},
               {{high[0], low[1], low[2]}, {low[0], high[1], low[2]}, {low[0], low[1], high[2]}}};
    }
    for (const auto& face : faces) add_fan(builder, face, {true, kind != 2});
  }
  for (int i = number(0, 4); i > 0; --i) {
    const std::array<Point, 3> corners{point(2 * most), point(2 * most), point(2 * most)};
    builder.add(corners, 0, {number(0, 1) == 0, true});
  }
  World world;
  world.scene = builder.take();
  const Point low = point(most + 2);
  Point high = low;
  const int flat = number(0, 5);  // along that axis, if there is one of that number
  for (int axis = 0; axis < 3; ++axis) high[static_cast<std::size_t>(axis)] += axis == flat ? 0 : 0.5 * number(1, 6);
  world.cell = scene::corners_of({low, high});
  return world;
}

Looked look_for_what_is_hidden(std::uint64_t first_seed, std::uint64_t worlds, int lines_for_each) {
  namespace solids = fastpath::solids;
  Looked looked;
  for (std::uint64_t seed = first_seed; seed < first_seed + worlds && looked.seen.empty(); ++seed) {
    const World world = random_world(seed);
    const auto& mesh = world.scene.mesh;
    const solids::Solids found(solids::find_solids(world.scene),
                               solids::bounds_of_questions(world.scene, {world.cell}));
    const auto listed = solids::not_hidden(found, solids::Targets(world.scene, found), world.cell);
    const auto blocking = scene::blocking_ids(world.scene);
    const auto walls = scene::part_of(mesh, blocking);
    const fastpath::Bvh tree(walls);
    const auto cell = exact::ConvexCell::from_doubles(world.cell);
    const fastpath::Cell in_front(cell);
    fastpath::SegmentQueries queries(tree);
    std::mt19937_64 random(seed);
    for (std::uint32_t t = 0; t < mesh.triangles.size() && looked.seen.empty(); ++t) {
      if (!world.scene.counting(t) || std::binary_search(listed.begin(), listed.end(), t)) continue;
      std::vector<Point> corners;
      for (const auto i : mesh.triangles[t]) corners.push_back(mesh.points[i]);
      const auto exactly = [](const Point& p) { return exact::to_exact(p); };
      if (CGAL::collinear(exactly(corners[0]), exactly(corners[1]), exactly(corners[2]))) continue;
      ++looked.hidden;
      if (exact::meets_cell({exactly(corners[0]), exactly(corners[1]), exactly(corners[2])}, cell)) {
        looked.seen = fmt::format("seed {}: triangle {} meets the cell", seed, t);
        break;
      }
      const auto at = std::lower_bound(blocking.begin(), blocking.end(), t);
      std::vector<std::uint32_t> itself;
      if (at != blocking.end() && *at == t) itself.push_back(static_cast<std::uint32_t>(at - blocking.begin()));
      for (int i = 0; i < lines_for_each; ++i) {
        const double sharpness = 1 << (i % 4);
        const Point v = mixed(world.cell, random, sharpness), p = mixed(corners, random, sharpness);
        ++looked.lines;
        if (queries.any_hit({v, p}, {itself, &in_front})) continue;
        looked.seen =
            fmt::format("seed {}: triangle {} from {} {} {} at {} {} {}", seed, t, v[0], v[1], v[2], p[0], p[1], p[2]);
        break;
      }
    }
  }
  return looked;
}

}  // namespace clues::tests
