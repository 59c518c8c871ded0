#include "fuzz/campaign/generators.h"

#include <algorithm>

#include "fuzz/generators/degenerate_scenes.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/error.h"

namespace clues::fuzz {
namespace {

Case to_case(const std::string& name, std::uint64_t seed, std::uint64_t index, GeneratedScene scene) {
  return {name, seed, index, std::move(scene.mesh), std::move(scene.cell)};
}

const char* degeneracy_of(Kind kind) {
  switch (kind) {
    case Kind::loose_triangles:
      return "triangles at random: contours that end everywhere";
    case Kind::tetrahedra:
      return "closed convex solids, apart from each other";
    case Kind::open_sheets:
      return "open sheets with holes, saddles and inside corners";
    case Kind::axis_boxes:
      return "axis-aligned boxes that may touch, axis-aligned cells: coplanar faces, parallel edges";
    case Kind::interpenetrating:
      return "solids and triangles that pierce each other";
    case Kind::nonconvex_solids:
      return "closed solids with notches and reflex edges";
  }
  throw scene::Error(scene::ErrorCode::bad_argument, "unknown kind of random scene");
}

std::vector<NamedGenerator> make_all() {
  std::vector<NamedGenerator> all;
  for (const Kind kind : all_kinds) {
    const std::string name = name_of(kind);
    all.push_back({name, degeneracy_of(kind), [kind, name](std::uint64_t seed, std::uint64_t index) {
                     return to_case(name, seed, index, generate(kind, seed, index));
                   }});
  }
  for (const DegenerateGenerator& g : degenerate_generators()) {
    all.push_back({g.name, g.what, [g](std::uint64_t seed, std::uint64_t index) {
                     return to_case(g.name, seed, index, g.make(seed, index));
                   }});
  }
  return all;
}

}  // namespace

const std::vector<NamedGenerator>& all_generators() {
  static const std::vector<NamedGenerator> all = make_all();
  return all;
}

std::vector<NamedGenerator> generators_named(const std::vector<std::string>& names) {
  const auto& all = all_generators();
  for (const std::string& name : names) {
    if (std::none_of(all.begin(), all.end(), [&](const auto& g) { return g.name == name; }))
      throw scene::Error(scene::ErrorCode::bad_argument,
                         "--generator " + name + ": there is none of this name; `clues fuzz --help` lists them");
  }
  std::vector<NamedGenerator> chosen;
  for (const auto& g : all) {
    if (names.empty() || std::find(names.begin(), names.end(), g.name) != names.end()) chosen.push_back(g);
  }
  return chosen;
}

}  // namespace clues::fuzz
