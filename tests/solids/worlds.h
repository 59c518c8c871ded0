// Scenes of solids and of what only looks like some, and an oracle that looks for what solids are said to hide.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/levels/polytope.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::tests {

using Face = std::vector<scene::Point>;

// The sides of a box, each turning left seen from outside.
std::vector<Face> faces_of_box(const scene::Point& low, const scene::Point& high);

struct World {
  scene::FlaggedMesh scene;
  std::vector<scene::Polytope> brushes;  // of walls besides, with rational corners
  std::vector<scene::Point> cell;
};

// Boxes on a grid that abut, overlap and leave cracks, some without a side, tetrahedra, loose triangles, panes that do not block, brushes with sloped sides; a cell of any
// dimension among them, in them at times, or a wedge before a brush that has its sloped side.
World random_world(std::uint64_t seed);

struct Looked {
  std::string seen;  // what is said to be hidden and is seen; empty: nothing
  std::uint64_t hidden = 0, lines = 0;
};

// Compares what solids hide in the world of each seed with sight lines, exactly decided, from corners, edges and inner points of the cell (just within it) to points of
// each triangle, also such that are close to its corners and edges.
Looked look_for_what_is_hidden(std::uint64_t first_seed, std::uint64_t worlds, int lines_for_each);

struct Rims {
  std::string differs;          // the first that is not the same; empty: none
  std::uint64_t parts = 0;      // of the rims
  std::uint64_t numbered = 0;   // edges whose plane has a number
  std::uint64_t estimated = 0;  // corners that are known in doubles with an error
};

// Compares the rims of sections with what they are where all is decided in rationals, without numbers of planes or estimates of corners: in each world, and among boxes that are turned and have full
// coordinates, and among such in sevenths, by planes with faces of the solids, and by such that lean. And all corners with what their estimates say.
Rims compare_rims(std::uint64_t first_seed, std::uint64_t worlds);

}  // namespace clues::tests
