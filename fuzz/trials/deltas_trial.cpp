#include "fuzz/trials/deltas_trial.h"

#include <utility>

#include "exact/cell/cell_plane.h"
#include "exact/cell/direction_cone.h"
#include "fuzz/generators/random_scenes.h"
#include "validate/stream/judge_delta.h"

namespace clues::fuzz {
namespace {

constexpr const char* transition_judged = "transition-judged";
constexpr const char* way_back = "way-back";

std::string first_of(const std::vector<validate::DeltaFinding>& findings) {
  return findings.empty() ? std::string() : findings.front().what;
}

class DeltasTrial : public Trial {
 public:
  explicit DeltasTrial(DeltaMaker delta) : delta_(std::move(delta)) {
    for (const Kind kind : all_kinds) {
      const std::string name = name_of(kind);
      generators_.push_back(
          {name, "as for clues fuzz, where the cell is solid", [name, kind](std::uint64_t seed, std::uint64_t index) {
             GeneratedScene made = generate(kind, seed, index);
             return Case{name, seed, index, std::move(made.mesh), std::move(made.cell), made.solid};
           }});
    }
  }

  const char* what() const override { return "transitions of clues delta from cell to cell (D24)"; }
  std::vector<NamedGenerator> generators(const GivenScenes&) const override { return generators_; }
  const std::vector<Check>& checks() const override {
    static const std::vector<Check> all{
        {transition_judged,
         "lists, packets and regions of a transition are those of the two maps",
         {"transitions judged", "transitions that show something", "transitions that hide something",
          "transitions with packets"}},
        {way_back, "back again, what was newly visible is newly hidden", {"ways back judged"}}};
    return all;
  }
  bool is_a_mesh(const Case&) const override { return true; }

  void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const override {
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    const auto halves = halves_of(cell);
    if (halves.empty()) return;
    judge_between(scene, halves[0], halves[1], asked, outcome);
    if (outcome.findings.empty() && scene.index % 4 == 1) judge_between(scene, cell, halves[0], asked, outcome);
  }

 private:
  void judge_between(const Case& scene, const exact::ConvexCell& a, const exact::ConvexCell& b,
                     const std::vector<std::string>& asked, Outcome& outcome) const {
    reference::Options options;
    options.threads = 1;
    if (scene.solid) options.mode = reference::Mode::solid;
    const auto of_a = map_file_of(reference::first_order_visibility(scene.mesh, a, options)),
               of_b = map_file_of(reference::first_order_visibility(scene.mesh, b, options));
    const auto there = validate::record_of(delta_(scene.mesh, a, b, options), true);
    if (is_asked(asked, transition_judged)) {
      const auto verdict = validate::judge_delta(scene.mesh, there, of_a, of_b);
      ++outcome.counters["transitions judged"];
      outcome.counters["sides compared"] += verdict.sides;
      outcome.counters["transitions that show something"] += sgn(verdict.exposed) != 0 ? 1U : 0U;
      outcome.counters["transitions that hide something"] += sgn(verdict.occluded) != 0 ? 1U : 0U;
      outcome.counters["transitions with packets"] += there.plus.empty() && there.minus.empty() ? 0U : 1U;
      file(scene, transition_judged, first_of(verdict.findings), outcome);
    }
    if (is_asked(asked, way_back)) {
      ++outcome.counters["ways back judged"];
      const auto back = validate::record_of(delta_(scene.mesh, b, a, options), true);
      std::string wrong = first_of(validate::judge_delta(scene.mesh, back, of_b, of_a).findings);
      if (wrong.empty()) wrong = first_of(validate::judge_reverse(there, back));
      file(scene, way_back, wrong, outcome);
    }
  }

  DeltaMaker delta_;
  std::vector<NamedGenerator> generators_;
};

}  // namespace

std::unique_ptr<Trial> make_deltas_trial(DeltaMaker delta) { return std::make_unique<DeltasTrial>(std::move(delta)); }
std::unique_ptr<Trial> make_deltas_trial() { return make_deltas_trial(reference::delta_of); }

std::vector<exact::ConvexCell> halves_of(const exact::ConvexCell& cell) {
  if (cell.dimension() != 3) return {};
  const exact::Plane3 cut(cell.center(), exact::Vector3(1, 0, 0));
  std::vector<exact::ConvexCell> out;
  for (const exact::Plane3& side : {cut, cut.opposite()}) {
    std::vector<exact::Point3> points;
    for (const auto& facet : cell.facets()) {
      for (const auto& p : exact::clipped(exact::corners_of(cell, facet), side)) points.push_back(exact::collapsed(p));
    }
    out.emplace_back(points);
  }
  return out;
}

validate::MapFile map_file_of(const reference::VisibilityMap& map) {
  validate::MapFile file;
  file.visible = map.visible;
  const scene::Result result = reference::to_result(map, {}, true);
  for (const scene::MapRegion& r : result.regions) {
    if (!r.visible) continue;
    validate::MapFileRegion region{r.triangle, r.front, {}};
    for (const auto& ring : r.rings_exact) {
      region.rings.emplace_back();
      for (const auto& p : ring) {
        region.rings.back().push_back({validate::Rational(p[0]), validate::Rational(p[1]), validate::Rational(p[2])});
      }
    }
    file.regions.push_back(std::move(region));
  }
  return file;
}

}  // namespace clues::fuzz
