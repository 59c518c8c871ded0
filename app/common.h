// What the subcommands share: common options, output checks, and the count of what is seen.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/visibility/first_order.h"
#include "reference/visibility/refinement/subdivision.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "validate/verdicts/precision.h"

namespace clues::app {

// Options that steer the reference; the same on every subcommand.
struct MethodOptions {
  std::string mode = "sheet";
  std::string method = "first-order";
  std::string kernel = "exact";
  std::string formulation = "plain";
  int threads = 0;

  enum class Kernels : std::uint8_t { exact, both };  // that the command has
  void add_to(CLI::App& command, Kernels kernels = Kernels::exact);
  void check() const;                       // throws Error bad_argument, unsupported
  reference::Options to_reference() const;  // the same; unsupported for the fast kernel
};

// How far a map is refined (D20, D21): on `map` and `precision`.
struct RefineChoice {
  std::string refine;  // "cell", "backprojection", "both"; empty: the command's default
  int max_depth = 4;
  double tolerance_area = 0;
  bool retract = false;

  void add_to(CLI::App& command);
  reference::RefineOptions to_reference() const;                          // throws Error bad_argument
  validate::Refinement refinement(validate::Refinement otherwise) const;  // throws Error bad_argument
  void check_retract(validate::Refinement wanted) const;                  // throws Error bad_argument
};

// The two paragraphs about SPEC and exit codes that every footer needs.
extern const char* const cell_help;

// A check of an option whose number is unsigned: CLI11 takes -1 for the largest number of 64 digits. "", or what is wrong.
std::string problem_of_count(const std::string& word);

// Text for a person: with nothing in it that a terminal would obey, wherever it came from (scene/messages/printable.h).
void print(const std::string& text, std::FILE* to = stdout);

// Throws Error file_unwritable now, and not after an hour, when a file could not be made at `path`. No path: fine.
void require_writable_parent(const std::filesystem::path& path);

// Throws Error bad_argument when an output is one of the inputs, or another output, under whatever name. Empty names, and what is no file, are passed over.
void require_apart(const std::vector<const std::string*>& outputs, const std::vector<const std::string*>& inputs);

// The SHA-256 of the file, which read() reads in between; throws Error file_unreadable where it has another one afterwards, so that a result never names a scene that it is not of.
template <class Read>
std::string sha256_around(const std::filesystem::path& file, const Read& read) {
  const auto sha256 = scene::sha256_of_scene(file);
  read();
  if (scene::sha256_of_scene(file) != sha256)
    throw scene::Error(scene::ErrorCode::file_unreadable,
                       file.string() + ": changes while it is read; wait until it is written");
  return sha256;
}

// Makes the folder where it does not exist (its parent must); throws Error file_unwritable. Returns whether it was made.
bool make_folder(const std::filesystem::path& folder);
// The same; throws Error bad_argument where something lies in it.
void make_empty_folder(const std::filesystem::path& folder);

// Vertices of an OBJ file, one a line, as short as they come back bit for bit.
std::string points_text(const std::vector<scene::Point>& points);

// Input triangles by what the cell sees of their sides that face it. Triangles meeting the cell are visible (D3).
enum class Seen : std::uint8_t { hidden, partly, wholly };
struct Census {
  std::vector<Seen> triangles;
  std::uint64_t wholly = 0, partly = 0, hidden = 0;
  double area_facing_estimate = 0, area_visible_estimate = 0;  // of sides that face the cell
};
Census take_census(const reference::VisibilityMap& map);

}  // namespace clues::app
