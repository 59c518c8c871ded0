#include "tests/solids/worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"
#include "exact/sight/scene_query.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/solids/exact_sections.h"
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

scene::Polytope box_of(const Point& low, const Point& high) {
  return scene::box_polytope(scene::to_rational(low), scene::to_rational(high));
}

// A brush, or two that abut along a plane askew; none that touches the cell.
void add_brushes(World& world, const scene::Bounds& box, std::mt19937_64& random) {
  if (scene::touch(box, scene::bounds_of(world.cell))) return;
  std::uniform_int_distribution<int> part(-3, 3);
  scene::HalfSpace half_space;
  for (std::size_t i = 0; i < 3; ++i) {
    half_space.normal[i] = part(random);
    half_space.offset += half_space.normal[i] * mpq_class(box.low[i] + (box.high[i] - box.low[i]) / 2);
  }
  half_space.offset += mpq_class(part(random)) / 7;
  const auto whole = box_of(box.low, box.high);
  const bool both = part(random) > 0;
  for (const auto& half : {half_space, half_space.opposite()}) {
    if (auto brush = scene::intersection(whole, half)) world.brushes.push_back(std::move(*brush));
    if (!both) break;
  }
}

// Cuts two corners of a box off the cell, and puts a brush there at times.
void make_wedge(World& world, std::mt19937_64& random) {
  const scene::Bounds box = scene::bounds_of(world.cell);
  constexpr std::size_t u = 1, v = 2;
  std::erase_if(world.cell, [&](const Point& p) { return p[u] == box.high[u] && p[v] == box.high[v]; });
  std::uniform_int_distribution<int> size(0, 3);
  scene::HalfSpace beyond;
  const mpq_class width = box.high[u] - box.low[u], height = box.high[v] - box.low[v];
  beyond.normal = {0, -height, -width};
  beyond.offset = -(height * mpq_class(box.high[u]) + width * mpq_class(box.low[v]));
  Point low = box.low, high = box.high;
  low[0] -= size(random) - 1;
  for (double& x : high) x += size(random);
  if (size(random) == 0 || low[0] >= high[0]) return;
  if (auto brush = scene::intersection(box_of(low, high), beyond)) world.brushes.push_back(std::move(*brush));
}

// Whether the segment meets the brush, in or on its surface, before it ends.
bool stops(const scene::Polytope& brush, const Point& from, const Point& to) {
  const auto v = scene::to_rational(from), p = scene::to_rational(to);
  mpq_class in = 0, out = 1;
  for (const auto& face : brush.faces) {
    const mpq_class at_v = face.half_space.height(v), at_p = face.half_space.height(p);
    if (sgn(at_v) > 0 && sgn(at_p) > 0) return false;
    if (sgn(at_v) <= 0 && sgn(at_p) <= 0) continue;
    const mpq_class share = at_v / (at_v - at_p);
    if (sgn(at_v) > 0) {
      in = std::max(in, share);
    } else {
      out = std::min(out, share);
    }
  }
  return in <= out && in < 1;
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
  if (flat > 2 && number(0, 2) == 0) make_wedge(world, random);
  for (int i = number(0, 3); i > 0; --i) {
    const Point from = point(most);
    Point to = from;
    for (double& x : to) x += number(1, 4);
    add_brushes(world, {from, to}, random);
  }
  return world;
}

namespace {

namespace solids = fastpath::solids;

solids::Solids solids_of_world(const World& world) {
  auto all = solids::find_solids(world.scene);
  for (auto& brush : solids::solids_of(world.brushes)) all.push_back(std::move(brush));
  return {std::move(all), solids::bounds_of_questions(world.scene, {world.cell})};
}

}  // namespace

Looked look_for_what_is_hidden(std::uint64_t first_seed, std::uint64_t worlds, int lines_for_each) {
  Looked looked;
  for (std::uint64_t seed = first_seed; seed < first_seed + worlds && looked.seen.empty(); ++seed) {
    const World world = random_world(seed);
    const auto& mesh = world.scene.mesh;
    const solids::Solids found = solids_of_world(world);
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
        if (queries.any_hit({v, p}, {itself, &in_front}) ||
            std::any_of(world.brushes.begin(), world.brushes.end(), [&](const auto& b) { return stops(b, v, p); }))
          continue;
        looked.seen =
            fmt::format("seed {}: triangle {} from {} {} {} at {} {} {}", seed, t, v[0], v[1], v[2], p[0], p[1], p[2]);
        break;
      }
    }
  }
  return looked;
}

namespace {

struct Cut {
  solids::SectionPlane plane;
  std::size_t dropped = 0;
  solids::Cutting cutting = solids::Cutting::across;
};

// Boxes that are turned about the third axis, some of which share a face with the one before.
std::vector<solids::Solid> turned_boxes(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 12), size(0.5, 3), angle(0, 6.3);
  std::vector<solids::Solid> boxes;
  std::array<solids::Spot, 4> base{};
  for (int i = 0; i < 10; ++i) {
    const double x = place(random), y = place(random), turn = angle(random), length = size(random),
                 width = size(random);
    const solids::Spot along{length * std::cos(turn), length * std::sin(turn)},
        across{-width * std::sin(turn), width * std::cos(turn)};
    const bool abuts = i > 0 && i % 3 == 0;
    const solids::Spot a = abuts ? base[2] : solids::Spot{x, y},
                       b = abuts ? base[1] : solids::Spot{x + along[0], y + along[1]};
    base = {a, b, {b[0] + across[0], b[1] + across[1]}, {a[0] + across[0], a[1] + across[1]}};
    const double low = i % 2 == 0 ? 0 : place(random), high = low + size(random);
    std::vector<Face> faces(2);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto &p = base[k], &q = base[(k + 1) % 4];
      faces[0].push_back({p[0], p[1], low});
      faces[1].push_back({p[0], p[1], high});
      faces.push_back({{p[0], p[1], low}, {q[0], q[1], low}, {q[0], q[1], high}, {p[0], p[1], high}});
    }
    if (auto box = solids::solid_of(faces)) boxes.push_back(std::move(*box));
  }
  return boxes;
}

// Boxes with corners in sevenths, cut along one axis: edges of the cut have one coordinate in common that is no double.
std::vector<solids::Solid> boxes_in_sevenths(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::vector<solids::Solid> boxes;
  for (int i = 0; i < 8; ++i) {
    scene::RationalPoint low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = mpq_class(number(0, 40)) / 7;
      high[axis] = low[axis] + mpq_class(number(1, 14)) / 7;
    }
    scene::HalfSpace beyond;
    const auto along = static_cast<std::size_t>(number(0, 2));
    for (const std::size_t axis : {(along + 1) % 3, (along + 2) % 3}) {
      beyond.normal[axis] = number(0, 1) == 0 ? 1 : -2;
      beyond.offset += beyond.normal[axis] * (low[axis] + (high[axis] - low[axis]) * number(1, 2) / 3);
    }
    if (auto part = scene::intersection(scene::box_polytope(low, high), beyond))
      boxes.push_back(solids::solid_of_polytope(*part));
  }
  return boxes;
}

std::vector<Cut> cuts_of(const solids::Solids& all) {
  std::set<std::pair<std::size_t, double>> flat;
  for (const auto& solid : all.all()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const Point& corner : solid.corners) flat.insert({axis, corner[axis]});
    }
  }
  std::vector<Cut> cuts;
  for (const auto& [axis, at] : flat) {
    for (const double up : {1.0, -1.0}) {
      for (const auto cutting : {solids::Cutting::across, solids::Cutting::just_above}) {
        for (const double lean : {0.0, 0.125}) {
          Cut& cut = cuts.emplace_back();
          cut.plane.normal[axis] = up;
          cut.plane.normal[(axis + 1) % 3] = lean;
          cut.plane.distance = up * at;
          cut.dropped = axis;
          cut.cutting = cutting;
        }
      }
    }
  }
  return cuts;
}

bool are_same(const solids::RimPart& a, const solids::RimPart& b) {
  return a.polygon == b.polygon && a.edge == b.edge && are_equal(a.segment[0], b.segment[0]) &&
         are_equal(a.segment[1], b.segment[1]);
}

bool is_as_near_as_it_says(const solids::ExactSpot& spot) {
  const auto exact = spot.rationals();
  return abs(exact[0] - mpq_class(spot.x)) <= mpq_class(spot.off[0]) &&
         abs(exact[1] - mpq_class(spot.y)) <= mpq_class(spot.off[1]);
}

bool are_in_their_rectangle(const solids::ExactPolygon& polygon) {
  const auto box = solids::rectangle_around(polygon);
  return std::all_of(polygon.begin(), polygon.end(), [&](const solids::ExactSpot& spot) {
    const auto exact = spot.rationals();
    return exact[0] >= box.low[0] && exact[0] <= box.high[0] && exact[1] >= box.low[1] && exact[1] <= box.high[1];
  });
}

// Nothing is known of it but its rationals.
solids::ExactSpot without_estimate(solids::ExactSpot spot) {
  const double infinity = std::numeric_limits<double>::infinity();
  spot.off = {infinity, infinity};
  spot.is_brief = false;
  spot.plane = -1;
  return spot;
}

// What is wrong with the rims in the planes, if anything.
std::string compare_rims(const solids::Solids& all, Rims& rims) {
  for (const Cut& cut : cuts_of(all)) {
    std::vector<solids::ExactPolygon> polygons, without;
    for (const auto& solid : all.all()) {
      auto polygon = solids::section_of(solid, cut.plane, cut.dropped, cut.cutting);
      if (!polygon) continue;
      auto& bare = without.emplace_back();
      for (const auto& spot : *polygon) {
        rims.numbered += spot.plane >= 0 ? 1 : 0;
        rims.estimated += spot.off[0] > 0 || spot.off[1] > 0 ? 1 : 0;
        bare.push_back(without_estimate(spot));
      }
      polygons.push_back(std::move(*polygon));
    }
    const auto rim = solids::rim_of_union(polygons);
    for (const auto& polygon : polygons) {
      if (!std::all_of(polygon.begin(), polygon.end(), is_as_near_as_it_says)) return "a corner is not where it says";
      if (!are_in_their_rectangle(polygon)) return "a corner is not in the rectangle";
    }
    for (const auto& part : rim) {
      if (!std::all_of(part.segment.begin(), part.segment.end(), is_as_near_as_it_says))
        return "an end of a part is not where it says";
    }
    const auto expected = solids::rim_of_union(without);
    rims.parts += rim.size();
    if (std::equal(rim.begin(), rim.end(), expected.begin(), expected.end(), are_same)) continue;
    const auto& n = cut.plane.normal;
    return fmt::format("{} parts for {} in the plane {} {} {} at {}", rim.size(), expected.size(), n[0], n[1], n[2],
                       cut.plane.distance);
  }
  return "";
}

}  // namespace

Rims compare_rims(std::uint64_t first_seed, std::uint64_t worlds) {
  Rims rims;
  for (std::uint64_t seed = first_seed; seed < first_seed + worlds && rims.differs.empty(); ++seed) {
    const auto compare = [&](const solids::Solids& all, const char* kind) {
      const std::string wrong = compare_rims(all, rims);
      if (!wrong.empty()) rims.differs = fmt::format("seed {}, {}: {}", seed, kind, wrong);
    };
    compare(solids_of_world(random_world(seed)), "world");
    const scene::Bounds about{{0, 0, 0}, {16, 16, 16}};
    if (rims.differs.empty()) compare(solids::Solids(turned_boxes(seed), about), "turned boxes");
    if (rims.differs.empty()) compare(solids::Solids(boxes_in_sevenths(seed), about), "boxes in sevenths");
  }
  return rims;
}

}  // namespace clues::tests
