// clues map: scene and cell in, exact visibility map out.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/progress.h"
#include "reference/visibility/first_order.h"
#include "scene/atomic_file.h"
#include "scene/cell_spec.h"
#include "scene/error.h"
#include "scene/mesh_io.h"
#include "scene/result.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

struct MapRequest {
  std::string scene, cell, cells, out;
  bool with_map = false, json = false;
  MethodOptions method;
  RefineChoice refine;
};

// What is wanted beyond the first-order map.
struct Wanted {
  validate::Refinement refinement = validate::Refinement::none;
  reference::RefineOptions options;
};

// --method backprojected is short for --refine backprojection; with --refine cell both are wanted. Takes the method back to the one that
// the other options know.
Wanted wanted(MapRequest& request) {
  const bool backprojected = request.method.method == "backprojected";
  if (backprojected) request.method.method = "first-order";
  Wanted out{request.refine.refinement(validate::Refinement::none), request.refine.to_reference()};
  if (backprojected) {
    out.refinement = out.refinement == validate::Refinement::cells || out.refinement == validate::Refinement::both
                         ? validate::Refinement::both
                         : validate::Refinement::backprojection;
  }
  return out;
}

reference::VisibilityMap visibility_map(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                        const reference::Options& options, const Wanted& wanted) {
  if (wanted.refinement == validate::Refinement::none) return reference::first_order_visibility(mesh, cell, options);
  reference::Bounds bounds(mesh, cell, options);
  validate::refine(bounds, wanted.refinement, wanted.options);
  return bounds.refined_map(wanted.refinement == validate::Refinement::cells ? "subdivided" : "backprojected");
}

struct MappedCell {
  std::string name;
  std::string bytes;    // what goes into the file
  std::string summary;  // one line of the table
};

constexpr const char* table_head = "triangles  wholly  partly  hidden  visible area  fallbacks  cell\n";

std::string table_line(const std::string& name, const reference::VisibilityMap& map) {
  const auto census = take_census(map);
  const double share =
      census.area_facing_estimate > 0 ? 100 * census.area_visible_estimate / census.area_facing_estimate : 0;
  return fmt::format("{:>9}  {:>6}  {:>6}  {:>6}  {:>10.2f} %  {:>9}  {}\n", map.complex.input_triangles, census.wholly,
                     census.partly, census.hidden, share, map.statistics.conservative_fallbacks, name);
}

bool wants_plain_list(const fs::path& out) { return out.extension() == ".pvs" || out.extension() == ".txt"; }

// "0,1,2" -> "cell-0-1-2.clues.json"
fs::path file_of_cell(const fs::path& folder, std::string name) {
  if (name.find_first_not_of("0123456789,") != std::string::npos) name = "0";
  for (char& c : name) {
    if (c == ',') c = '-';
  }
  return folder / ("cell-" + name + ".clues.json");
}

MappedCell map_cell(const scene::TriangleMesh& mesh, const std::string& sha256, const scene::CellSpec& spec,
                    const reference::Options& options, const Wanted& wanted, const MapRequest& request) {
  const auto cell = exact::ConvexCell::from_doubles(spec.points);
  const auto map = visibility_map(mesh, cell, options, wanted);
  auto result = reference::to_result(map, spec, request.with_map);
  result.scene_file = fs::path(request.scene).filename().string();
  result.scene_sha256 = sha256;
  const bool plain = request.cells.empty() && wants_plain_list(request.out);
  return {spec.name, plain ? scene::to_pvs_text(result.visible) : scene::to_json_text(result),
          table_line(spec.name, map)};
}

std::vector<MappedCell> map_all(const scene::TriangleMesh& mesh, const std::string& sha256,
                                const std::vector<scene::CellSpec>& cells, reference::Options options,
                                const Wanted& wanted, const MapRequest& request) {
  ProgressBar bar("clues map");
  if (cells.size() == 1) {
    options.progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
      bar.show(stage, done, total);
    };
    return {map_cell(mesh, sha256, cells[0], options, wanted, request)};
  }
  // Many cells: one thread each, so that none waits for another.
  std::vector<MappedCell> mapped(cells.size());
  std::mutex bar_mutex;
  std::size_t done = 0;
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  options.threads = 1;
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      mapped[i] = map_cell(mesh, sha256, cells[i], options, wanted, request);
      const std::lock_guard lock(bar_mutex);
      bar.show("cells", ++done, cells.size());
    });
  });
  return mapped;
}

// All files or none: what was written before a failure is taken away again.
void write_cells(const fs::path& folder, const std::vector<MappedCell>& mapped) {
  const bool made = make_folder(folder);
  std::vector<fs::path> written;
  try {
    for (const auto& cell : mapped) {
      const auto path = file_of_cell(folder, cell.name);
      scene::write_file_atomically(path, cell.bytes);
      written.push_back(path);
    }
  } catch (...) {
    std::error_code ignored;
    for (const auto& path : written) fs::remove(path, ignored);
    if (made) fs::remove(folder, ignored);
    throw;
  }
}

int run_map(MapRequest request) {
  while (request.out.size() > 1 && request.out.back() == '/') request.out.pop_back();  // "cells/" is the folder "cells"
  const Wanted refined = wanted(request);
  auto options = request.method.to_reference();
  if (request.cell.empty() == request.cells.empty()) {
    throw Error(ErrorCode::bad_argument, "give one of --cell and --cells (see `clues map --help`)");
  }
  const bool many = !request.cells.empty();
  if (!request.out.empty() && !(many && fs::is_directory(request.out))) require_writable_parent(request.out);
  if (request.with_map && !many && wants_plain_list(request.out)) {
    throw Error(ErrorCode::bad_argument,
                request.out + ": a plain list cannot hold --map; name the output *.clues.json");
  }
  const auto mesh = scene::read_mesh(request.scene);
  const auto cells = many ? scene::parse_cells(request.cells) : std::vector{scene::parse_cell(request.cell)};
  const auto mapped = map_all(mesh, scene::sha256_of_file(request.scene), cells, options, refined, request);

  if (!request.out.empty()) {
    if (many) {
      write_cells(request.out, mapped);
    } else {
      scene::write_file_atomically(request.out, mapped[0].bytes);
    }
  } else if (request.json) {
    std::string text = many ? "[\n" : "";
    for (std::size_t i = 0; i < mapped.size(); ++i) text += (i ? ",\n" : "") + mapped[i].bytes;
    std::fputs((text + (many ? "]\n" : "")).c_str(), stdout);
    return fine;
  }
  std::string table = table_head;
  for (const auto& cell : mapped) table += cell.summary;
  std::fputs(table.c_str(), request.json ? stderr : stdout);
  return fine;
}

}  // namespace

void add_map_command(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("map", "Compute the exact first-order visibility map of a scene for a view cell");
  auto request = std::make_shared<MapRequest>();
  command->add_option("SCENE", request->scene, "The scene: OBJ, OFF, PLY or STL")->required();
  command->add_option("--cell", request->cell, "One view cell")->type_name("SPEC");
  command->add_option("--cells", request->cells, "Many view cells: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1")
      ->type_name("SPEC");
  request->method.add_to(*command);
  request->refine.add_to(*command);
  command->add_flag("--map", request->with_map,
                    "Put the regions, segments and wedges into the result too, in exact coordinates");
  command->add_flag("--json", request->json, "Without -o: print the result itself instead of a table");
  command
      ->add_option(
          "-o,--out", request->out,
          "Where the result goes: a file (*.pvs and *.txt: a plain list of ids), or with --cells a folder that\n"
          "gets one file per cell")
      ->type_name("OUT");
  command->footer(
      std::string("DESCRIPTION\n"
                  "  Lists the triangles of which some point may be seen from some point of the cell. No visible "
                  "triangle is ever\n"
                  "  left out; the answer may hold some that only look visible to the method (first-order). Refinement "
                  "takes out\n"
                  "  more of these, at a cost; clues precision says how many may be left.\n"
                  "  A table counts the triangles whose sides facing the cell are seen wholly, partly, or not at all.\n"
                  "  The same input gives the same bytes, whatever --threads says. An existing OUT is replaced as a "
                  "whole, or,\n"
                  "  when anything fails, not at all.\n\n") +
      cell_help +
      "\n  grid:NXxNYxNZ:box:...   (--cells) the box cut into NX*NY*NZ equal boxes\n\n"
      "EXAMPLES\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --map -o town.clues.json\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --method backprojected --max-depth 2\n"
      "  clues map town.obj --cells grid:4x4x1:box:0,0,1,8,8,2 -o cells/\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_map(*request); });
}

}  // namespace clues::app
