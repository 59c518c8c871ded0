// D22: see the header.
#include "scene/mesh/flagged_mesh.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace clues::scene {
namespace {

using Bits = std::array<std::uint64_t, 3>;

std::size_t hash_of(const Bits& bits) {
  std::uint64_t hash = 0;
  for (const auto word : bits) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

bool all(const std::vector<std::uint8_t>& flags) {
  return std::all_of(flags.begin(), flags.end(), [](std::uint8_t flag) { return flag != 0; });
}

}  // namespace

bool FlaggedMesh::is_plain() const { return all(blocks) && all(counts); }

std::string FlaggedMesh::name_of(std::uint32_t triangle) const {
  const auto after = std::upper_bound(parts.begin(), parts.end(), triangle,
                                      [](std::uint32_t t, const MeshPart& part) { return t < part.first_triangle; });
  return after == parts.begin() ? std::string() : std::prev(after)->name;
}

std::vector<std::uint32_t> blocking_ids(const FlaggedMesh& scene) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (scene.blocking(t)) ids.push_back(t);
  }
  return ids;
}

TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids) {
  TriangleMesh part;
  part.points = mesh.points;
  for (const auto id : ids) {
    part.triangles.push_back(mesh.triangles[id]);
    part.face_of.push_back(mesh.face_of[id]);
  }
  return part;
}

FlaggedMesh part_of(const FlaggedMesh& scene, const std::vector<std::uint32_t>& ids) {
  FlaggedMesh part;
  part.mesh = part_of(scene.mesh, ids);
  for (const auto id : ids) {
    part.blocks.push_back(scene.blocking(id) ? 1 : 0);
    part.counts.push_back(scene.counting(id) ? 1 : 0);
  }
  return part;
}

void FlaggedMeshBuilder::grow() {
  std::vector<std::uint32_t> bigger(table_.empty() ? 1024 : 2 * table_.size());
  for (const auto entry : table_) {
    if (entry == 0) continue;
    std::size_t at = hash_of(std::bit_cast<Bits>(mesh_.mesh.points[entry - 1])) & (bigger.size() - 1);
    while (bigger[at] != 0) at = (at + 1) & (bigger.size() - 1);
    bigger[at] = entry;
  }
  table_ = std::move(bigger);
}

std::uint32_t FlaggedMeshBuilder::index_of(const Point& point) {
  auto& points = mesh_.mesh.points;
  if (2 * (points.size() + 1) > table_.size()) grow();
  const auto bits = std::bit_cast<Bits>(point);
  std::size_t at = hash_of(bits) & (table_.size() - 1);
  while (table_[at] != 0) {
    if (std::bit_cast<Bits>(points[table_[at] - 1]) == bits) return table_[at] - 1;
    at = (at + 1) & (table_.size() - 1);
  }
  points.push_back(point);
  table_[at] = static_cast<std::uint32_t>(points.size());
  return table_[at] - 1;
}

void FlaggedMeshBuilder::add(const std::array<Point, 3>& corners, std::uint32_t face, Flags flags) {
  mesh_.mesh.triangles.push_back({index_of(corners[0]), index_of(corners[1]), index_of(corners[2])});
  mesh_.mesh.face_of.push_back(face);
  mesh_.blocks.push_back(flags.blocks ? 1 : 0);
  mesh_.counts.push_back(flags.counts ? 1 : 0);
}

void FlaggedMeshBuilder::begin_part(std::string name) {
  const auto first = static_cast<std::uint32_t>(triangle_count());
  if (!mesh_.parts.empty() && mesh_.parts.back().first_triangle == first) mesh_.parts.pop_back();  // had none
  mesh_.parts.push_back({first, std::move(name)});
}

FlaggedMesh FlaggedMeshBuilder::take() {
  if (!mesh_.parts.empty() && mesh_.parts.back().first_triangle == triangle_count()) mesh_.parts.pop_back();
  if (all(mesh_.blocks)) mesh_.blocks.clear();
  if (all(mesh_.counts)) mesh_.counts.clear();
  return std::move(mesh_);
}

}  // namespace clues::scene
