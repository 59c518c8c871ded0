#include "tests/differential/scene_kernels.h"

#include <time.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement/refinement.h"
#include "fuzz/findings/dials.h"
#include "reference/visibility/refinement/backprojection.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/subdivision.h"

namespace clues::tests {
namespace {

constexpr double kSlow = 2;  // seconds of one kernel on at most 10 triangles

class Kernels {
 public:
  Kernels(const fuzz::Case& scene, const exact::ConvexCell& cell, const KernelSettings& settings, Judgement& out)
      : scene_(scene), cell_(cell), settings_(settings), out_(out) {}

  std::vector<KernelAnswer> ask() {
    const auto from_map = [&](reference::VisibilityMap map, bool first_order) {
      KernelAnswer a;
      a.visible = map.visible;
      a.fallbacks = map.statistics.conservative_fallbacks;
      a.first_order = first_order;
      a.in_doubt = map.in_doubt;
      if (first_order && map.statistics.walk_disagreements > 0)
        out_.flaw("walks of the reference disagree", std::to_string(map.statistics.walk_disagreements) + " times");
      a.map = std::move(map);
      return a;
    };
    ask_kernel("plain reference", [&] {
      return from_map(reference::first_order_visibility(scene_.mesh, cell_, reference_options()), true);
    });
    ask_kernel("traversal", [&] {
      reference::Options options = reference_options();
      options.formulation = reference::Formulation::traversal;
      return from_map(reference::first_order_visibility(scene_.mesh, cell_, options), true);
    });
    const fastpath::Bvh bvh(scene_.mesh);
    const auto from_fast = [](std::vector<std::uint32_t> visible, std::uint64_t fallbacks, bool first_order,
                              std::vector<fastpath::LocalRegion> regions) {
      KernelAnswer a;
      a.visible = std::move(visible);
      a.fallbacks = fallbacks;
      a.first_order = first_order;
      a.regions = std::move(regions);
      return a;
    };
    ask_kernel("fast path", [&] {
      fastpath::FirstOrder found =
          fastpath::first_order_visibility(bvh, scene_.cell, fast_options(), {.regions = true, .in_doubt = true});
      KernelAnswer a = from_fast(found.visible, found.conservative_fallbacks, true, std::move(found.regions));
      a.in_doubt = std::move(found.in_doubt);
      return a;
    });
    if (!settings_.refined) return std::move(answers_);
    const bool by_planes = scene_.index % 2 == 1;
    ask_kernel(by_planes ? "backprojected reference" : "subdivided reference", [&] {
      reference::Bounds bounds(scene_.mesh, cell_, reference_options());
      if (by_planes) {
        refine_by_backprojection(bounds, {1, 0});
      } else {
        refine_by_cells(bounds, {2, 0});
      }
      return from_map(reference::moved_back(bounds.refined_map("refined")), false);
    });
    ask_kernel(by_planes ? "backprojected fast path" : "subdivided fast path", [&] {
      fastpath::RefinementOptions refinement;
      refinement.by = by_planes ? fastpath::RefineBy::backprojection : fastpath::RefineBy::cells;
      refinement.max_depth = 2;
      refinement.regions = true;
      auto found = fastpath::refined_visibility(bvh, scene_.cell, fast_options(), refinement);
      return from_fast(found.visible, found.conservative_fallbacks, false, std::move(found.first_order.regions));
    });
    return std::move(answers_);
  }

 private:
  template <class Ask>
  void ask_kernel(const std::string& kernel, const Ask& ask) {
    const auto& wanted = settings_.kernels;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), kernel) == wanted.end()) return;
    const double begin = processor_seconds();
    try {
      const exact::TurnedProcessDials turned(fuzz::process_dials(scene_.dials));
      KernelAnswer answer = ask();
      answer.kernel = kernel;
      if (settings_.planted_bug) settings_.planted_bug(answer);
      out_.count("answers of " + kernel);
      if (answer.fallbacks > 0) {
        out_.count("scenes with fallbacks of " + kernel);
        if (!answer.in_doubt.empty()) out_.count("scenes with triangles in doubt of " + kernel);
        out_.count("triangles in doubt of " + kernel, answer.in_doubt.size());
        if (settings_.no_fallbacks && !fuzz::is_limited(scene_.dials) && answer.first_order &&
            scene_.mesh.triangles.size() <= 10)
          out_.flaw("fallback of " + kernel, std::to_string(answer.fallbacks) + " of them");
      }
      answers_.push_back(std::move(answer));
    } catch (const std::exception& error) {
      out_.count("exceptions of " + kernel);
      out_.flaw("exception of " + kernel + ": " + one_line(error.what()), "");
    }
    if (out_.count_time(kernel, begin) > kSlow && scene_.mesh.triangles.size() <= 10)
      out_.count("slow scenes of " + kernel);  // a figure, and no flaw: machines differ
  }

  reference::Options reference_options() const {
    reference::Options options;
    options.threads = 1;
    options.dials = fuzz::map_dials(scene_.dials);
    return options;
  }
  fastpath::LocalMapOptions fast_options() const {
    fastpath::LocalMapOptions options;
    options.dials = fuzz::map_dials(scene_.dials);
    return options;
  }

  const fuzz::Case& scene_;
  const exact::ConvexCell& cell_;
  const KernelSettings& settings_;
  Judgement& out_;
  std::vector<KernelAnswer> answers_;
};

}  // namespace

void Judgement::flaw(const std::string& category, const std::string& detail) {
  const bool known = std::any_of(flaws.begin(), flaws.end(), [&](const Flaw& f) { return f.category == category; });
  if (!known) flaws.push_back({category, detail});
}

void Judgement::count(const std::string& what, std::uint64_t n) { counts[what] += n; }

double Judgement::count_time(const std::string& of, double begin) {
  const double since = processor_seconds() - begin;
  count("ms of " + of, static_cast<std::uint64_t>(1e3 * since + 0.5));
  return since;
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string one_line(const std::string& what) {
  std::string line;
  std::istringstream words(what);
  for (std::string word; words >> word;) {
    const auto slash = word.rfind('/');
    if (!line.empty()) line += ' ';
    line += slash == word.npos ? word : word.substr(slash + 1);
  }
  return line.substr(0, 160);
}

std::vector<KernelAnswer> ask_kernels(const fuzz::Case& scene, const exact::ConvexCell& cell,
                                      const KernelSettings& settings, Judgement& out) {
  return Kernels(scene, cell, settings, out).ask();
}

}  // namespace clues::tests
