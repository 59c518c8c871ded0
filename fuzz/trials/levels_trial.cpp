// Whole levels are too large for the oracles of small scenes: nobody else has a map of them. What the fast kernel lists, less what solids hide, as in a bake, is searched for holes by sight lines alone, each decided exactly, aimed at what
// is not in it and past what is.
#include "fuzz/trials/levels_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "exact/cell/convex_cell.h"
#include "exact/threads.h"
#include "fastpath/solids/find_solids.h"
#include "fuzz/findings/case_random.h"
#include "fuzz/findings/witness_text.h"
#include "fuzz/levels/made_levels.h"
#include "fuzz/trials/denied_sight.h"

namespace clues::fuzz {
namespace {

using Ids = std::vector<std::uint32_t>;

constexpr const char* level_sight_lines = "level-sight-lines";

class LevelsTrial : public Trial {
 public:
  LevelsTrial(std::uint64_t lines, LevelLister lister) : lines_(lines), lister_(std::move(lister)) {}

  const char* what() const override {
    return "lists of cells in whole levels, those of --scenes or made, with flags and hulls (D22)";
  }
  std::vector<NamedGenerator> generators(const GivenScenes& given) const override {
    std::vector<NamedGenerator> all;
    const auto add_generator = [&](const std::string& name, const char* what, auto make) {
      all.push_back({name, what, [name, make](std::uint64_t seed, std::uint64_t index) {
                       SceneInALevel made = make(seed, index);
                       return Case{name,
                                   seed,
                                   index,
                                   std::move(made.scene.mesh),
                                   std::move(made.cell),
                                   false,
                                   {},
                                   std::move(made.scene.blocks),
                                   std::move(made.scene.counts)};
                     }});
    };
    add_generator("rooms", "storeys of rooms with doors, panes and pillars; hulls that do not count", rooms_of_a_level);
    add_generator("streets", "a city with panes, and hulls that do not count", streets_of_a_level);
    add_generator(
        "given_boxes", "boxes in empty space near what is drawn in the scenes of --scenes",
        [&given](std::uint64_t seed, std::uint64_t index) { return box_in_a_level(given.levels, seed, index); });
    if (given.levels.empty()) all.back().missing = "levels (bsp), glTF scenes or meshes";
    add_generator(
        "given_leaves", "the leaves of the levels of --scenes, outer and inner cells (D23)",
        [&given](std::uint64_t seed, std::uint64_t index) { return leaf_of_a_level(given.levels, seed, index); });
    if (std::all_of(given.levels.begin(), given.levels.end(), [](const auto& l) { return l.cells.empty(); }))
      all.back().missing = "levels (bsp)";
    return all;
  }
  bool takes_levels() const override { return true; }
  const std::vector<Check>& checks() const override {
    static const std::vector<Check> all{
        {level_sight_lines,
         "no sight line from the cell shows what its list lacks",
         {"lists searched", "triangles denied", "sight lines through vertices", "sight lines beside edges",
          "sight lines beside edges of what is listed", "sight lines to inner points",
          "sight lines that end on a surface", "panes crossed", "triangles decided in whole numbers"}}};
    return all;
  }
  bool is_a_mesh(const Case&) const override { return true; }

  void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const override {
    if (!is_asked(asked, level_sight_lines)) return;
    const fastpath::SeeThroughScene trees(flagged(scene));
    const Ids list = lister_(trees, scene.cell);
    ++outcome.counters["lists searched"];
    outcome.counters["triangles listed"] += list.size();
    const auto seen = find_denied_sight(trees, scene.cell, list, lines_, random_for(scene, "lines"), outcome);
    if (seen) outcome.findings.push_back(finding_of(scene, *seen));
  }

  // A sight line of a larger scene is one of a smaller, so that it is looked at first: the sight lines of this scene may miss the place.
  std::optional<Finding> found_again(const Finding& finding, const Case& scene) const override {
    if (finding.witness && finding.triangle && *finding.triangle < scene.mesh.triangles.size()) {
      auto witness = to_witness(*finding.witness);
      witness.triangle = *finding.triangle;
      const auto flagged_scene = flagged(scene);
      if (flagged_scene.counting(witness.triangle) &&
          check_flagged_witness(flagged_scene, exact::ConvexCell::from_doubles(scene.cell), witness).valid) {
        const fastpath::SeeThroughScene trees(flagged_scene);
        const Ids list = lister_(trees, scene.cell);
        if (!std::binary_search(list.begin(), list.end(), witness.triangle)) {
          Finding again = finding;
          again.where = scene;
          again.witness = to_text(witness);
          again.explanation = explained(witness.triangle, scene, "a sight line of the larger scene is free here, too");
          return again;
        }
      }
    }
    return Trial::found_again(finding, scene);
  }

 private:
  static Finding finding_of(const Case& scene, const DeniedSight& seen) {
    Finding f;
    f.oracle = level_sight_lines;
    f.verdict = seen.witness ? "hidden/visible" : "hidden/meets-cell";
    f.where = scene;
    f.triangle = seen.triangle;
    if (seen.witness) f.witness = to_text(*seen.witness);
    f.explanation =
        explained(seen.triangle, scene, seen.witness ? "a free sight line (" + seen.aim + ") ends on it" : seen.aim);
    return f;
  }

  static std::string explained(std::uint32_t triangle, const Case& scene, const std::string& why) {
    return fmt::format("triangle {} of {} is not listed: {}", triangle, scene.mesh.triangles.size(), why);
  }

  std::uint64_t lines_;
  LevelLister lister_;
};

}  // namespace

std::unique_ptr<Trial> make_levels_trial(std::uint64_t lines, LevelLister lister) {
  return std::make_unique<LevelsTrial>(lines, std::move(lister));
}
std::unique_ptr<Trial> make_levels_trial(std::uint64_t lines) {
  return make_levels_trial(lines, [](const fastpath::SeeThroughScene& scene, const std::vector<scene::Point>& cell) {
    return exact::by_threads(1, [&] {
      const Ids mapped = fastpath::visible_through(scene, cell, {}).counting(scene.scene());
      const Ids not_hidden = fastpath::solids::not_hidden(scene.scene(), cell);
      Ids both;
      std::set_intersection(mapped.begin(), mapped.end(), not_hidden.begin(), not_hidden.end(),
                            std::back_inserter(both));
      return both;
    });
  });
}

}  // namespace clues::fuzz
