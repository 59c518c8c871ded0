// FIGS. 34, 35: the boundary of a visible set as the labels of the planes that made it, and the segments made again from
// them. A segment lies on its triangle along the plane of one label, or along an edge of the triangle, and ends where a
// second one crosses it, or at a border of what is known: not one coordinate is stored. What no label explains is stored
// in full, and counted.
//
// The bytes: varints (seven bits a byte, the lowest first). The labels that are used; the seeds, each with its side and a
// point in floats or doubles; then, side by side, the segments. A segment that begins where the one before has ended, as
// along a contour, has one end only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reference/contours/flood.h"
#include "reference/contours/plane_labels.h"

namespace clues::reference {

struct ContourCode {
  std::string bytes;
  std::uint64_t ends_by_labels = 0, ends_in_full = 0;
  std::uint64_t segments_in_full = 0;
};

// `label` as of contour_label() for these sides and known sets; `planes`: of the cell whose map the wanted sets are.
ContourCode encoded_contours(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                             const std::vector<FlatSet>& known, const ContourLabel& label, const PlaneTable& planes);

// The same label again, exactly, but for the places of seeds within their components. Throws scene::Error malformed.
ContourLabel decoded_contours(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                              const std::vector<FlatSet>& known, const exact::ConvexCell& cell, std::string_view bytes);

}  // namespace clues::reference
