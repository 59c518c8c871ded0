// clues level: what a level of the Quake 3 family holds, as a table, as JSON, and as files for the other commands.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/level_export.h"
#include "scene/formats/file_bytes.h"
#include "scene/levels/bsp_scene.h"
#include "scene/result.h"

namespace clues::app {
namespace {

struct LevelRequest {
  std::string file, folder;
  JsonOutput json;
};

struct Row {
  const char* key;   // in JSON
  const char* text;  // in the table
  std::uint64_t value;
};

std::vector<Row> rows_of(const scene::BspFile& level, const scene::LevelScene& scene,
                         const std::vector<scene::LevelCell>& cells) {
  const auto total = static_cast<std::uint32_t>(scene.scene.mesh.triangles.size());
  std::uint64_t blocking = 0, counting = 0, no_inner = 0, no_outer = 0, points = 0;
  for (std::uint32_t t = 0; t < total; ++t) {
    blocking += scene.scene.blocking(t) ? 1 : 0;
    counting += scene.scene.counting(t) ? 1 : 0;
  }
  for (const auto& cell : cells) {
    no_inner += cell.inner.empty() ? 1 : 0;
    no_outer += cell.outer.empty() ? 1 : 0;
    points = std::max<std::uint64_t>(points, cell.outer.size());
  }
  return {{"planar_faces", "planar faces drawn", scene.planar},
          {"opaque_faces", "  of these opaque, so that they block", scene.opaque},
          {"patches", "Bezier patches drawn", scene.patches},
          {"meshes", "meshes drawn", scene.meshes},
          {"billboards", "billboards, left out", scene.billboards},
          {"undrawn_faces", "faces that are not drawn, left out", scene.undrawn},
          {"moving_faces", "faces of what moves, left out", scene.moving},
          {"brushes", "brushes", level.brushes.size()},
          {"hulls", "  structural ones with a hull that blocks", scene.hulls},
          {"hull_sides", "    sides of these", scene.hull_sides},
          {"covered_sides", "    covered, but for a little; left out", scene.covered_sides},
          {"thin_brushes", "  structural ones of which nothing is left", scene.thin_brushes},
          {"triangles", "triangles", total},
          {"counting_triangles", "  that count", counting},
          {"blocking_triangles", "  that block", blocking},
          {"leaves", "leaves of the tree", level.leaves_of_tree.size()},
          {"clusters", "clusters", level.visibility.clusters},
          {"visibility_bytes", "bytes of visibility (0: all is visible)", level.visibility.bits.size()},
          {"cells", "cells: leaves with a cluster", cells.size()},
          {"cells_without_inner", "  without an inner cell: slivers", no_inner},
          {"cells_without_outer", "  without interior", no_outer},
          {"most_points_of_cell", "  points of an outer cell, at most", points}};
}

int run_level(const LevelRequest& request) {
  if (!request.json.file().empty()) require_writable_parent(request.json.file());
  require_apart({&request.json.file()}, {&request.file});
  const auto bytes = scene::read_file_bytes(request.file);
  const auto level = scene::parse_bsp(bytes, request.file);
  const auto scene = scene::scene_of_level(level);
  const auto cells = scene::cells_of_level(level);
  const auto rows = rows_of(level, scene, cells);
  nlohmann::json about = {{"format", "clues-level/1"},
                          {"file", std::filesystem::path(request.file).filename().string()},
                          {"sha256", scene::sha256_of(bytes)}};
  for (const auto& row : rows) about[row.key] = row.value;
  about["far_plane"] = level.far_plane > 0 ? nlohmann::json(level.far_plane) : nlohmann::json();
  const std::string json = about.dump(2) + "\n";
  if (!request.folder.empty()) export_level(request.folder, level, scene, cells, json);
  if (request.json.asked()) request.json.write(json);
  if (request.json.on_stdout()) return fine;
  std::string table;
  for (const auto& row : rows) table += fmt::format("{:<45} {:>9}\n", row.text, row.value);
  if (level.far_plane > 0) table += fmt::format("{:<45} {:>9}\n", "far plane of what was shipped", level.far_plane);
  print(table);
  return fine;
}

}  // namespace

void add_level_command(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("level", "Say what a game level holds, and export its cells and shipped lists");
  auto request = std::make_shared<LevelRequest>();
  command->add_option("FILE", request->file, "The level: a .bsp file of the Quake 3 family (IBSP 46)")->required();
  command
      ->add_option("--export", request->folder,
                   "A new folder for the scene, the cells and the shipped lists, as files that the other commands read")
      ->type_name("FOLDER");
  request->json.add_to(*command, "The table");
  command->footer(
      "DESCRIPTION\n"
      "  Counts what a level draws, what of it blocks, and the leaves of its tree as convex cells.\n"
      "  --export writes scene.obj and flags.txt (every triangle, and whether it blocks and counts), cells/LEAF.in.obj "
      "and\n"
      "  LEAF.out.obj (an inner cell to accuse with, an outer one to bake with), cells.txt (leaf and cluster) and\n"
      "  pvs/CLUSTER.txt (the triangles that the level lists for viewers in a cluster). level.json is written last.\n"
      "  docs/real-levels.md says how to go on.\n\n"
      "EXAMPLES\n"
      "  clues level level.bsp\n"
      "  clues level level.bsp --export level\n"
      "  clues map level.bsp --cell level/cells/0.out.obj --kernel fast -o mine.pvs\n"
      "  clues check level.bsp --cell level/cells/0.in.obj --pvs level/pvs/0.txt\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input");
  command->callback([request, &status] { status = run_level(*request); });
}

}  // namespace clues::app
