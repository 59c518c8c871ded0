// The files of maps of surfaces: hierarchies, which are judged as well, proofs of remeshes, features, maps of other programs. Which of them the bytes are
// is for their first line to say.
#include <algorithm>
#include <cmath>

#include "fuzz/targets/promises.h"
#include "scene/files/atomic_file.h"
#include "scene/files/temporary_folder.h"
#include "scene/multires/feature_file.h"
#include "scene/multires/hierarchy_file.h"
#include "scene/multires/remesh_proof.h"
#include "validate/multires/check_hierarchy.h"

namespace clues::fuzz {
namespace {

// The mesh that a proof without its mesh is held against.
constexpr std::size_t vertices_of_input = 64, triangles_of_input = 64;

void hierarchy(std::string_view bytes) {
  const auto read = scene::parse_hierarchy(bytes, "file");
  require(read.points.size() >= read.input.points.size(), "vertices of the input are the first points");
  for (const auto& p : read.input.points) {
    for (const double x : p) require(std::isfinite(x), "coordinates are finite");
  }
  const std::string text = scene::to_text(read);
  const auto again = scene::parse_hierarchy(text, "again");
  require(scene::to_text(again) == text, "a hierarchy survives being written");
  require(validate::check_hierarchy(read).counts == validate::check_hierarchy(again).counts,
          "a hierarchy that survives is judged alike");
}

void proof(std::string_view bytes) {
  const auto read = scene::parse_remesh_proof(bytes, "file", vertices_of_input, triangles_of_input);
  require(read.to_remesh >= 0 && read.to_input >= 0, "a bound is a distance");
  require(read.near.size() == read.pieces.size(), "every piece is near to a triangle");
  const std::string text = scene::to_text(read);
  require(scene::to_text(scene::parse_remesh_proof(text, "again", vertices_of_input, triangles_of_input)) == text,
          "a proof survives being written");
}

// Lines of numbers may be features, a map of another program, both or neither.
bool numbers(std::string_view bytes) {
  const scene::TemporaryFolder folder;
  const auto file = folder.file("file");
  scene::write_file_atomically(file, bytes);
  const bool features = accepted([&] {
    const auto read = scene::read_features(file);
    const auto named = [](std::uint32_t v) { return v != scene::no_vertex; };
    require(std::all_of(read.vertices.begin(), read.vertices.end(), named), "a vertex has a number");
    require(
        std::all_of(read.edges.begin(), read.edges.end(), [&](const auto& e) { return named(e[0]) && named(e[1]); }),
        "an edge has two vertices");
  });
  const bool map = accepted([&] {
    for (const auto& line : scene::read_plain_map(file)) {
      require(line.triangle != scene::no_vertex, "a line names a triangle");
      require(!line.weights[0].empty() && !line.weights[1].empty(), "a line has two coordinates or three");
    }
  });
  return features || map;
}

}  // namespace

bool map_files(std::string_view bytes) {
  if (scene::is_hierarchy_text(bytes)) return accepted([&] { hierarchy(bytes); });
  if (bytes.starts_with("clues-remesh")) return accepted([&] { proof(bytes); });
  return numbers(bytes);
}

}  // namespace clues::fuzz
