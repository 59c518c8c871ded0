// D22: lists of one cell in a scene of which some triangles do not block. With S the triangles that block and T those that count without blocking: the closure
// (closure.h) maps what is lit of S, and its proofs then ask about T as they ask about every triangle of S that was not mapped. What is proved to lie outside Omega(S) is
// hidden; the rest of T is listed. So T makes no wedges, and costs next to nothing.
//
// Why. A triangle t of T is visible if t, put into the scene S, is (D22): a sight line that is free of S ends on an open part of it. Its points are in Omega(S), before t is put in as
// well as after, since a ray loses nothing before its first hit. So a t of which no inner point is in Omega(S) is hidden. What meets the cell is visible (D3), and listed whatever the
// proof says. `listed too easily`: a proof fails too where light only meets a surface that cuts t, or where a wedge crosses t without showing it; of these some are dark.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "exact/complex/cut_memory.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/search/options.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fastpath {

// A scene with a tree over each kind of triangle. One serves many cells at once.
class SeeThroughScene {
 public:
  // Throws as Bvh does. O(n log n).
  explicit SeeThroughScene(scene::FlaggedMesh scene);
  SeeThroughScene(const SeeThroughScene&) = delete;
  SeeThroughScene& operator=(const SeeThroughScene&) = delete;

  const scene::FlaggedMesh& scene() const { return scene_; }
  const Bvh& blocking() const { return blocking_tree_; }
  const Bvh& passing() const { return passing_tree_; }
  // Of the triangles of these trees.
  std::uint32_t blocking_id(std::uint32_t triangle) const { return blocking_ids_[triangle]; }
  std::uint32_t passing_id(std::uint32_t triangle) const { return passing_ids_[triangle]; }
  std::optional<std::uint32_t> find_blocking(std::uint32_t id) const;  // and back
  // For each triangle of the blocking tree whether it counts.
  std::span<const std::uint8_t> blocking_that_count() const { return counting_; }
  // What is known of how the triangles of that tree cut each other.
  exact::CutMemories& cuts_of_blocking() const { return cuts_; }

 private:
  scene::FlaggedMesh scene_;
  std::vector<std::uint32_t> blocking_ids_, passing_ids_;
  std::vector<std::uint8_t> counting_;
  scene::TriangleMesh blocking_, passing_;
  Bvh blocking_tree_, passing_tree_;
  mutable exact::CutMemories cuts_;
};

struct SeeThroughList {
  // Ids of the scene, ascending: of S, whether they count or not, and of T.
  std::vector<std::uint32_t> blocking, passing;
  std::vector<std::uint32_t> all() const;                                       // both, ascending
  std::vector<std::uint32_t> counting(const scene::FlaggedMesh& scene) const;   // of these, what counts
  std::uint64_t mapped = 0, passes = 0, walks = 0, conservative_fallbacks = 0;  // of the closure of S
};

// The same for any number of threads of the current arena. `guess`: triangles that are mapped from the start (closure.h), ids of the scene; those that do not
// block are passed over. Where options.effort is spent what is not proved to be hidden is listed, and counts as a fallback. Errors as of first_order_visibility.
// `bound`: if it is there, ids of the scene, ascending, that have among them all that counts and is visible; nothing else is asked about.
SeeThroughList visible_through(const SeeThroughScene& scene, const std::vector<Point>& cell,
                               const LocalMapOptions& options, std::span<const std::uint32_t> guess = {},
                               const std::vector<std::uint32_t>* bound = nullptr);

}  // namespace clues::fastpath
