// What a stream is about, for `clues walk`, `clues serve` and `clues conform --stream`: a scene, cells of a grid or of a
// bake, which of them a viewer can go to from which, and their lists.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "app/common.h"
#include "reference/delta/stream_server.h"
#include "reference/visibility/search/options.h"
#include "scene/cell_spec.h"
#include "scene/mesh/flagged_mesh.h"
#include "scene/stream/stream_file.h"

namespace clues::app {

struct CellsChoice {
  std::string scene, cells, bake;  // one of the two last

  void add_to(CLI::App& command);  // SCENE, --cells, --bake
};

struct ServedCells {
  scene::FlaggedMesh scene;
  scene::StreamHeader header;
  std::vector<scene::CellSpec> cells;
  std::vector<std::vector<scene::Point>> inner;  // of a bake, W_in (D23) of each cell
  std::vector<std::vector<std::uint32_t>> neighbours;
  std::vector<std::vector<std::uint32_t>> lists;  // of a bake
};

inline constexpr const char* drop_help =
    "Send no `+` of so many triangles or fewer: cells before get them, on all routes (default: 0)";

// Throws Error: bad_argument, bad_cell, malformed, and file errors. A scene of --cells is opaque.
ServedCells served_cells(const CellsChoice& choice);

// The lists of all cells: of the bake, or mapped now; grown until no step sends `drop` triangles or fewer (worth.h).
// `who`: in front of the progress.
std::vector<std::vector<std::uint32_t>> lists_of(const ServedCells& served, const reference::Options& options,
                                                 std::size_t drop, const char* who);

// With what else the messages of this store follow from. The lists of a bake have no mode.
scene::StreamHeader header_of(const ServedCells& served, const MethodOptions& method,
                              const reference::StreamStore& store);

}  // namespace clues::app
