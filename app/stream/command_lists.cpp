// clues delta lists: the lists of a bake within those of larger cells (FIG. 52), each said as takes the fewest bytes.
#include "app/stream/command_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/stream/number_between.h"
#include "app/stream/served_cells.h"
#include "reference/delta/delta.h"
#include "reference/streams/list_store.h"
#include "scene/bakes/packed_list.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/list_file.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;
using scene::ListRecord;

struct ListsRequest {
  std::string scene, bake, out;
  std::vector<std::size_t> levels;
  double give_up = 0;
};

constexpr std::array<const char*, ListRecord::kinds> names{"list", "all",     "goes", "contour",
                                                           "same", "changed", "delta"};

reference::ListStoreOptions options_of(const ListsRequest& request) {
  reference::ListStoreOptions options{request.levels, exact::FT(request.give_up)};
  auto& levels = options.levels;
  std::sort(levels.rbegin(), levels.rend());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return options;
}

scene::ListFile file_of(const ServedCells& served) {
  scene::ListFile file;
  file.scene_sha256 = served.header.scene_sha256;
  file.scene_triangles = served.header.scene_triangles;
  file.question = served.header.cells;
  for (std::size_t c = 0; c < served.cells.size(); ++c) {
    const auto& points = served.cells[c].points;
    file.cells.push_back({served.cells[c].name, points, {}});
    if (served.inner[c] != points) file.cells.back().inner = served.inner[c];
  }
  return file;
}

// One line for each level.
std::string table_of(const scene::ListFile& file, const std::vector<std::size_t>& levels) {
  std::string text = fmt::format("{:>9} {:>7} {:>9}", "cells", "places", "bytes");
  for (const char* name : names) text += fmt::format(" {:>8}", name);
  text += "\n";
  for (std::size_t i = 0; i < file.levels.size(); ++i) {
    std::array<std::uint64_t, ListRecord::kinds> counts{};
    std::uint64_t bytes = 0;
    const auto& places = file.levels[i];
    for (std::uint32_t n = 0; n < places.size(); ++n) {
      ++counts[static_cast<std::size_t>(places[n].record.kind)];
      bytes += scene::record_bytes(places[n].record, n).size();
    }
    const std::string joined = i < levels.size() ? fmt::format("up to {}", std::uint64_t{1} << levels[i]) : "1";
    text += fmt::format("{:>9} {:>7} {:>9}", joined, places.size(), bytes);
    for (const std::uint64_t n : counts) text += fmt::format(" {:>8}", n);
    text += "\n";
  }
  return text;
}

int run_lists(const ListsRequest& request) {
  require_writable_parent(request.out);
  require_apart({&request.out}, {&request.scene, &request.bake});
  const ServedCells served = served_cells({request.scene, {}, request.bake, {}});
  const reference::EdgeUsers edges(served.scene.mesh);
  const reference::AreaWorth worth(served.scene.mesh);
  const auto options = options_of(request);
  const auto tree =
      options.levels.empty() ? reference::CellTree{} : reference::cell_tree(served.cells, options.levels.front());
  scene::ListFile file = file_of(served);
  file.levels = reference::made_levels(edges, worth, served.lists, tree, options);
  const std::string bytes = scene::to_bytes(file);
  const auto decoded = reference::decoded_levels(edges, scene::parse_lists(bytes, request.out).levels).back();

  const auto triangles = static_cast<std::uint32_t>(served.scene.mesh.triangles.size());
  std::uint64_t packed = 0, differences = 0, given_up = 0;
  for (std::size_t c = 0; c < decoded.size(); ++c) {
    const auto packets = reference::packets_of(served.lists[c], decoded[c]);
    if (!packets.minus.empty() || (request.give_up == 0 && !packets.plus.empty()))
      throw Error(ErrorCode::internal, fmt::format("cell {}: decoding gave another list", c));
    packed += scene::packed_list(served.lists[c], triangles).size();
    differences += scene::record_bytes({ListRecord::Kind::list, 0, served.lists[c], {}}, 0).size();
    given_up += packets.plus.size();
  }
  std::string text = table_of(file, options.levels);
  scene::write_file_atomically(request.out, bytes);
  text += fmt::format("{}: {} cells in {} bytes; their lists alone take {} packed by zstd, {} as differences of ids\n",
                      request.out, file.cells.size(), bytes.size(), packed, differences);
  if (request.give_up > 0)
    text += fmt::format("given up: lists have {} triangles more, of an area of {:.6g}\n", given_up,
                        area_given_up(worth, served.lists, decoded));
  print(text);
  return fine;
}

}  // namespace

void add_delta_lists(CLI::App& delta, int& status) {
  auto* command = delta.add_subcommand("lists", "The lists of a bake within those of larger cells");
  auto request = std::make_shared<ListsRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--bake", request->bake, "The cells and lists of `clues bake` of this scene")
      ->type_name("FILE")
      ->required();
  command->add_option("-o,--out", request->out, "The file of lists, for --lists of `clues walk` and `clues serve`")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--hierarchy", request->levels,
                   "Store nodes of up to 2^N cells above the cells; several N: several levels (default: none)")
      ->type_name("N ...")
      ->check(CLI::Range(1, 16));
  command
      ->add_option("--give-up", request->give_up,
                   "Let a cell list more where it saves bytes: at most this area for each byte (default: 0)")
      ->type_name("AREA")
      ->check(number_between(0, 1e300));
  command->footer(
      "DESCRIPTION\n"
      "  Writes the lists of all cells of a bake into one file. Those of nodes are stored, and what a cell lists is "
      "said\n"
      "  within its node's: what goes, or as a contour of what stays, or by what it has other than a sibling; "
      "whichever\n"
      "  takes the fewest bytes (docs/delta.md). The table says how many were said in which way. The file is decoded\n"
      "  again and compared. With --give-up a cell may list more, never less: all that its node does, or what a "
      "sibling\n"
      "  lists.\n\n"
      "EXAMPLES\n"
      "  clues bake town.obj --cells grid:4x4x1:box:0,0,1,4,4,2 -o town.bake\n"
      "  clues delta lists town.obj --bake town.bake --hierarchy 2 -o town.lists\n"
      "  clues walk town.obj --lists town.lists --steps 10 --hierarchy 2\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, &status] { status = run_lists(*request); });
}

}  // namespace clues::app
