#include "fastpath/solids/find_solids.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

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

}  // namespace

std::vector<Solid> solids_of(const std::vector<std::vector<std::vector<Point>>>& faces) {
  std::vector<Solid> solids;
  for (const auto& of_one : faces) {
    if (of_one.size() > kMostFaces) continue;
    if (auto solid = solid_of(of_one)) solids.push_back(std::move(*solid));
  }
  return solids;
}

std::vector<Solid> find_solids(const scene::FlaggedMesh& scene) {
  const auto& mesh = scene.mesh;
  std::map<Point, std::uint32_t> first_with;
  std::vector<std::uint32_t> place(mesh.points.size());  // of a point: the first one with its coordinates
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
    place[i] = first_with.try_emplace(mesh.points[i], i).first->second;
  Groups groups(mesh.points.size());
  const auto blocking = scene::blocking_ids(scene);
  for (const auto t : blocking) {
    for (std::size_t i = 1; i < 3; ++i) groups.join(place[mesh.triangles[t][0]], place[mesh.triangles[t][i]]);
  }
  std::map<std::uint32_t, std::vector<std::vector<Point>>> parts;
  for (const auto t : blocking) {
    auto& face = parts[groups.leader_of(place[mesh.triangles[t][0]])].emplace_back();
    for (const auto i : mesh.triangles[t]) face.push_back(mesh.points[i]);
  }
  std::vector<std::vector<std::vector<Point>>> faces;
  for (auto& [leader, of_one] : parts) faces.push_back(std::move(of_one));
  return solids_of(faces);
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

}  // namespace clues::fastpath::solids
