// Options common to the subcommands, and the census of visible, hidden and partly visible triangles.
#include "app/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "exact/area.h"
#include "reference/visibility/map/sides.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"

namespace clues::app {

using scene::Error;
using scene::ErrorCode;

const char* const cell_help = R"(SCENE
  An OBJ, OFF, PLY or STL file. Triangle i is the i-th triangle of the file, from 0; a face with more corners is a fan.

CELL
  box:x0,y0,z0,x1,y1,z1   the closed box between two corners (x0 <= x1, ...); equal bounds make it flat, or a point
  FILE                    an OBJ, OFF, PLY or STL file: the cell is the convex hull of its vertices)";

void MethodOptions::add_to(CLI::App& command, Kernels kernels) {
  command
      .add_option(
          "--mode", mode,
          "sheet: both sides of a triangle can be seen (default). solid: only fronts can; the mesh must be closed\n"
          "and consistently oriented")
      ->type_name("sheet|solid");
  command
      .add_option("--method", method,
                  "first-order (default); clues map also has backprojected, which is --refine backprojection, and\n"
                  "subdivided, which is --refine cell")
      ->type_name("NAME");
  command
      .add_option("--kernel", kernel,
                  kernels == Kernels::both
                      ? "exact (default), or fast: doubles with exact decisions where these do not suffice"
                      : "exact; the fast one is for clues map, bake and iut")
      ->type_name("NAME");
  command
      .add_option("--formulation", formulation,
                  "plain (default): all of the scene at once. traversal: outward from what is visible, without a look "
                  "at what is\n"
                  "hidden behind it. Two ways to one map")
      ->type_name("plain|traversal");
  command.add_option("--threads", threads, "How many threads may work; 0: all cores (default). The answer is the same")
      ->type_name("N");
}

void MethodOptions::check() const {
  if (mode != "sheet" && mode != "solid") {
    throw Error(ErrorCode::bad_argument, "--mode " + mode + ": no such mode; use sheet or solid");
  }
  if (method == "backprojected" || method == "subdivided") {
    throw Error(ErrorCode::unsupported, "--method " + method + " is for clues map; use --method first-order here");
  }
  if (method != "first-order") {
    throw Error(ErrorCode::bad_argument, "--method " + method + ": no such method; use first-order");
  }
  if (kernel != "exact" && kernel != "fast") {
    throw Error(ErrorCode::bad_argument, "--kernel " + kernel + ": no such kernel; use exact or fast");
  }
  if (threads < 0 || threads > 4096) {
    throw Error(ErrorCode::bad_argument, fmt::format("--threads {}: use 0 (all cores) to 4096", threads));
  }
  if (formulation != "plain" && formulation != "traversal") {
    throw Error(ErrorCode::bad_argument,
                "--formulation " + formulation + ": no such formulation; use plain or traversal");
  }
}

reference::Options MethodOptions::to_reference() const {
  check();
  if (kernel == "fast")
    throw Error(ErrorCode::unsupported, "--kernel fast: exact numbers are needed here; use --kernel exact");
  reference::Options options;
  options.formulation = formulation == "traversal" ? reference::Formulation::traversal : reference::Formulation::plain;
  options.mode = mode == "solid" ? reference::Mode::solid : reference::Mode::sheet;
  options.threads = threads;
  return options;
}

void RefineChoice::add_to(CLI::App& command) {
  command
      .add_option("--refine", refine,
                  "How the first-order map is refined. cell: by cutting the cell. backprojection: by cutting it along\n"
                  "the wedges adjusted to what their edges see of it. both: one after the other")
      ->type_name("cell|backprojection|both");
  command
      .add_option("--max-depth", max_depth,
                  "How often a part of the cell may be cut again (default 4); the work may double with each depth")
      ->type_name("N");
  command
      .add_option(
          "--tolerance-area", tolerance_area,
          "Done when no more than this area, in units of the scene, is neither known to be visible nor known to\n"
          "be hidden (default 0)")
      ->type_name("X");
  command.add_flag(
      "--retract", retract,
      "Backprojection: where an adjusted wedge would run into the surface at its own edge, take the plane\n"
      "of a neighbouring edge nearer to the cell. Seldom gains anything");
}

reference::RefineOptions RefineChoice::to_reference() const {
  if (max_depth < 0 || max_depth > 16) {
    throw Error(ErrorCode::bad_argument, fmt::format("--max-depth {}: use 0 to 16", max_depth));
  }
  if (!(tolerance_area >= 0)) {
    throw Error(ErrorCode::bad_argument, fmt::format("--tolerance-area {}: use 0 or more", tolerance_area));
  }
  return {max_depth, tolerance_area, retract};
}

validate::Refinement RefineChoice::refinement(validate::Refinement otherwise) const {
  if (refine.empty()) return otherwise;
  if (refine == "cell") return validate::Refinement::cells;
  if (refine == "backprojection") return validate::Refinement::backprojection;
  if (refine == "both") return validate::Refinement::both;
  throw Error(ErrorCode::bad_argument, "--refine " + refine + ": no such refinement; use cell, backprojection or both");
}

void RefineChoice::check_retract(validate::Refinement wanted) const {
  if (retract && wanted != validate::Refinement::backprojection && wanted != validate::Refinement::both)
    throw Error(ErrorCode::bad_argument, "--retract is about backprojection; add --refine backprojection or both");
}

std::string problem_of_count(const std::string& word) {
  return word.find('-') == std::string::npos ? "" : word + " is below 0";
}

void print(const std::string& text, std::FILE* to) {
  const auto shown = scene::printable_lines(text);
  std::fwrite(shown.data(), 1, shown.size(), to);
}

void require_writable_parent(const std::filesystem::path& path) {
  if (path.empty()) return;
  const auto parent = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::error_code ignored;
  if (!std::filesystem::is_directory(parent, ignored)) {
    throw Error(ErrorCode::file_unwritable, parent.string() + ": no such folder; make it before writing there");
  }
  if (access(parent.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::file_unwritable, parent.string() + ": the folder is not writable; choose another output");
  }
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorCode::file_unwritable, path.string() + ": is a folder; name a file in it");
  }
}

void require_apart(const std::vector<const std::string*>& outputs, const std::vector<const std::string*>& inputs) {
  namespace fs = std::filesystem;
  const auto same = [](const std::string& a, const std::string& b) {
    std::error_code no_a, no_b, ignored;
    const fs::path one = fs::weakly_canonical(fs::absolute(a), no_a),
                   other = fs::weakly_canonical(fs::absolute(b), no_b);
    return (!no_a && !no_b && one == other) || fs::equivalent(a, b, ignored);  // the latter: hard links
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i]->empty()) continue;
    for (const std::string* input : inputs) {
      if (!input->empty() && same(*outputs[i], *input))
        throw Error(ErrorCode::bad_argument, *outputs[i] + ": is read by this command too; name another output");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!outputs[j]->empty() && same(*outputs[i], *outputs[j]))
        throw Error(ErrorCode::bad_argument, *outputs[i] + ": two outputs would go to this file; name two");
    }
  }
}

bool make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const bool made = std::filesystem::create_directory(folder, error);
  if (error || !std::filesystem::is_directory(folder) || access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::file_unwritable,
                folder.string() + ": cannot write into this folder" + (error ? " (" + error.message() + ")" : ""));
  }
  return made;
}

void make_empty_folder(const std::filesystem::path& folder) {
  make_folder(folder);
  if (std::filesystem::is_empty(folder)) return;
  throw Error(ErrorCode::bad_argument,
              folder.string() + ": is not empty; name a new folder, or remove what is in this one");
}

std::string points_text(const std::vector<scene::Point>& points) {
  std::string text;
  for (const auto& p : points) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  return text;
}

Census take_census(const reference::VisibilityMap& map) {
  struct Flags {
    bool visible = false, hidden = false;
  };
  std::vector<Flags> flags(map.complex.input_triangles);
  Census census;
  for (const auto& region : map.regions) {
    const auto& piece = map.complex.pieces[region.piece];
    const bool facing = reference::faces_cell(map.complex, map.cell, region.piece, region.front);
    for (const auto& origin : piece.origins) {
      if (!reference::counts(map.mode, origin, region.front) || (!facing && !region.visible)) continue;
      (region.visible ? flags[origin.triangle].visible : flags[origin.triangle].hidden) = true;
    }
    if (!facing) continue;
    const auto& points = map.complex.points;
    const double area =
        exact::area_estimate(points[piece.corners[0]], points[piece.corners[1]], points[piece.corners[2]]) *
        CGAL::to_double(region.area_fraction);
    census.area_facing_estimate += area;
    if (region.visible) census.area_visible_estimate += area;
  }
  census.triangles.resize(flags.size(), Seen::hidden);
  for (std::uint32_t t = 0; t < flags.size(); ++t) {
    // Listed without a visible region: it meets the cell.
    const bool listed = std::binary_search(map.visible.begin(), map.visible.end(), t);
    auto& seen = census.triangles[t];
    if (listed) seen = flags[t].visible && flags[t].hidden ? Seen::partly : Seen::wholly;
    ++(seen == Seen::wholly ? census.wholly : seen == Seen::partly ? census.partly : census.hidden);
  }
  return census;
}

}  // namespace clues::app
