// Two ways to decode contours (D26), compared: exactly, as reference/contours/ does, and in doubles, as fastpath/contours/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fastpath/contours/contour_decoder.h"
#include "reference/contours/contour_code.h"
#include "scene/mesh/mesh.h"
#include "scene/stream/contour_file.h"

namespace clues::validate {

struct ContourComparison {
  std::vector<std::string> findings;  // where doubles have less than they must; empty: nowhere
  std::uint64_t sides = 0;            // of which the exact decoder sees something
  std::uint64_t ends_checked = 0;     // of borders
  std::uint64_t exact_list = 0, list = 0;
  double exact_area = 0, area = 0;  // sum over sides, in units of the scene; of the second the border is taken as it is
  double radius = 0;                // the largest
};

// What doubles call visible, with the exact places of its borders' ends, has to hold `exact` on every side; and each of
// these places has to be as near as is said. That is the guarantee of contour_decoder.h, in both of its parts.
ContourComparison compare_contours(const scene::TriangleMesh& mesh, const scene::ContourFile& file, std::uint32_t cell,
                                   const std::vector<reference::InputSide>& sides,
                                   const std::vector<reference::FlatSet>& exact,
                                   const fastpath::ContourDecoding& decoding);

}  // namespace clues::validate
