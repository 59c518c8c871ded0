#include "fuzz/trials/maps_trial.h"

#include <fmt/format.h>

#include <utility>

#include "fastpath/multires/build.h"
#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/remesh.h"
#include "reference/multires/stars/features.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy_file.h"
#include "validate/multires/check_remesh.h"

namespace clues::fuzz {
namespace {

constexpr const char* hierarchy_judged = "hierarchy-judged";
constexpr const char* hierarchies_agree = "hierarchies-agree";
constexpr const char* remesh_proved = "remesh-proved";

// The first thing that is wrong, in one line.
std::string flaw_of(const validate::HierarchyReport& report) {
  if (report.sound()) return {};
  const auto& first = report.findings.front();
  return first.check + ": " + first.what;
}

class MapsTrial : public Trial {
 public:
  explicit MapsTrial(HierarchyMaker fast) : fast_(std::move(fast)) {
    generators_.push_back({"surfaces",
                           "balls, slabs with holes, sheets: edges flipped, discs cut out; shaken, folded, with "
                           "slivers, with vertices in one place",
                           [](std::uint64_t seed, std::uint64_t index) {
                             Case made{"surfaces", seed, index, surface_case(seed, index).mesh, {}, false};
                             made.cell = {made.mesh.points.front()};  // findings have one; it says nothing
                             return made;
                           }});
  }

  const char* what() const override { return "hierarchies and remeshes of clues maps, both kernels (D31-D34)"; }
  std::vector<NamedGenerator> generators(const GivenScenes&) const override { return generators_; }
  const std::vector<Check>& checks() const override {
    static const std::vector<Check> all{
        {hierarchy_judged,
         "the hierarchy of the reference has E1 to E6",
         {"hierarchies judged", "levels", "feature edges"}},
        {hierarchies_agree, "the fast path's hierarchy is the same, byte for byte", {"hierarchies compared"}},
        {remesh_proved, "remeshes are proved as near as they say (E7); one case in four", {"remeshes judged"}}};
    return all;
  }
  bool is_a_mesh(const Case&) const override { return true; }

  void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const override {
    std::vector<scene::Edge> features;
    if (scene.index % 3 == 0) features = reference::sharp_edges(scene.mesh, 0.5);
    reference::HierarchyOptions options;
    options.base_triangles = base_of(scene);
    options.features = features;
    const scene::Hierarchy hierarchy = reference::build_hierarchy(scene.mesh, options);
    outcome.counters["levels"] += hierarchy.levels.size();
    outcome.counters["feature edges"] += hierarchy.features.size();
    if (is_asked(asked, hierarchy_judged)) {
      ++outcome.counters["hierarchies judged"];
      const auto report = validate::check_hierarchy(hierarchy);
      outcome.counters["triangles that turn over in the linear map"] += report.linear_flips;
      file(scene, hierarchy_judged, flaw_of(report), outcome);
    }
    if (is_asked(asked, hierarchies_agree)) {
      ++outcome.counters["hierarchies compared"];
      const bool same = scene::to_text(fast_(scene.mesh, features, base_of(scene))) == scene::to_text(hierarchy);
      file(scene, hierarchies_agree, same ? "" : "the fast path's hierarchy is another than the reference's", outcome);
    }
    if (is_asked(asked, remesh_proved) && scene.index % 4 == 1) judge_remesh(scene, hierarchy, outcome);
  }

 private:
  static std::uint64_t base_of(const Case& scene) { return scene.index % 7; }

  static void judge_remesh(const Case& scene, const scene::Hierarchy& hierarchy, Outcome& outcome) {
    reference::RemeshOptions options;
    options.level = static_cast<int>(scene.index / 4 % 2);
    if (scene.index / 4 % 3 != 0) options.error = 0.3;
    options.most = 2;
    std::optional<reference::Remesh> made;
    try {
      made = reference::remeshed(hierarchy, options);
    } catch (const scene::Error& error) {
      // A level may be too fine for the grids; an error that is asked for is missed then, and nothing is refused.
      if (error.code() != scene::ErrorCode::unsupported || options.level == 0) throw;
      ++outcome.counters["remeshes refused"];
      return;
    }
    ++outcome.counters["remeshes judged"];
    validate::HierarchyReport report;
    validate::check_remesh(hierarchy, made->mesh, made->proof, options.single, report);
    std::string wrong = flaw_of(report);
    if (wrong.empty() && made->reached && made->error() > options.error)
      wrong = fmt::format("the error is bounded by {}, and {} was asked for", made->error(), options.error);
    file(scene, remesh_proved, wrong, outcome);
  }

  HierarchyMaker fast_;
  std::vector<NamedGenerator> generators_;
};

}  // namespace

std::unique_ptr<Trial> make_maps_trial(HierarchyMaker fast) { return std::make_unique<MapsTrial>(std::move(fast)); }

std::unique_ptr<Trial> make_maps_trial() {
  return make_maps_trial(
      [](const scene::TriangleMesh& mesh, const std::vector<scene::Edge>& features, std::uint64_t base) {
        fastpath::multires::BuildOptions options;
        options.base_triangles = base;
        options.features = features;
        options.threads = 1;  // cases run beside each other
        return fastpath::multires::build_hierarchy(mesh, options);
      });
}

}  // namespace clues::fuzz
