// D26: makes a file of contours. Each cell is mapped, what it sees is coded within what the cell around it is decoded to,
// decoded again, and compared.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/contours/contour_code.h"
#include "reference/visibility/search/options.h"
#include "scene/mesh/mesh.h"
#include "scene/stream/contour_file.h"

namespace clues::reference {

// What a cell took.
struct MadeContours {
  std::vector<std::uint32_t> visible;  // of its map
  std::size_t seeds = 0, segments = 0, bytes = 0;
  ContourCounts counts;
};

class ContourMaker {
 public:
  // With a reach above 0, sides farther from a cell than so many of its diameters are left as the cell around sees them.
  ContourMaker(const scene::TriangleMesh& mesh, const Options& options, double reach);

  // Cell `within - 1` of the file holds this one, inside in inside; 0: none does, and the map is coded within whole
  // triangles. `is_around`: others will be within it. Throws scene::Error as first_order_visibility does; bad_cell where a
  // corner is not a double; internal where decoding gives less than the map.
  const MadeContours& add(const std::string& name, const exact::ConvexCell& cell, std::uint32_t within, bool is_around);

  const scene::ContourFile& file() const { return file_; }  // without the hash of the scene
  const std::vector<InputSide>& sides() const { return sides_; }

 private:
  const scene::TriangleMesh& mesh_;
  Options options_;
  std::vector<InputSide> sides_;
  scene::ContourFile file_;
  std::map<std::uint32_t, std::vector<FlatSet>> seen_;  // of cells that are around others
  MadeContours last_;
};

}  // namespace clues::reference
