// The subject "deltas": transitions from cell to cell (D24), judged from what their files hold.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fuzz/trials/trial.h"
#include "reference/delta/delta.h"
#include "reference/visibility/first_order.h"
#include "validate/stream/delta_file.h"

namespace clues::fuzz {

using DeltaMaker = std::function<reference::Delta(const scene::TriangleMesh& mesh, const exact::ConvexCell& from,
                                                  const exact::ConvexCell& to, const reference::Options& options)>;

// Of the reference, between the halves of a cell and from a cell to its half.
std::unique_ptr<Trial> make_deltas_trial();
// Of transitions that are not ours: tests plant mistakes so.
std::unique_ptr<Trial> make_deltas_trial(DeltaMaker delta);

// Both halves of a solid cell, cut at its centre across the x axis: neighbours that share a face. Of a cell without an interior none.
std::vector<exact::ConvexCell> halves_of(const exact::ConvexCell& cell);

// As read_map_file() reads it from the file of the map.
validate::MapFile map_file_of(const reference::VisibilityMap& map);

}  // namespace clues::fuzz
