// D31 to D33 in arrays, doubles and threads: the hierarchy of reference/multires/hierarchy.h, number for number.
//
// What is the same as there: the order of the vertices and the proposals for their layouts (exact/multires/star_rules.h, which both follow), and every
// decision, since each is a sign or a comparison of whole numbers, and a filter in doubles answers only where its error bound proves what whole
// numbers would say. What is other is how it is done:
//
// - A vertex that no removed neighbour blocks has the star that it had when the level began. So stars are laid out and their holes covered beforehand,
//   by all threads, for the vertices that would be removed if nothing forbade it; the level is then decided in order, and a cover is made anew where
//   an edge has come between two vertices of the ring.
// - The overlay of removals of one level is carried by all threads, after the level has been decided as if every star could be carried. Where one
//   cannot, the level is taken back and decided again in order, each star carried (or found carried) before the next is looked at.
// - Nothing that is asked depends on who computed it or when, so that any number of threads gives the same bytes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::fastpath::multires {

struct BuildOptions {
  std::uint64_t base_triangles = 200;  // ends with the first level that has no more
  std::vector<scene::Edge> features;   // edges of the surface that stay edge paths; those of its boundary do anyway
  std::vector<std::uint32_t> fixed;    // vertices that stay
  bool overlay = true;                 // false: levels and images of vertices alone, which is no proof of a map
  int threads = 0;                     // 0: as many as the machine has
  std::function<void(std::uint64_t triangles_left)> progress;
};

// How often what was done beforehand was of no use.
struct BuildCounts {
  std::uint64_t stars = 0;          // removed
  std::uint64_t covered_again = 0;  // after their hole had been covered
  std::uint64_t levels_again = 0;   // decided twice
};

// Throws Error unsupported where the mesh is no surface, bad_argument for a feature that is no edge and a vertex that does not exist.
scene::Hierarchy build_hierarchy(const scene::TriangleMesh& mesh, const BuildOptions& options,
                                 const std::string& name = "mesh", BuildCounts* counts = nullptr);

}  // namespace clues::fastpath::multires
