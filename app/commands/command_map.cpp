// clues map: scene and cell in, exact visibility map out.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/map/cell_folder.h"
#include "app/map/cell_mapper.h"
#include "app/progress.h"
#include "exact/threads.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/levels/bsp_scene.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

// --method backprojected is short for --refine backprojection, --method subdivided for --refine cell; with the other of them both are wanted.
validate::Refinement wanted_refinement(const MapRequest& request) {
  const auto refinement = request.refine.refinement(validate::Refinement::none);
  const std::string& method = request.method.method;
  if (method != "backprojected" && method != "subdivided") return refinement;
  const auto wanted = method == "subdivided" ? validate::Refinement::cells : validate::Refinement::backprojection;
  return refinement == validate::Refinement::none || refinement == wanted ? wanted : validate::Refinement::both;
}

nlohmann::json json_of(const std::optional<double>& x) { return x ? nlohmann::json(*x) : nlohmann::json(); }

// Everything that the results depend on.
std::string request_text(const MapRequest& request, const std::string& sha256) {
  return nlohmann::json{{"format", "clues-cells/2"},
                        {"scene_sha256", sha256},
                        {"cells", request.cells},
                        {"mode", request.method.mode},
                        {"method", request.asked_method},
                        {"refine", request.refine.refine},
                        {"max_depth", request.refine.max_depth},
                        {"tolerance_area", request.refine.tolerance_area},
                        {"min_occlusion", json_of(request.simplify.min_occlusion)},
                        {"simplify_boundaries", json_of(request.simplify.simplify_boundaries)},
                        {"intersect_planes", json_of(request.simplify.intersect_planes)},
                        {"retract", request.refine.retract},
                        {"kernel", request.method.kernel},
                        {"map", request.with_map},
                        {"render_states", request.with_states},
                        {"formulation", request.method.formulation}}
             .dump(2) +
         "\n";
}

// Maps the cells, each by one thread so that none waits for another, and gives each result to `finished` at once, one at a time.
template <class Finished>
void map_many(const CellMapper& mapper, const std::vector<scene::CellSpec>& cells,
              const std::vector<std::size_t>& wanted, int threads, const Finished& finished) {
  ProgressBar bar("clues map");
  bar.show("cells", cells.size() - wanted.size(), cells.size());
  std::mutex mutex;
  std::size_t done = cells.size() - wanted.size();
  exact::by_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
      MappedCell mapped = mapper.map(cells[wanted[i]], 1, {});
      const std::lock_guard lock(mutex);
      finished(wanted[i], std::move(mapped));
      bar.show("cells", ++done, cells.size());
    });
  });
}

// With a folder to write to: results go there as they are finished, and what is there already is not made again.
std::vector<MappedCell> map_into_folder(const CellMapper& mapper, const std::string& sha256,
                                        const std::vector<scene::CellSpec>& cells, const MapRequest& request) {
  const CellFolder folder(request.out, request_text(request, sha256), cells, request.resume);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!folder.has(cells[i])) wanted.push_back(i);
  }
  std::vector<MappedCell> mapped(cells.size());
  std::size_t kept = cells.size() - wanted.size();
  if (kept > 0) {
    std::fputs(fmt::format("clues map: {} of {} cells were there already\n", kept, cells.size()).c_str(), stderr);
  }
  try {
    map_many(mapper, cells, wanted, request.method.threads, [&](std::size_t i, MappedCell&& cell) {
      folder.put(cells[i], cell.json);
      ++kept;
      mapped[i].summary = std::move(cell.summary);
    });
  } catch (...) {
    if (kept > 0) {
      std::fputs(fmt::format("clues map: {} of {} cells are finished; the same command with --resume goes on\n", kept,
                             cells.size())
                     .c_str(),
                 stderr);
    }
    throw;
  }
  return mapped;
}

std::vector<MappedCell> map_cells(const CellMapper& mapper, const std::string& sha256,
                                  const std::vector<scene::CellSpec>& cells, const MapRequest& request) {
  std::vector<MappedCell> mapped(cells.size());
  if (request.cells.empty()) {
    ProgressBar bar("clues map");
    const auto show = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
      bar.show(stage, done, total);
    };
    mapped[0] = mapper.map(cells[0], request.method.threads, show);
    return mapped;
  }
  if (!request.out.empty()) return map_into_folder(mapper, sha256, cells, request);
  std::vector<std::size_t> all(cells.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  map_many(mapper, cells, all, request.method.threads,
           [&](std::size_t i, MappedCell&& cell) { mapped[i] = std::move(cell); });
  return mapped;
}

int run_map(MapRequest request) {
  while (request.out.size() > 1 && request.out.back() == '/') request.out.pop_back();  // "cells/" is the folder "cells"
  request.refinement = wanted_refinement(request);
  request.refine.to_reference();  // complains of bad numbers now
  request.simplify.check();
  request.refine.check_retract(request.refinement);
  request.asked_method = request.method.method;
  if (request.method.method == "backprojected" || request.method.method == "subdivided")
    request.method.method = "first-order";  // refined afterwards
  request.method.check();
  if (request.refinement != validate::Refinement::none && !request.umbra.file.empty()) {
    throw Error(ErrorCode::unsupported, "--umbra is for first-order maps; leave out --refine and --method");
  }
  if (request.simplify.asked() && !request.umbra.file.empty()) {
    throw Error(ErrorCode::unsupported,
                "--umbra is of the whole hidden space; leave out --min-occlusion, --simplify-boundaries and "
                "--intersect-planes");
  }
  if (request.simplify.intersect_planes && request.refinement != validate::Refinement::none) {
    throw Error(ErrorCode::unsupported,
                "--intersect-planes needs the wedges of a first-order map; leave out --refine and --method");
  }
  if (request.cell.empty() == request.cells.empty()) {
    throw Error(ErrorCode::bad_argument, "give one of --cell and --cells (see `clues map --help`)");
  }
  const bool many = !request.cells.empty();
  if (request.resume && (!many || request.out.empty())) {
    throw Error(ErrorCode::bad_argument, "--resume goes on with a folder of results: it needs --cells and -o");
  }
  if (many && !request.out.empty() && request.json.asked()) {
    throw Error(ErrorCode::bad_argument,
                "--json with --cells and -o: each cell has its file in the folder already; leave out one of them");
  }
  if (request.with_states && !request.with_map)
    throw Error(ErrorCode::bad_argument, "--render-states are put into the regions of --map; give that too");
  require_good(request.umbra, many);
  if (!request.fragments.empty()) {
    if (many) throw Error(ErrorCode::bad_argument, "--fragments is for one cell: use --cell, not --cells");
    const auto extension = fs::path(request.fragments).extension();
    if (extension != ".json" && extension != ".obj" && extension != ".ply" && extension != ".glb")
      throw Error(ErrorCode::bad_argument,
                  request.fragments + ": fragments are written as *.json, *.obj, *.ply or *.glb");
    require_writable_parent(request.fragments);
  }
  if (!(many && fs::is_directory(request.out))) require_writable_parent(request.out);
  if (request.with_map && !many && wants_plain_list(request.out)) {
    throw Error(ErrorCode::bad_argument,
                request.out + ": a plain list cannot hold --map; name the output *.clues.json");
  }
  if (!request.overlap_graph.empty()) {
    if (many) throw Error(ErrorCode::bad_argument, "--overlap-graph is for one cell; use --cell");
    require_writable_parent(request.overlap_graph);
  }
  require_writable_parent(request.json.file());
  require_apart({&request.out, &request.json.file(), &request.umbra.file, &request.fragments, &request.overlap_graph},
                {&request.scene, &request.cell, &request.cells});
  scene::FlaggedMesh scene;
  const std::string sha256 = sha256_around(request.scene, [&] {
    if (const auto level = scene::read_level(request.scene)) {
      auto of_level = scene::scene_of_level(*level);
      request.covered_sides = of_level.covered_sides;
      scene = std::move(of_level.scene);
    } else {
      scene = scene::read_scene(request.scene);
    }
  });
  const auto cells = many ? scene::parse_cells(request.cells) : std::vector{scene::parse_cell(request.cell)};
  const auto mapper = !scene.is_plain()                 ? see_through_mapper(scene, sha256, request)
                      : request.method.kernel == "fast" ? fast_mapper(scene.mesh, sha256, request)
                                                        : exact_mapper(scene.mesh, sha256, request);
  const auto mapped = map_cells(*mapper, sha256, cells, request);

  if (!request.umbra.file.empty()) scene::write_file_atomically(request.umbra.file, mapped[0].umbra_bytes);
  if (!request.fragments.empty()) scene::write_file_atomically(request.fragments, mapped[0].fragments_bytes);
  if (!request.overlap_graph.empty()) scene::write_file_atomically(request.overlap_graph, mapped[0].overlap_graph);
  if (!request.out.empty() && !many)
    scene::write_file_atomically(request.out, wants_plain_list(request.out) ? mapped[0].list : mapped[0].json);
  if (request.json.asked()) {
    std::string text = many ? "[\n" : "";
    for (std::size_t i = 0; i < mapped.size(); ++i) text += (i ? ",\n" : "") + mapped[i].json;
    request.json.write(text + (many ? "]\n" : ""));
    if (request.json.on_stdout() && request.out.empty()) return fine;
  }
  std::string table = mapper->table_head();
  for (const auto& cell : mapped) table += cell.summary + cell.umbra_summary + cell.fragments_summary;
  std::fputs(table.c_str(), request.json.on_stdout() ? stderr : stdout);
  return fine;
}

}  // namespace

bool wants_plain_list(const fs::path& out) { return out.extension() == ".pvs" || out.extension() == ".txt"; }

void put_result(MappedCell& cell, scene::Result result, const MapRequest& request, const std::string& sha256,
                const std::optional<scene::Simplification>& simplification) {
  result.scene_file = fs::path(request.scene).filename().string();
  result.scene_sha256 = sha256;
  const bool list = request.cells.empty() && wants_plain_list(request.out);
  if (list) cell.list = scene::to_pvs_text(result.visible);
  if ((request.out.empty() || list) && !request.json.asked()) return;  // only the list, or the table
  cell.json = simplification ? scene::to_json_text(result, *simplification) : scene::to_json_text(result);
}

void add_map_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("map", "Compute the first-order visibility map of a scene for a view cell");
  auto request = std::make_shared<MapRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--cell", request->cell, "One view cell")->type_name("SPEC");
  command->add_option("--cells", request->cells, "Many view cells: grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1")
      ->type_name("SPEC");
  request->method.add_to(*command, MethodOptions::Kernels::both);
  command
      ->add_option("--overlap-graph", request->overlap_graph,
                   "Write here, for GraphViz, which occluders overlap which as the cell sees them, and the cycles")
      ->type_name("FILE.dot");
  request->refine.add_to(*command);
  request->simplify.add_to(*command);
  command->add_flag("--map", request->with_map,
                    "Put the regions, segments and wedges into the result too, in exact coordinates");
  command->add_flag("--render-states", request->with_states,
                    "With --map: say of each visible region which tests a renderer may leave out (docs/formats.md)");
  request->json.add_to(*command, "The result itself");
  command
      ->add_option(
          "-o,--out", request->out,
          "Where the result goes: a file (*.pvs and *.txt: a plain list of ids), or with --cells a folder that\n"
          "gets one file per cell")
      ->type_name("OUT");
  request->umbra.add_to(*command);
  command
      ->add_option("--fragments", request->fragments,
                   "With --cell: write the visible regions as triangles that share their corners: *.json (exact),\n"
                   "*.obj, *.ply or *.glb (rounded)")
      ->type_name("FILE");
  command->add_flag("--resume", request->resume,
                    "With --cells and -o: go on with a run that was stopped; cells whose files are there are not made "
                    "again");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Lists the triangles of which some point may be seen from some point of the cell. No visible "
          "triangle is ever\n"
          "  left out; the answer may hold some that only look visible to the method (first-order). Refinement "
          "takes out\n"
          "  more of these, at a cost; clues precision says how many may be left.\n"
          "  --simplify-boundaries, --min-occlusion and --intersect-planes give up some of what is hidden, never more, "
          "where\n"
          "  that makes the map smaller, and say how much (docs/precision.md).\n"
          "  A table counts the triangles whose sides facing the cell are seen wholly, partly, or not at all.\n"
          "  The same input gives the same bytes, whatever --threads says. An existing file OUT is replaced "
          "as a whole, or,\n"
          "  when anything fails, not at all. With --cells the file of each cell is written when the cell is "
          "finished.\n\n") +
      cell_help +
      "\n  grid:NXxNYxNZ:box:...   (--cells) the box cut into NX*NY*NZ equal boxes\n\n"
      "SCENES WITH GLASS AND CURVES\n"
      "  In glTF files and levels some triangles do not block (alphaMode BLEND and MASK, curves), and some do not "
      "count "
      "(walls\n"
      "  behind what is drawn). They are listed as they are seen through one another; --map has the regions of all\n"
      "  that count, --umbra the umbra of what blocks (docs/real-levels.md).\n\n"
      "EXAMPLES\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --map -o town.clues.json\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --umbra town.umbra.json\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --map --fragments town.visible.obj\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --formulation traversal --overlap-graph town.dot\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --method backprojected --max-depth 2\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --simplify-boundaries 0.05 --min-occlusion 0.01\n"
      "  clues map town.obj --cell box:0,0,1,2,2,2 --kernel fast --method subdivided --max-depth 3\n"
      "  clues map town.obj --cells grid:4x4x1:box:0,0,1,8,8,2 -o cells/\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   3 the umbra is not closed where a limit was reached   4 an oracle "
      "contradicted "
      "itself");
  command->callback([request, &status] { status = run_map(*request); });
}

}  // namespace clues::app
