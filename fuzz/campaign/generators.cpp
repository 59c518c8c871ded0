#include "fuzz/campaign/generators.h"

#include <algorithm>

#include "fuzz/generators/built_scenes.h"
#include "fuzz/generators/degenerate_scenes.h"
#include "fuzz/generators/parts.h"
#include "fuzz/generators/random_scenes.h"
#include "fuzz/generators/touching_scenes.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

Case to_case(const std::string& name, std::uint64_t seed, std::uint64_t index, GeneratedScene scene) {
  return {name, seed, index, std::move(scene.mesh), std::move(scene.cell), scene.solid};
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

constexpr const char* from_meshes = "mesh_pieces";

NamedGenerator dialled(const NamedGenerator& g, std::uint64_t dial) {
  const std::string name = g.name + ":" + std::to_string(dial);
  return {name, g.degeneracy, [g, name, dial](std::uint64_t seed, std::uint64_t index) {
            Case scene = g.make(seed, dials * index + dial);
            scene.generator = name;
            scene.index = index;
            return scene;
          }};
}

}  // namespace

std::vector<NamedGenerator> all_generators(const GivenScenes& given) {
  std::vector<NamedGenerator> all;
  const auto add = [&](const std::string& name, const std::string& what, auto make) {
    all.push_back({name, what, [name, make](std::uint64_t seed, std::uint64_t index) {
                     return to_case(name, seed, index, make(seed, index));
                   }});
  };
  for (const Kind kind : all_kinds) {
    add(name_of(kind), degeneracy_of(kind),
        [kind](std::uint64_t seed, std::uint64_t index) { return generate(kind, seed, index); });
  }
  for (const auto* list : {&degenerate_generators(), &built_generators(), &touching_generators()}) {
    for (const DegenerateGenerator& g : *list) add(g.name, g.what, g.make);
  }
  add("mutations", "the small scenes of --scenes, or random ones, after 1 to 8 changes (dial)",
      [&given](std::uint64_t seed, std::uint64_t index) { return mutations(given.small, seed, index); });
  add(from_meshes, "patches of the meshes of --scenes, scattered, thinned out (dial)",
      [&given](std::uint64_t seed, std::uint64_t index) { return mesh_pieces(given.meshes, seed, index); });
  return all;
}

std::vector<NamedGenerator> generators_named(const std::vector<std::string>& names, const GivenScenes& given) {
  const auto all = all_generators(given);
  std::vector<NamedGenerator> chosen;
  for (const auto& g : all) {
    if (names.empty() && (g.name != from_meshes || !given.meshes.empty())) chosen.push_back(g);
  }
  for (const std::string& name : names) {
    const auto colon = name.find(':');
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const auto& g) { return g.name == name.substr(0, colon); });
    const bool dial_is_good =
        colon == name.npos || (name.size() == colon + 2 && name[colon + 1] >= '0' && name[colon + 1] < '0' + dials);
    if (at == all.end() || !dial_is_good)
      throw scene::Error(scene::ErrorCode::bad_argument,
                         "--generator " + name + ": there is none of this name; `clues fuzz --help` lists them");
    if (at->name == from_meshes && given.meshes.empty())
      throw scene::Error(
          scene::ErrorCode::bad_argument,
          "--generator " + name +
              ": cuts up meshes of more than 40 triangles; give some with --scenes, such as those of the Debian "
              "package libcgal-demo");
    chosen.push_back(colon == name.npos ? *at : dialled(*at, static_cast<std::uint64_t>(name[colon + 1] - '0')));
  }
  return chosen;
}

}  // namespace clues::fuzz
