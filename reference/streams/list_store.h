// FIG. 52 and the reuse of contours: the lists of a level, said within the lists of larger cells. Of the cells above only
// few are stored as they are; a cell below has a record of what it has of them: what goes, or a contour of what stays
// (list_contour.h), or the contour of a sibling, or what a sibling's has other than it. For each the record is taken that
// has the fewest bytes; so it is stored or labelled, whichever is less.
//
// Where area may be given up (FIGS. 33 C, D), a cell may be said to list more than it does: all of the place around it
// (its packet is dropped), or what a sibling lists, if that holds its list. That is done where the area of what it lists
// too much, for each byte that is saved, is not above a bound. Of two similar contours so the more conservative serves for
// both, and only where it is proved to be: by comparing lists, triangle by triangle.
//
// *Why that is sound on every route.* By induction from above, the list that is decoded for a place holds what its cells
// list: on the first level the list is stored, or made larger; below, the list of the place around, as it is decoded,
// holds it, and the record is made within that. So every cell is given all that it lists, whatever way the viewer came
// (hazard A-24: a packet that is dropped for who comes one way only), and no other cell's list is made to depend on it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "reference/contours/list_contour.h"
#include "reference/streams/area_worth.h"
#include "reference/streams/cell_tree.h"
#include "scene/stream/list_file.h"

namespace clues::reference {

struct ListStoreOptions {
  std::vector<std::size_t> levels;  // of the tree, that are stored above the cells; descending, from 1 on
  exact::FT area_of_a_byte = 0;     // to be given up; 0: none
};

// The levels of the file. `lists`: of each cell, ascending; `tree` has the levels. Siblings are compared with 64 before
// them. O(sum over the places of 64 * the size of the list around it * log).
std::vector<std::vector<scene::ListPlace>> made_levels(const EdgeUsers& edges, const AreaWorth& worth,
                                                       const std::vector<std::vector<std::uint32_t>>& lists,
                                                       const CellTree& tree, const ListStoreOptions& options);

// The lists of each level, ascending. Throws scene::Error malformed where a record does not fit the scene or what it is
// within, or a contour is not the one that its triangles have.
//
// A small file can ask for much: a record of few bytes for a large list, or for a walk over large ones that finds little.
// So the triangles of each list are counted, with those of the list around it, and beyond 2^28 in all the file is
// unsupported. Memory is O(size of the file + scene), and at most a GiB of lists; time is O(size of the file + scene), and
// at most that of 2^28 triangles.
std::vector<std::vector<std::vector<std::uint32_t>>> decoded_levels(
    const EdgeUsers& edges, const std::vector<std::vector<scene::ListPlace>>& levels);

}  // namespace clues::reference
