#include "app/bake/bake_cells.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <utility>

#include "app/bake/auto_cells.h"
#include "scene/cell_spec.h"
#include "scene/formats/file_bytes.h"
#include "scene/formats/number.h"
#include "scene/levels/bsp_scene.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

BakeCells leaves_of(const scene::BspFile& level) {
  BakeCells out;
  std::size_t left_out = 0;
  for (auto& leaf : scene::cells_of_level(level)) {
    if (leaf.outer.empty()) {
      ++left_out;
      continue;
    }
    out.cells.push_back({std::to_string(leaf.leaf), 0, std::move(leaf.outer), std::move(leaf.inner), leaf.cluster});
  }
  out.note = fmt::format("{} leaves with a cluster; {} without interior left out", out.cells.size(), left_out);
  if (out.cells.empty())
    throw Error(ErrorCode::bad_argument, level.name + ": no leaf of this level is a cell; use --cells auto:SIZE");
  return out;
}

BakeCells around_floors(const std::string& text, const scene::FlaggedMesh& scene, char up) {
  const auto colon = text.find(':', 5);
  double size = 0, height = 0;
  const auto size_text = text.substr(5, colon == std::string::npos ? colon : colon - 5);
  const auto height_text = colon == std::string::npos ? size_text : text.substr(colon + 1);
  const auto parsed = [](const std::string& number, double& value) {
    const auto parsed_number = scene::parse_number(number);
    value = parsed_number.value;
    return parsed_number.kind == scene::NumberKind::finite && value > 0;
  };
  if (!parsed(size_text, size) || !parsed(height_text, height))
    throw Error(ErrorCode::bad_argument, "--cells " + text + ": expected auto:SIZE or auto:SIZE:HEIGHT, both above 0");
  auto found = auto_cells(scene, size, height, up);
  BakeCells out;
  out.note = fmt::format(
      "{} of {} boxes of the grid hold a point at most {} above one of {} triangles to walk on; {} steeper triangles "
      "and the air above were left out",
      found.cells.size(), found.boxes, height, found.walkable, found.steep);
  out.cells = std::move(found.cells);
  return out;
}

BakeCells listed_in(const fs::path& file) {
  BakeCells out;
  out.bytes = scene::read_file_bytes(file);
  std::istringstream lines(out.bytes);
  std::set<std::string> names;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    std::string name, spec, more;
    if (!(words >> name)) continue;
    const auto fail = [&](const std::string& what) {
      throw Error(ErrorCode::malformed, fmt::format("{}:{}: {}", file.string(), number, what));
    };
    if (!(words >> spec) || words >> more)
      fail("expected a name and a cell (box:... or a file), without blanks in either");
    if (!names.insert(name).second) fail("the second cell of the name " + name);
    if (!spec.starts_with("box:") && fs::path(spec).is_relative()) spec = (file.parent_path() / spec).string();
    scene::BakePlace cell;
    cell.name = name;
    try {
      cell.points = scene::parse_cell(spec).points;
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}:{}: {}", file.string(), number, error.what()));
    }
    for (const auto& p : cell.points) {
      for (const double x : p) out.bytes += fmt::format(" {:a}", x);  // files that it names may change
    }
    out.cells.push_back(std::move(cell));
  }
  if (out.cells.empty()) throw Error(ErrorCode::malformed, file.string() + ": lists no cell");
  out.note = fmt::format("{} cells listed in {}", out.cells.size(), file.filename().string());
  return out;
}

}  // namespace

const char* const bake_cells_help =
    "CELLS\n"
    "  grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1   the box cut into NX*NY*NZ equal boxes\n"
    "  leaves             the leaves of a level's tree, each in an outer cell with double corners\n"
    "  auto:SIZE[:HEIGHT] boxes of a grid within HEIGHT (default: SIZE) above what blocks and is at most 45 degrees "
    "steep\n"
    "  FILE               a name and a cell (box:... or an OBJ or OFF file beside it) a line; # begins a comment";

BakeCells parse_bake_cells(const std::string& text, const std::string& scene_file, const scene::FlaggedMesh& scene,
                           const std::optional<scene::BspFile>& level, char up) {
  if (text == "leaves") {
    if (!level)
      throw Error(ErrorCode::bad_argument,
                  scene_file + ": has no leaves; only levels (.bsp) have, use --cells auto:SIZE");
    return leaves_of(*level);
  }
  if (text.starts_with("auto:")) return around_floors(text, scene, up);
  if (!text.starts_with("grid:")) return listed_in(text);
  BakeCells out;
  for (auto& cell : scene::parse_cells(text)) out.cells.push_back({cell.name, 0, std::move(cell.points), {}, -1});
  out.note = fmt::format("{} cells of the grid", out.cells.size());
  return out;
}

}  // namespace clues::app
