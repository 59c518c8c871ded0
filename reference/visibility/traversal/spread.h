// What sight lines show (D5), and the flood over surfaces that hang together (FIG. 20A, steps 20.1 to 20.3). A sight line from int V that crosses a
// surface cleanly sees it: whatever is found here is visible beyond doubt.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/dials.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/search/options.h"

namespace clues::reference {

class Spread {
 public:
  // `sight_rays`: no more sight lines than this in all (Dials).
  Spread(const exact::SceneQuery& scene, Statistics& statistics, std::int64_t sight_rays = exact::Dials::kOwn);

  // Sight lines from the cell's centre in 26 directions, and on from there.
  void look_around();
  // Sight lines at these pieces from all over the cell, and on from what they meet: the piece, or whatever is before it.
  void look_at(const std::vector<std::uint32_t>& pieces);
  // Marks as visited without a sight line.
  void visit(std::uint32_t piece) { visited_[piece] = true; }
  void visit_with_neighbours(std::uint32_t piece);  // those that share a corner with it

  const std::vector<bool>& visited() const { return visited_; }
  bool anything_seen() const { return seen_count_ > 0; }
  std::uint64_t seen_count() const { return seen_count_; }

 private:
  void see(std::uint32_t piece);
  void sight(const exact::Point3& v, const exact::Point3& p, const std::uint32_t* target);
  void try_to_see(std::uint32_t piece);
  void flood();

  const exact::SceneQuery& scene_;
  Statistics& statistics_;
  std::int64_t sight_rays_;
  std::vector<exact::Point3> eyes_;  // in int V
  std::vector<bool> visited_, seen_, tried_;
  std::vector<std::uint32_t> queue_;
  std::uint64_t seen_count_ = 0;
};

}  // namespace clues::reference
