// Effective static occlusion and the simplification of a finished map (FIG. 30). What is hidden is only ever given up, never added, so a sound map stays sound (D7): each
// side of each triangle is decided within what is hidden on it, exactly (hazards ), and no proof rests on what a neighbour does.
//
// A *hidden region* is a connected part of one side of a piece of the complex. An *occlusion region* is made of hidden regions joined over edges: two of them belong
// together when their sides meet at an edge of exactly two pieces and both are hidden along some of its length. Only sides that some point of the cell is strictly in front of
// count: the others face away and are hidden by no one. Where more than two pieces meet, another surface begins, and with it another occlusion region.
//
// Where an occlusion region is not worth its boundary, the parts of it that the boundary cuts off become visible; pieces that are hidden wholly cost nothing and stay.
// So the PVS never changes: a side with a boundary is seen already. (The published text removes the region as a whole, and names this as an alternative: it saves the
// same segments and gives up less.)
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reference/visibility/hidden/boundary_simplification.h"
#include "reference/visibility/map/visibility_map.h"

namespace clues::reference {

// What an occlusion region is worth and what it costs. The segments are those of its border inside triangles, as long as they can be; a border along an edge
// of the mesh costs nothing.
struct OcclusionRegion {
  std::uint64_t segments = 0;
  double hidden_area = 0;                // areas are estimates, in units of the map, squared; the same in every run
  double bordered_area = 0;              // without the pieces that are hidden wholly
  std::uint64_t whole_pieces = 0;        // sides of pieces that lie in it wholly
  std::vector<std::uint32_t> triangles;  // input triangles with a hidden region in it, ascending

  // Bordered area for each segment: what would be given up for it. The published measure takes the area seen in an image from one viewpoint, and the new triangles of
  // one way to cut the visible side; this one depends on neither. Infinite without a segment: there is nothing to save.
  double effective() const;
};

// In the order of their first pieces, fronts before backs.
std::vector<OcclusionRegion> occlusion_regions(const VisibilityMap& map);

struct OcclusionControls {
  double min_occlusion =
      0;  // in units of the scene, squared: where effective() is less, after the simplification, the boundary goes
  double max_loss = 0;  // 0 to 1: the largest part of its area that a hidden region gives up for a simpler border
  int threads = 0;      // 0: as many as the machine has; the result does not depend on it
  std::optional<double> corner_angle = std::
      nullopt;  // FIG. 20B, before all else: the planes meet where that is within so many degrees of every swept wedge
};

struct OcclusionFigures {
  std::uint64_t regions = 0;  // occlusion regions
  std::uint64_t segments = 0;
  double hidden_area = 0;  // estimate, in units of the map, squared
  std::uint64_t visible_triangles = 0;
};

struct SimplifiedMap {
  // Sides of which nothing was given up are as they were; the others have no DM segments but the borders of what is visible.
  VisibilityMap map;
  OcclusionFigures before, after;
  std::uint64_t inside_corners = 0,
                by_planes = 0;  // FIG. 20B: those within the angle, and those of them that saved a segment
};

// Throws Error internal should anything have become hidden.
SimplifiedMap with_simpler_occlusion(const VisibilityMap& map, const OcclusionControls& controls);

// Whether what `after` hides was hidden before, on every side, exactly. Maps of one scene and cell.
bool hides_no_more(const VisibilityMap& before, const VisibilityMap& after, int threads = 0);

}  // namespace clues::reference
