#include "fastpath/solids/find_solids.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "fastpath/solids/shafts.h"
#include "fastpath/solids/targets.h"

namespace clues::fastpath::solids {
namespace {

// Which numbers belong together.
class Groups {
 public:
  explicit Groups(std::size_t count) : leader_(count) { std::iota(leader_.begin(), leader_.end(), 0U); }
  std::uint32_t leader_of(std::uint32_t i) {
    while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { leader_[leader_of(a)] = leader_of(b); }

 private:
  std::vector<std::uint32_t> leader_;
};

constexpr std::size_t kMostFaces =
    4096;  // of a solid: beyond that it is hardly a wall, and takes a square of steps to prove

using Ids = std::vector<std::uint32_t>;

enum class Joined { by_corners, by_edges };  // edges: of which exactly two triangles have each

// Triangles that hang together, where vertices with equal entries in `places` are one.
std::vector<Ids> parts_of(const scene::TriangleMesh& mesh, const Ids& triangles, const Ids& places, Joined how) {
  std::map<std::array<std::uint32_t, 2>, Ids> at;  // numbers in `triangles`
  for (std::uint32_t n = 0; n < triangles.size(); ++n) {
    const auto& corners = mesh.triangles[triangles[n]];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = places[corners[i]], b = how == Joined::by_edges ? places[corners[(i + 1) % 3]] : a;
      at[{std::min(a, b), std::max(a, b)}].push_back(n);
    }
  }
  Groups groups(triangles.size());
  for (const auto& [place, there] : at) {
    if (how == Joined::by_edges && there.size() != 2) continue;
    for (const auto n : there) groups.join(there[0], n);
  }
  std::map<std::uint32_t, Ids> parts;
  for (std::uint32_t n = 0; n < triangles.size(); ++n) parts[groups.leader_of(n)].push_back(triangles[n]);
  std::vector<Ids> all;
  for (auto& [leader, part] : parts) all.push_back(std::move(part));
  return all;
}

std::optional<Solid> solid_of_part(const scene::TriangleMesh& mesh, const Ids& triangles) {
  if (triangles.size() > kMostFaces) return std::nullopt;
  std::vector<std::vector<Point>> faces;
  for (const auto t : triangles) {
    auto& face = faces.emplace_back();
    for (const auto i : mesh.triangles[t]) face.push_back(mesh.points[i]);
  }
  return solid_of(faces);
}

}  // namespace

std::vector<Solid> solids_of(const std::vector<scene::Polytope>& polytopes) {
  std::vector<Solid> solids;
  for (const auto& polytope : polytopes) solids.push_back(solid_of_polytope(polytope));
  return solids;
}

std::vector<Solid> find_solids(const scene::FlaggedMesh& scene) {
  const auto& mesh = scene.mesh;
  std::map<Point, std::uint32_t> first_with;
  Ids numbers(mesh.points.size()), places(mesh.points.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  for (const auto i : numbers) places[i] = first_with.try_emplace(mesh.points[i], i).first->second;
  std::vector<Solid> found;
  auto left = scene::blocking_ids(scene);
  for (const auto& [vertices, how] : {std::pair(&numbers, Joined::by_corners), std::pair(&places, Joined::by_edges),
                                      std::pair(&places, Joined::by_corners)}) {
    Ids others;
    for (const auto& part : parts_of(mesh, left, *vertices, how)) {
      if (auto solid = solid_of_part(mesh, part)) {
        found.push_back(std::move(*solid));
      } else {
        others.insert(others.end(), part.begin(), part.end());
      }
    }
    left = std::move(others);
  }
  return found;
}

Bounds bounds_of_questions(const scene::FlaggedMesh& scene, const std::vector<std::vector<Point>>& cells) {
  std::optional<Bounds> all;
  const auto add = [&](const Bounds& box) { all = all ? scene::hull_of(*all, box) : box; };
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (!scene.counting(t)) continue;
    for (const auto i : scene.mesh.triangles[t]) add({scene.mesh.points[i], scene.mesh.points[i]});
  }
  for (const auto& cell : cells) {
    if (!cell.empty()) add(scene::bounds_of(cell));
  }
  return all.value_or(Bounds{});
}

std::vector<std::uint32_t> not_hidden(const scene::FlaggedMesh& scene, const std::vector<Point>& cell) {
  const Solids solids(find_solids(scene), bounds_of_questions(scene, {cell}));
  return not_hidden(solids, Targets(scene, solids), cell);
}

}  // namespace clues::fastpath::solids
