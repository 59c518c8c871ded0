// What a stream is about, for `clues walk`, `clues serve` and `clues conform --stream`: a scene, cells of a grid, of
// a bake or of a file of lists, which of them a viewer can go to from which, and their lists.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "app/common.h"
#include "reference/streams/area_worth.h"
#include "reference/streams/stream_server.h"
#include "reference/visibility/search/options.h"
#include "scene/cell_spec.h"
#include "scene/mesh/flagged_mesh.h"
#include "scene/stream/stream_file.h"

namespace clues::app {

struct CellsChoice {
  std::string scene, cells, bake, lists;  // one of the three last

  void add_to(CLI::App& command);  // SCENE, --cells, --bake, --lists
  bool has_lists() const { return cells.empty(); }
};

struct ServedCells {
  scene::FlaggedMesh scene;
  scene::StreamHeader header;
  std::vector<scene::CellSpec> cells;
  std::vector<std::vector<scene::Point>> inner;  // of a bake or a file of lists, W_in (D23) of each cell
  std::vector<std::vector<std::uint32_t>> neighbours;
  std::vector<std::vector<std::uint32_t>> lists;  // of a bake or a file of lists
};

// What is sent of them: for `clues walk` and `clues serve`.
struct SendChoice {
  int horizon = 0, levels = 0;
  std::size_t drop = 0;
  double drop_area = 0;  // of a byte
  bool contours = false;

  void add_to(CLI::App& command);  // --horizon, --hierarchy, --contours, --drop, --drop-area
  bool drops() const { return drop > 0 || drop_area > 0; }
  bool is_default() const { return horizon == 0 && levels == 0 && !contours && !drops(); }
};

struct SentLists {
  std::vector<std::vector<std::uint32_t>> lists;  // of each cell
  std::string dropped;                            // what was dropped, in a line; empty: nothing was to be
};

// Throws Error: bad_argument, bad_cell, malformed, and file errors. A scene of --cells is opaque.
ServedCells served_cells(const CellsChoice& choice);

// The lists of all cells: those that are there, or mapped now; grown until no step sends what is not worth it (worth.h).
// `who`: in front of the progress.
SentLists lists_of(const ServedCells& served, const reference::Options& options, const SendChoice& send,
                   const char* who);

// What grown lists have more, over all cells: an estimate, infinite where no double holds it.
double area_given_up(const reference::AreaWorth& worth, const std::vector<std::vector<std::uint32_t>>& lists,
                     const std::vector<std::vector<std::uint32_t>>& grown);

// Of these lists. Keeps a reference to `served`.
reference::StreamStore store_of(const ServedCells& served, std::vector<std::vector<std::uint32_t>> lists,
                                const SendChoice& send);

// With what else the messages of this store follow from. The lists of a bake have no mode.
scene::StreamHeader header_of(const ServedCells& served, const MethodOptions& method,
                              const reference::StreamStore& store);

}  // namespace clues::app
