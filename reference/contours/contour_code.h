// FIGS. 34, 35: the boundary of a visible set as the labels of the planes that made it, and the segments made again from
// them. An end of a segment is where two such planes cross on its triangle, or one of them an edge or what is drawn
// there already: not one coordinate is stored. What no label explains is stored in full, and counted.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/contours/drawing.h"
#include "reference/contours/flood.h"
#include "reference/contours/plane_labels.h"
#include "scene/stream/contour_file.h"

namespace clues::reference {

struct ContourCounts {
  std::uint64_t by_labels = 0, in_full = 0;  // points
  std::uint64_t bridges = 0;
};

// Planes, sides and seeds of a cell. `label` as of contour_label() for these sides, within what the cell around it sees;
// `drawings`: of the cells around it; `planes`: of the cell whose map the wanted sets are.
scene::ContourCell encoded_contours(const std::vector<InputSide>& sides, const ContourLabel& label, Drawings drawings,
                                    const PlaneTable& planes, ContourCounts& counts);

// The same label again, exactly, but for the places of seeds within their components; what the cell draws is added to
// `drawings`. Throws scene::Error malformed.
ContourLabel decoded_contours(const std::vector<InputSide>& sides, const scene::ContourCell& cell, Drawings& drawings);

// The map of a cell of the file: what it sees of each side, by floods from the outermost cell inwards. With `keep` what
// each cell on the way sees is kept there, and is not found twice. Throws scene::Error malformed.
using ContourMaps = std::map<std::uint32_t, std::vector<FlatSet>>;
std::vector<FlatSet> decoded_map(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                 const scene::ContourFile& file, std::uint32_t cell, ContourMaps* keep = nullptr);

// Whole triangles.
std::vector<FlatSet> whole_sides(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh);

// The triangles of the sides that have something, and those besides; ascending.
std::vector<std::uint32_t> list_of(const std::vector<InputSide>& sides, const std::vector<FlatSet>& sets,
                                   const std::vector<std::uint32_t>& besides);

}  // namespace clues::reference
