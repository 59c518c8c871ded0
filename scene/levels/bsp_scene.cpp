// D22: drawn faces and hulls, in the order that the header states.
#include "scene/levels/bsp_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/formats/place.h"
#include "scene/levels/bsp_bounds.h"
#include "scene/levels/bsp_covered.h"
#include "scene/levels/bsp_flags.h"
#include "scene/levels/bsp_hulls.h"
#include "scene/levels/bsp_patch.h"

namespace clues::scene {
namespace {

using Corners = std::array<Point, 3>;

std::vector<Corners> triangles_of_face(const BspFile& level, const BspFile::Face& face) {
  if (face.kind == BspFile::Kind::patch) return triangles_of_patch(level, face);
  std::vector<Corners> triangles;
  const auto corner = [&](std::uint32_t i) {
    return level.points[face.vertices.first + level.corners[face.corners.first + i]];
  };
  for (std::uint32_t i = 0; i < face.corners.count; i += 3)
    triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
  return triangles;
}

class SceneBuilder {
 public:
  SceneBuilder(const BspFile& level, HullSides sides) : level_(level), sides_(sides) {}

  LevelScene build() {
    const auto& world = level_.models[0];
    for (std::uint32_t i = 0; i < level_.faces.size(); ++i) {
      out_.first_triangle_of.push_back(static_cast<std::uint32_t>(builder_.triangle_count()));
      if (i < world.faces.first || i - world.faces.first >= world.faces.count) {
        ++out_.moving;
      } else {
        add_face(i);
      }
    }
    out_.face_triangles = static_cast<std::uint32_t>(builder_.triangle_count());
    out_.first_triangle_of.push_back(out_.face_triangles);
    if (out_.face_triangles == 0)
      fail_in(level_.name, ErrorCode::malformed, "no triangles; a scene needs at least one face that is drawn");
    const Polytope bounds = bounds_of_brushes(level_);
    for (std::uint32_t i = 0; i < world.brushes.count; ++i) find_hull(world.brushes.first + i, bounds);
    add_hulls();
    out_.scene = builder_.take();
    return std::move(out_);
  }

 private:
  void add_face(std::uint32_t index) {
    const auto& face = level_.faces[index];
    const auto& shader = level_.shaders[face.shader];
    if (face.kind == BspFile::Kind::billboard) {
      ++out_.billboards;
      return;
    }
    if (!is_drawn(shader)) {
      ++out_.undrawn;
      return;
    }
    const bool planar = face.kind == BspFile::Kind::planar, blocks = planar && is_opaque(shader);
    ++(planar ? out_.planar : face.kind == BspFile::Kind::patch ? out_.patches : out_.meshes);
    if (blocks) ++out_.opaque;
    builder_.begin_part(fmt::format("face {} ({})", index, shader.name));
    for (const auto& corners : triangles_of_face(level_, face)) {
      builder_.add(corners, index, {blocks, true});
      drawn_.push_back(corners);
      if (blocks) opaque_.push_back(corners);
    }
  }

  void find_hull(std::uint32_t index, const Polytope& bounds) {
    const auto& brush = level_.brushes[index];
    if (!is_structural(level_.shaders[brush.shader])) return;
    auto solid = solid_of_brush(level_, brush, bounds, drawn_);
    Hull hull = solid ? hull_of_solid(*solid) : Hull{};
    if (solid) out_.solids.push_back(std::move(*solid));
    ++(hull.empty() ? out_.thin_brushes : out_.hulls);
    if (hull.empty()) return;
    brushes_.push_back(index);
    hulls_.push_back(std::move(hull));
  }

  void add_hulls() {
    const auto covered = covered_faces(hulls_, opaque_);
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      const auto index = brushes_[i];
      builder_.begin_part(fmt::format("brush {} ({})", index, level_.shaders[level_.brushes[index].shader].name));
      for (std::size_t k = 0; k < hulls_[i].size(); ++k) {
        ++out_.hull_sides;
        if (covered[i][k]) {
          ++out_.covered_sides;
          if (sides_ == HullSides::uncovered) continue;
        }
        const auto& face = hulls_[i][k];
        for (std::size_t c = 1; c + 1 < face.size(); ++c) {
          builder_.add({face[0], face[c], face[c + 1]}, static_cast<std::uint32_t>(level_.faces.size()) + index,
                       {true, false});
        }
      }
    }
  }

  const BspFile& level_;
  const HullSides sides_;
  FlaggedMeshBuilder builder_;
  std::vector<Corners> drawn_, opaque_;
  std::vector<std::uint32_t> brushes_;  // with a hull
  std::vector<Hull> hulls_;             // of these
  LevelScene out_;
};

}  // namespace

LevelScene scene_of_level(const BspFile& level, HullSides sides) { return SceneBuilder(level, sides).build(); }

std::vector<std::uint32_t> shipped_set(const BspFile& level, const LevelScene& scene, std::uint32_t cluster) {
  std::vector<bool> listed(level.faces.size());
  for (const auto i : level.leaves_of_tree) {
    const auto& leaf = level.leaves[i];
    if (leaf.cluster < 0 || !level.sees(cluster, static_cast<std::uint32_t>(leaf.cluster))) continue;
    for (std::uint32_t k = 0; k < leaf.faces.count; ++k) listed[level.leaf_faces[leaf.faces.first + k]] = true;
  }
  std::vector<std::uint32_t> triangles;
  for (std::size_t face = 0; face < listed.size(); ++face) {
    if (!listed[face]) continue;
    for (auto t = scene.first_triangle_of[face]; t < scene.first_triangle_of[face + 1]; ++t) triangles.push_back(t);
  }
  return triangles;
}

}  // namespace clues::scene
