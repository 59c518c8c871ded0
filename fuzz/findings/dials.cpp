#include "fuzz/findings/dials.h"

#include <algorithm>
#include <cmath>

#include "fuzz/findings/case_random.h"

namespace clues::fuzz {
namespace {

using scene::Point;

std::int64_t value_of(const CaseDials& dials, const std::string& name, std::int64_t otherwise) {
  const auto at = dials.find(name);
  return at == dials.end() ? otherwise : at->second;
}

// Every point times 2^exponent, then moved along x and, the other way, along y; false, and nothing, where a coordinate would round.
bool change_points(Case& scene, int exponent, double offset) {
  Case changed = scene;
  for (auto* points : {&changed.mesh.points, &changed.cell}) {
    for (Point& p : *points) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double before = p[i], by = i == 0 ? offset : i == 1 ? -offset : 0;
        p[i] = std::ldexp(before, exponent) + by;
        if (!std::isfinite(p[i]) || std::ldexp(p[i] - by, -exponent) != before) return false;
      }
    }
  }
  scene = std::move(changed);
  return true;
}

bool turn_scene(Case& scene, const std::string& name, std::int64_t value) {
  return name == "scale" ? change_points(scene, static_cast<int>(value), 0)
                         : change_points(scene, 0, std::ldexp(1, static_cast<int>(value)));
}

}  // namespace

const std::vector<NamedDial>& all_dials() {
  using Of = NamedDial::Of;
  static const std::vector<NamedDial> all{
      {"scale", "coordinates times 2 to this", Of::scene, {-100, -20, -3, 5, 30, 200}},
      {"offset", "the scene moved by 2 to this", Of::scene, {4, 16, 30, 40}},
      {"generation_limit", "wedges of later generations are not built (D17)", Of::engine, {0, 1, 2}, true},
      {"csv_limit", "so many compound silhouette vertices more than edges (D17)", Of::engine, {0, 1, 2, 5, 20}, true},
      {"longest_walk", "legs of a walk (D14)", Of::engine, {0, 1, 2, 4}, true},
      {"first_guess", "the part that is mapped first: nothing (1), everything (2)", Of::engine, {1, 2}},
      {"sight_rays", "rays that look for more of it, and for witnesses", Of::engine, {0, 1, 7}},
      {"batch", "wedges before the next look, failed proofs before the next map", Of::engine, {1, 2}},
      {"threads", "threads of one map", Of::engine, {1, 2}},
      {"traversal", "the reference by its other formulation", Of::engine, {1}},
      {"depth", "of a refinement", Of::engine, {0, 1, 4}},
      {"unsure_doubles", "the double filter of segment queries never knows", Of::engine, {1}},
      {"unsure_intervals", "nor do intervals", Of::engine, {1}},
      {"flat_trees", "box trees cull nothing", Of::engine, {1}}};
  return all;
}

Case with_dials(Case scene, bool of_engines) {
  Random random = random_for(scene, "dials");
  if (random.one_in(2)) return scene;
  for (int n = random.between(1, 3); n > 0; --n) {
    const auto& all = all_dials();
    const NamedDial& dial = all[static_cast<std::size_t>(random.between(0, static_cast<int>(all.size()) - 1))];
    const std::int64_t value =
        dial.values[static_cast<std::size_t>(random.between(0, static_cast<int>(dial.values.size()) - 1))];
    if (scene.dials.contains(dial.name)) continue;
    if (dial.of == NamedDial::Of::engine ? of_engines : turn_scene(scene, dial.name, value))
      scene.dials[dial.name] = value;
  }
  return scene;
}

bool is_a_setting(const std::string& name, std::int64_t value) {
  const auto& all = all_dials();
  return std::any_of(all.begin(), all.end(), [&](const NamedDial& d) {
    return d.name == name && std::find(d.values.begin(), d.values.end(), value) != d.values.end();
  });
}

bool is_limited(const CaseDials& dials) {
  return std::any_of(all_dials().begin(), all_dials().end(),
                     [&](const NamedDial& d) { return d.limits && dials.contains(d.name); });
}

exact::Dials map_dials(const CaseDials& dials) {
  exact::Dials out;
  out.generation_limit = static_cast<int>(value_of(dials, "generation_limit", out.generation_limit));
  out.csv_limit = static_cast<std::size_t>(value_of(dials, "csv_limit", static_cast<std::int64_t>(out.csv_limit)));
  out.longest_walk = value_of(dials, "longest_walk", out.longest_walk);
  out.first_guess =
      static_cast<exact::Dials::FirstGuess>(value_of(dials, "first_guess", static_cast<std::int64_t>(out.first_guess)));
  out.sight_rays = value_of(dials, "sight_rays", out.sight_rays);
  out.batch = static_cast<std::size_t>(value_of(dials, "batch", static_cast<std::int64_t>(out.batch)));
  out.threads = static_cast<int>(value_of(dials, "threads", out.threads));
  return out;
}

exact::ProcessDials process_dials(const CaseDials& dials) {
  exact::ProcessDials out;
  out.unsure_doubles = value_of(dials, "unsure_doubles", 0) != 0;
  out.unsure_intervals = value_of(dials, "unsure_intervals", 0) != 0;
  out.flat_trees = value_of(dials, "flat_trees", 0) != 0;
  return out;
}

int refinement_depth(const CaseDials& dials, int otherwise) {
  return static_cast<int>(value_of(dials, "depth", otherwise));
}

bool by_traversal(const CaseDials& dials) { return value_of(dials, "traversal", 0) != 0; }

}  // namespace clues::fuzz
