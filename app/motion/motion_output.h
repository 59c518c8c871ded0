// What `clues motion` makes of the frames of a walk: a table of numbers (CSV), a picture (SVG), a report (JSON), a mesh (PLY).
#pragma once

#include <string>
#include <vector>

#include "fastpath/motion/walk.h"

namespace clues::app {

using fastpath::motion::FrameReport;

std::string to_csv(const std::vector<FrameReport>& frames);

// Shares of all triangles over the frames, on a scale of powers of ten.
std::string to_svg(const std::vector<FrameReport>& frames);

// Means over the frames, shares in percent of all triangles.
struct WalkSummary {
  double examined = 0, tested = 0, reused = 0;  // percent of the triangles
  double removed = 0, removed_of_examined = 0;  // samples a frame; percent of the examined triangles
  double flipped = 0, inserted = 0, reinserted = 0, rays = 0, exact = 0;  // a frame
  std::uint64_t frames = 0, rebuilt = 0, triangles = 0, samples = 0;
  double way = 0;
};
WalkSummary summary_of(const std::vector<FrameReport>& frames);

// "clues-motion/1". No times: the same input gives the same bytes.
std::string to_json_text(const std::vector<FrameReport>& frames, const fastpath::motion::WalkOptions& options,
                         const std::string& scene, const std::string& path);

// The mesh around a viewpoint. Directions stand at twice the distance of the furthest sample; `kind` of a vertex: 0 a point, 1 a
// direction without surface, 2 a base vertex.
std::string to_ply(const scene::DepthMesh& mesh, const scene::MotionPoint& at);

}  // namespace clues::app
