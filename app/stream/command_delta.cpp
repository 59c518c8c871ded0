// clues delta: what changes from one cell to the next (D24); clues delta check: is that right?
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "app/json_output.h"
#include "app/progress.h"
#include "app/stream/command_contours.h"
#include "app/stream/command_decode.h"
#include "app/stream/command_detail.h"
#include "app/stream/command_lists.h"
#include "reference/delta/delta.h"
#include "reference/streams/area_worth.h"
#include "scene/cell_spec.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "validate/stream/judge_delta.h"
#include "validate/verdicts/area.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct DeltaRequest {
  std::string scene, from, to, out;
  bool fragments = false;
  JsonOutput json;
  MethodOptions method;
};

struct DeltaCheckRequest {
  std::string scene, delta, from_map, to_map, back;
};

void require_given(const std::string& value, const char* what) {
  if (value.empty()) throw Error(ErrorCode::bad_argument, fmt::format("{} is required (see --help)", what));
}

std::string table_of(const reference::Delta& delta, const scene::TriangleMesh& mesh) {
  double exposed = 0, occluded = 0;
  for (const reference::UnifiedRegion& r : delta.regions) {
    const double area = validate::area_estimate(mesh, r.side.triangle) * CGAL::to_double(r.area_fraction);
    if (r.seen == reference::SeenFrom::to) exposed += area;
    if (r.seen == reference::SeenFrom::from) occluded += area;
  }
  return fmt::format(
      "  from      to  packet +  packet -  newly visible area  newly hidden area  fallbacks\n"
      "{:>6}  {:>6}  {:>8}  {:>8}  {:>18.6g}  {:>17.6g}  {:>9}\n",
      delta.visible_from.size(), delta.visible_to.size(), delta.packets.plus.size(), delta.packets.minus.size(),
      exposed, occluded, delta.fallbacks);
}

// EDV and EDO of the two packets (area_worth.h).
std::string worth_table_of(const reference::Delta& delta, const scene::TriangleMesh& mesh) {
  const reference::AreaWorth worth(mesh);
  std::string text = "packet  triangles  bytes  area of triangles     a byte  area of regions     a byte\n";
  const auto row = [&](char sign, const std::vector<std::uint32_t>& ids, reference::SeenFrom seen,
                       std::uint64_t bytes) {
    const auto estimate = [](const std::optional<exact::FT>& area) {
      return area ? CGAL::to_double(*area) : std::numeric_limits<double>::infinity();
    };
    const double whole = estimate(worth.area_of(ids)), parts = estimate(worth.area_of(delta, seen));
    const auto a_byte = [&](double area) {
      return ids.empty() ? std::string("-") : fmt::format("{:.6g}", area / static_cast<double>(bytes));
    };
    text += fmt::format("{:>6}  {:>9}  {:>5}  {:>17.6g}  {:>9}  {:>15.6g}  {:>9}\n", sign, ids.size(),
                        ids.empty() ? 0 : bytes, whole, a_byte(whole), parts, a_byte(parts));
  };
  row('+', delta.packets.plus, reference::SeenFrom::to, worth.bytes_of_plus(delta.packets.plus));
  row('-', delta.packets.minus, reference::SeenFrom::from, worth.bytes_of_minus(delta.packets.minus));
  return text;
}

int run_delta(const DeltaRequest& request) {
  require_given(request.scene, "SCENE");
  require_given(request.from, "--from");
  require_given(request.to, "--to");
  auto options = request.method.to_reference();
  require_writable_parent(request.out);
  require_writable_parent(request.json.file());
  require_apart({&request.out, &request.json.file()}, {&request.scene, &request.from, &request.to});
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto from = scene::parse_cell(request.from), to = scene::parse_cell(request.to);
  reference::Delta delta;
  {
    ProgressBar bar("clues delta");
    options.progress = [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
      bar.show(stage, done, total);
    };
    delta = reference::delta_of(mesh, exact::ConvexCell::from_doubles(from.points),
                                exact::ConvexCell::from_doubles(to.points), options);
  }
  if (!request.out.empty() || request.json.asked()) {
    auto record = validate::record_of(delta, request.fragments);
    record.scene_file = std::filesystem::path(request.scene).filename().string();
    record.scene_sha256 = scene::sha256_of_scene(request.scene);
    record.mode = request.method.mode;
    record.from.cell = from.points;
    record.to.cell = to.points;
    const std::string text = validate::to_json_text(record);
    if (!request.out.empty()) scene::write_file_atomically(request.out, text);
    request.json.write(text);
  }
  if (!request.json.on_stdout()) print(table_of(delta, mesh) + worth_table_of(delta, mesh));
  return fine;
}

// The maps have to be of this scene, in this mode, and of these cells.
void require_map_of(const validate::MapFile& map, const validate::DeltaRecord& delta, std::vector<scene::Point> cell,
                    const std::string& file) {
  if (map.scene_sha256 != delta.scene_sha256)
    throw Error(ErrorCode::bad_argument, file + ": is of another scene than the transition; map that scene");
  if (map.mode != delta.mode)
    throw Error(ErrorCode::bad_argument,
                fmt::format("{}: is in {} mode, the transition in {}", file, map.mode, delta.mode));
  auto points = map.cell;
  std::sort(points.begin(), points.end());
  std::sort(cell.begin(), cell.end());
  if (points != cell) throw Error(ErrorCode::bad_argument, file + ": is of another cell than the transition");
}

int run_delta_check(const DeltaCheckRequest& request) {
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto triangles = mesh.triangles.size();
  const auto delta = validate::read_delta(request.delta, triangles);
  if (delta.scene_sha256 != scene::sha256_of_scene(request.scene))
    throw Error(ErrorCode::bad_argument, request.delta + ": is of another scene than " + request.scene);
  const auto from = validate::read_map_file(request.from_map, triangles);
  const auto to = validate::read_map_file(request.to_map, triangles);
  require_map_of(from, delta, delta.from.cell, request.from_map);
  require_map_of(to, delta, delta.to.cell, request.to_map);
  auto verdict = validate::judge_delta(mesh, delta, from, to);
  if (!request.back.empty()) {
    const auto back = validate::read_delta(request.back, triangles);
    if (back.scene_sha256 != delta.scene_sha256 || back.mode != delta.mode || back.from.cell != delta.to.cell ||
        back.to.cell != delta.from.cell || back.has_fragments != delta.has_fragments) {
      throw Error(ErrorCode::bad_argument, request.back + ": is not the way back of " + request.delta);
    }
    for (const auto& finding : validate::judge_delta(mesh, back, to, from).findings)
      verdict.findings.push_back({"the way back: " + finding.what});
    const auto more = validate::judge_reverse(delta, back);
    verdict.findings.insert(verdict.findings.end(), more.begin(), more.end());
  }
  std::string text;
  for (const auto& finding : verdict.findings) text += "wrong: " + finding.what + "\n";
  if (verdict.findings.empty()) {
    text = "right: the packets are the differences of the two lists";
    text += delta.has_fragments ? fmt::format(", and the fragments of {} sides those of the two maps\n", verdict.sides)
                                : std::string("; it has no fragments\n");
  }
  print(text);
  return verdict.findings.empty() ? fine : findings;
}

void add_delta_check(CLI::App& delta, int& status) {
  auto* command = delta.add_subcommand("check", "Is a transition what the maps of its two cells say?");
  auto request = std::make_shared<DeltaCheckRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--delta", request->delta, "The transition, as `clues delta -o` writes it")
      ->type_name("FILE")
      ->required();
  command->add_option("--from-map", request->from_map, "The map of the first cell, of `clues map --map -o`")
      ->type_name("FILE")
      ->required();
  command->add_option("--to-map", request->to_map, "The map of the second cell")->type_name("FILE")->required();
  command
      ->add_option("--back", request->back,
                   "The transition from the second cell to the first: judged as well, and it must be the reverse")
      ->type_name("FILE");
  command->footer(
      "DESCRIPTION\n"
      "  Reads files only, and uses nothing of the code that made them: borders are compared in plain rationals.\n"
      "  The lists have to be those of the maps, the packets their differences. The fragments have to cover each\n"
      "  side of a triangle once; those seen from a cell have to be what its map calls visible, point for point, of\n"
      "  triangles in its list.\n\n"
      "EXAMPLES\n"
      "  clues map town.obj --cell box:0,0,1,1,2,2 --map -o a.clues.json\n"
      "  clues map town.obj --cell box:1,0,1,2,2,2 --map -o b.clues.json\n"
      "  clues delta town.obj --from box:0,0,1,1,2,2 --to box:1,0,1,2,2,2 --fragments -o ab.delta.json\n"
      "  clues delta check town.obj --delta ab.delta.json --from-map a.clues.json --to-map b.clues.json\n\n"
      "EXIT CODES\n"
      "  0 it is right   1 it is not; a line for each finding   2 bad usage or input");
  command->callback([request, &status] { status = run_delta_check(*request); });
}

}  // namespace

void add_delta_command(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("delta", "What becomes visible and what hidden from one cell to the next");
  auto request = std::make_shared<DeltaRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats);
  command->add_option("--from", request->from, "The cell that the viewer leaves")->type_name("SPEC");
  command->add_option("--to", request->to, "The cell that the viewer enters")->type_name("SPEC");
  request->method.add_to(*command);
  command->add_flag("--fragments", request->fragments,
                    "Put the unified map into the file: every side in fragments seen from neither, from, to or both");
  request->json.add_to(*command, "The transition");
  command->add_option("-o,--out", request->out, "The transition, as JSON (docs/delta.md)")->type_name("FILE");
  command->footer(
      std::string(
          "DESCRIPTION\n"
          "  Maps both cells, and compares what they see: the packet + lists the triangles that only the second "
          "sees,\n"
          "  the packet - those that only the first sees. A triangle in neither may still show other parts: "
          "the areas,\n"
          "  and --fragments, are about parts. All of it is exact; docs/delta.md says what holds of it. The second "
          "table says\n"
          "  what the packets are worth: the area that they keep away from a cell for each byte that they take.\n\n") +
      cell_help +
      "\n\nEXAMPLES\n"
      "  clues delta town.obj --from box:0,0,1,1,2,2 --to box:1,0,1,2,2,2\n"
      "  clues delta town.obj --from box:0,0,1,1,2,2 --to box:1,0,1,2,2,2 --fragments -o ab.delta.json\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 an oracle contradicted itself");
  command->callback([request, command, &status] {
    if (command->get_subcommands().empty()) status = run_delta(*request);
  });
  add_delta_check(*command, status);
  add_delta_contours(*command, status);
  add_delta_detail(*command, status);
  add_delta_decode(*command, status);
  add_delta_lists(*command, status);
}

}  // namespace clues::app
