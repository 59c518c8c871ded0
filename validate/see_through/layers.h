// D22 by kernels that know only triangles that block. With S the triangles that block and T those that count without blocking:
//
//   Blocking triangles of S are asked about in the scene S, which is all that blocks.
//   Triangles of T are peeled off. R begins as T. As long as the scene S + R shows some of R, in which the triangles of R block like all
//   others, these are visible and leave R. When none is seen any more, all of R is hidden.
//
// Why. *Who leaves is visible*: a sight line that is free of S + R is free of S. (Where the kernel lists what only looks visible to it, that
// triangle is listed, as ever.) *Who stays is hidden*: let t in R be visible in S, by D6 from an open part of the cell and on an open part of t. Nearly all
// of these sight lines cross every other plane of R's triangles transversally, and none of their rims. Take such a line and the first triangle r of R that it
// touches; t itself, if no other. Up to there it is free of S + R, and so are the lines beside it: r is visible in S + R, and would have left. A triangle that meets the cell is
// visible by D3 in every scene, so none of those stays. QED
//
// Each layer is one run of a kernel. There are as many as triangles of T stand behind one another, and two more at most.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scene/mesh/flagged_mesh.h"

namespace clues::validate {

// D22 word for word: the scene of all that blocks and triangle t alone. O(n).
struct AskedAlone {
  scene::TriangleMesh mesh;        // all of it blocks
  std::vector<std::uint32_t> ids;  // of its triangles in the scene, ascending
  std::uint32_t triangle = 0;      // the place of t in it
};
AskedAlone asked_alone(const scene::FlaggedMesh& scene, std::uint32_t t);

struct Layer {
  scene::TriangleMesh mesh;        // all of it blocks
  std::vector<std::uint32_t> ids;  // of its triangles in the scene, ascending
  std::vector<std::uint32_t>
      asked;                 // its triangles (not ids of the scene) that are asked about, ascending; never empty
  bool see_through = false;  // these are triangles of T
};

// Calls decide(layer) for each; it returns those of `asked` that are visible or may be (ascending). Of a layer of T from which nothing is returned, everything asked
// is hidden; it is the last.
using DecideLayer = std::function<std::vector<std::uint32_t>(const Layer& layer)>;
void each_layer(const scene::FlaggedMesh& scene, const DecideLayer& decide);

// The triangles that are listed: they count, and some layer's kernel lists them. list(mesh) is ascending and leaves out nothing visible. Ascending ids.
using ListVisible = std::function<std::vector<std::uint32_t>(const scene::TriangleMesh& mesh)>;
std::vector<std::uint32_t> visible_in_layers(const scene::FlaggedMesh& scene, const ListVisible& list);

}  // namespace clues::validate
