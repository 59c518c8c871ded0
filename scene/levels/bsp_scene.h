// D22, D23: the level as a scene, its leaves as cells, and the visible sets that it was shipped with.
//
// The world (model 0) is the scene; doors, platforms and whatever else moves is no part of it. Its triangles, in this order:
//   - of each drawn face, in the order of the file: planar faces and meshes as the file triangulates them, Bezier patches cut
//     into a grid. All of them count. Only planar ones block, where their shader is known to be opaque (bsp_flags.h). Billboards and
//     what is not drawn are left out.
//   - the hulls of structural brushes: they block, and do not count. A hull lies in its brush (bsp_hulls.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/levels/bsp_file.h"
#include "scene/levels/polytope.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::scene {

// A patch of 3 x 3 control points becomes so many rows and columns of two triangles each.
inline constexpr std::uint32_t patch_steps = 4;

struct LevelScene {
  FlaggedMesh scene;                             // face_of: the face, or the number of faces plus the brush
  std::vector<std::uint32_t> first_triangle_of;  // per face of the file, and one more: where its triangles begin
  std::uint32_t planar = 0, opaque = 0, patches = 0,
                meshes = 0;  // drawn faces of the world; opaque: the planar ones that block
  std::uint32_t billboards = 0, undrawn = 0, moving = 0;  // faces that are left out, the last with their model
  std::uint32_t face_triangles = 0;
  std::uint32_t hulls = 0;                          // structural brushes with a hull
  std::uint32_t hull_sides = 0, covered_sides = 0;  // of the hulls; the covered ones are left out (bsp_covered.h)
  std::uint32_t thin_brushes = 0;                   // structural brushes that were left out: nothing is left of them
  std::vector<Polytope>
      solids;  // what hulls are rounded into: structural brushes, held behind what is drawn (bsp_hulls.h)
};

// Which sides of hulls are in the scene: those that nothing covers (bsp_covered.h), or all, for who is to be accused of missing something. Drawn triangles
// have the same ids in both.
enum class HullSides : std::uint8_t { uncovered, all };

// Throws Error malformed where nothing is drawn.
LevelScene scene_of_level(const BspFile& level, HullSides sides = HullSides::uncovered);

// A leaf of the tree that belongs to a cluster, as a convex cell: where the viewer can be.
struct LevelCell {
  std::uint32_t leaf = 0, cluster = 0;
  std::vector<Point> inner;  // W_in; empty: a sliver in which no tetrahedron of doubles was found
  std::vector<Point> outer;  // W_out; empty: so is the leaf
};

// In the order of the leaves. The world's bounds are those of its model and of all of its drawn points.
std::vector<LevelCell> cells_of_level(const BspFile& level);

// The triangles that the level lists for viewers in a cluster: of the faces in all leaves of all clusters that its row names. Ascending.
std::vector<std::uint32_t> shipped_set(const BspFile& level, const LevelScene& scene, std::uint32_t cluster);

}  // namespace clues::scene
