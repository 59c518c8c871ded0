// clues delta decode: what a cell sees, from a file of contours and the scene (D26); nothing is mapped.
#include "app/stream/command_decode.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/common.h"
#include "fastpath/contours/contour_decoder.h"
#include "reference/contours/contour_code.h"
#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/contour_file.h"
#include "validate/stream/compare_contours.h"
#include "validate/stream/fragments_file.h"
#include "validate/verdicts/area.h"

namespace clues::app {
namespace {

using scene::Error;
using scene::ErrorCode;

struct DecodeRequest {
  std::string scene, contours, out, fragments;
  std::string kernel = "exact";
  std::optional<std::uint32_t> cell;
  bool check = false;
};

std::string table_of(const scene::ContourFile& file) {
  std::string text = fmt::format("{:>6}  {:>6}  {:<12}  {:>8}  {}\n", "cell", "within", "decoded", "bytes", "name");
  for (std::uint32_t c = 0; c < file.cells.size(); ++c) {
    const scene::ContourCell& cell = file.cells[c];
    text += fmt::format("{:>6}  {:>6}  {:<12}  {:>8}  {}\n", c,
                        cell.within == 0 ? std::string("-") : fmt::format("{}", cell.within - 1),
                        cell.exact ? "exact" : "conservative", scene::contour_bytes(file.cells, c).size(), cell.name);
  }
  return text;
}

bool wants_list(const std::string& out) {
  const auto extension = std::filesystem::path(out).extension();
  return extension == ".pvs" || extension == ".txt";
}

// As `clues map -o` writes it, without a map.
std::string result_text(const DecodeRequest& request, const scene::ContourFile& file,
                        std::vector<std::uint32_t> visible) {
  const scene::ContourCell& cell = file.cells[*request.cell];
  if (wants_list(request.out)) return scene::to_pvs_text(visible);
  scene::Result result;
  result.scene_file = std::filesystem::path(request.scene).filename().string();
  result.scene_sha256 = file.scene_sha256;
  result.scene_triangles = file.scene_triangles;
  result.cell = cell.points;
  result.kernel = request.kernel;
  result.mode = file.mode;
  result.visible = std::move(visible);
  result.stats["conservative_fallbacks"] = static_cast<std::int64_t>(cell.fallbacks);
  result.stats["decoded_conservatively"] = cell.exact && request.kernel == "exact" ? 0 : 1;
  return scene::to_json_text(result);
}

std::string fragments_bytes(const DecodeRequest& request, validate::FragmentsRecord record,
                            const scene::ContourFile& file) {
  record.scene_file = std::filesystem::path(request.scene).filename().string();
  record.scene_sha256 = file.scene_sha256;
  return validate::to_bytes_of(record, request.fragments);
}

std::string comparison_text(const validate::ContourComparison& compared, const fastpath::ContourDecoding& decoding) {
  std::string text = fmt::format(
      "doubles hold what is exact on {} sides: {} ends of borders within {:.3g}\n"
      "  triangles {} and {}, area {:.9g} and {:.9g} (exact, doubles)\n"
      "  {} points, {} of them unbounded, at {} the order of directions not told\n",
      compared.sides, compared.ends_checked, compared.radius, compared.exact_list, compared.list, compared.exact_area,
      compared.area, decoding.points, decoding.unbounded, decoding.wild);
  for (const std::string& finding : compared.findings) text += "wrong: " + finding + "\n";
  return text;
}

int run_decode(const DecodeRequest& request) {
  if (request.kernel != "exact" && !request.fragments.empty())
    throw Error(ErrorCode::unsupported, "--fragments: of the exact kernel only; leave out --kernel fast");
  if (!request.cell && (!request.out.empty() || !request.fragments.empty() || request.check))
    throw Error(ErrorCode::bad_argument, "give --cell; without it the cells of the file are listed");
  require_writable_parent(request.out);
  require_writable_parent(request.fragments);
  require_apart({&request.out, &request.fragments}, {&request.scene, &request.contours});
  const auto mesh = scene::read_plain_scene(request.scene);
  const auto file = scene::read_contours(request.contours);
  if (file.scene_sha256 != scene::sha256_of_scene(request.scene) || file.scene_triangles != mesh.triangles.size())
    throw Error(ErrorCode::bad_argument, request.contours + ": is of another scene than " + request.scene);
  if (!request.cell) {
    print(table_of(file));
    return fine;
  }
  if (*request.cell >= file.cells.size())
    throw Error(ErrorCode::index_out_of_range,
                fmt::format("--cell {}: the file has cells 0 to {}; `clues delta decode` "
                            "without --cell lists them",
                            *request.cell, file.cells.size() - 1));
  const scene::ContourCell& cell = file.cells[*request.cell];
  const bool exactly = request.kernel == "exact" || request.check,
             in_doubles = request.kernel == "fast" || request.check;
  const auto sides =
      reference::input_sides(mesh, file.mode == "solid" ? reference::Mode::solid : reference::Mode::sheet);
  std::vector<reference::FlatSet> sets;
  fastpath::ContourDecoding decoding;
  if (exactly) sets = reference::decoded_map(sides, mesh, file, *request.cell);
  if (in_doubles) decoding = fastpath::ContourDecoder(mesh).decode(file, *request.cell);
  auto visible = request.kernel == "exact" ? reference::list_of(sides, sets, cell.besides) : decoding.list;
  std::string text = fmt::format("cell {} ({}), {}: {} of {} triangles are visible\n", *request.cell, cell.name,
                                 !cell.exact                 ? "decoded conservatively"
                                 : request.kernel == "exact" ? "decoded exactly"
                                                             : "decoded in doubles, conservatively",
                                 visible.size(), mesh.triangles.size());
  if (request.check) {
    const auto compared = validate::compare_contours(mesh, file, *request.cell, sides, sets, decoding);
    text += comparison_text(compared, decoding);
    if (!compared.findings.empty()) {  // a list that lacks something replaces none
      print(text);
      return oracle_contradiction;
    }
  }
  if (!request.fragments.empty())
    scene::write_file_atomically(request.fragments,
                                 fragments_bytes(request, validate::fragments_of(mesh, sides, sets), file));
  if (!request.out.empty()) scene::write_file_atomically(request.out, result_text(request, file, std::move(visible)));
  print(text);
  return fine;
}

}  // namespace

void add_delta_decode(CLI::App& delta, int& status) {
  auto* command = delta.add_subcommand("decode", "What a cell sees, from a file of contours");
  auto request = std::make_shared<DecodeRequest>();
  command->add_option("SCENE", request->scene, std::string("The scene: ") + scene::scene_formats)->required();
  command->add_option("--contours", request->contours, "The file, as `clues delta contours -o` writes it")
      ->type_name("FILE")
      ->required();
  command->add_option("--cell", request->cell, "Number of the cell in the file; left out: all cells are listed")
      ->type_name("N")
      ->check(problem_of_count);
  command
      ->add_option("--kernel", request->kernel,
                   "exact (default): region for region what was coded; fast: in doubles, never less than that")
      ->type_name("K")
      ->check(CLI::IsMember({"exact", "fast"}));
  command->add_flag("--check", request->check, "Decode in both ways, and compare: doubles have to hold what is exact");
  command
      ->add_option("--fragments", request->fragments,
                   "The visible regions as a mesh: *.obj, *.ply, *.glb (rounded), else JSON (exact)")
      ->type_name("FILE");
  command->add_option("-o,--out", request->out, "The list: *.pvs, *.txt, else a result as of `clues map`")
      ->type_name("FILE");
  command->footer(
      "DESCRIPTION\n"
      "  Makes the boundaries of the cell's map again from their labels, and floods from its seeds, within the cell\n"
      "  around it, and that within the next (docs/delta.md). The file and the scene are all it needs; nothing is\n"
      "  mapped.\n\n"
      "EXAMPLES\n"
      "  clues delta contours town.obj --parent box:0,0,1,4,4,2 --cells grid:2x2x1:box:0,0,1,4,4,2 -o town.contours\n"
      "  clues delta decode town.obj --contours town.contours\n"
      "  clues delta decode town.obj --contours town.contours --cell 1 -o cell.pvs --fragments cell.obj\n"
      "  clues delta decode town.obj --contours town.contours --cell 1 --kernel fast --check\n\n"
      "EXIT CODES\n"
      "  0 fine   2 bad usage or input   4 doubles have less than is exact");
  command->callback([request, &status] { status = run_decode(*request); });
}

}  // namespace clues::app
