// What shares no algorithm with refined maps of the fast path, and judges them.
#pragma once

#include "slit_scenes.h"

namespace clues::fastpath {

struct Judged {
  std::uint64_t scenes = 0, gained = 0, missing = 0, hidden_points = 0, seen_points = 0;
};

// Points just off the middles of hidden polygons, far from their borders for what doubles are off.
void judge_points(const scene::TriangleMesh& mesh, const std::vector<Point>& cell, const RefinedVisibility& found,
                  std::size_t most, Judged& judged);

// How many of the triangles that refinement took out are seen after all.
std::uint64_t lost(const Scene& s, const RefinedVisibility& found);

}  // namespace clues::fastpath
