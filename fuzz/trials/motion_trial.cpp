#include "fuzz/trials/motion_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fastpath/motion/bounds/bounds.h"
#include "fastpath/motion/walk.h"
#include "fuzz/findings/case_random.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/motion/mesh.h"
#include "validate/motion/check_walk.h"
#include "validate/motion/judge_bounds.h"

namespace clues::fuzz {
namespace {

namespace motion = fastpath::motion;
using scene::MotionPoint;

constexpr const char* bounds_hold = "bounds-hold";
constexpr const char* frames_hold = "frames-hold";
constexpr const char* walks = "walks";

constexpr std::array<const char*, motion_kinds> kind_names{
    "bounds_random", "bounds_small",      "bounds_wall",    "bounds_thin",   "bounds_near",
    "bounds_far",    "bounds_cocircular", "bounds_one_ulp", "bounds_scaled", "bounds_sky"};
constexpr std::array<const char*, motion_kinds> kind_texts{
    "two triangles at depths from 1 to 4, angles up to 0.6",
    "the same, angles down to 0.003",
    "four samples in one plane, seen obliquely",
    "a needle: one vertex next to the opposite edge",
    "the viewpoint next to a sample",
    "samples a million times farther than they are apart",
    "four samples seen on one circle, exactly",
    "the same with one coordinate moved by one unit in the last place",
    "sizes from 2^-300 to 2^300",
    "one to three of the four are directions"};

// With some of the constraints only in three cases of four: of all together one mostly fails, and then there is nothing to bound.
MotionCase test_of(const Case& scene) {
  const auto kind = std::find(kind_names.begin(), kind_names.end(), scene.generator) - kind_names.begin();
  MotionCase test = motion_case(static_cast<MotionKind>(kind), scene.seed, scene.index);
  test.thresholds.delaunay = scene.index % 2 == 0;
  if (scene.index % 4 > 1) test.thresholds.kappa = 1e6;
  if (scene.index % 8 > 3) test.thresholds.sigma = 0;
  return test;
}

// For people who look at a finding: what it is about is made from its name.
Case bounds_case(const char* name, MotionKind kind, std::uint64_t seed, std::uint64_t index) {
  const MotionCase test = motion_case(kind, seed, index);
  Case made{name, seed, index, {}, {test.viewpoint}, false};
  for (const auto& sample : test.mesh.samples) made.mesh.points.push_back(sample.at);
  for (const auto& t : test.mesh.triangles) {
    made.mesh.face_of.push_back(static_cast<std::uint32_t>(made.mesh.triangles.size()));
    made.mesh.triangles.push_back(t);
  }
  return made;
}

Case walk_case(std::uint64_t seed, std::uint64_t index) {
  GeneratedScene generated = generate(all_kinds[index % all_kinds.size()], seed, index / all_kinds.size());
  return {walks, seed, index, std::move(generated.mesh), std::move(generated.cell), false};
}

double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.next() >> 11U) * 0x1p-53;
}

// From the middle of the cell on, in steps of all sizes; now and then it stands still, returns, jumps, or comes upon a mesh vertex.
std::vector<MotionPoint> path_of(const Case& scene) {
  Random random = random_for(scene, walks);
  MotionPoint at{};
  for (const auto& p : scene.cell) {
    for (std::size_t i = 0; i < 3; ++i) at[i] += p[i] / static_cast<double>(scene.cell.size());
  }
  std::vector<MotionPoint> path{at};
  MotionPoint way{};
  for (int k = 0; k < 14; ++k) {
    switch (random.between(0, 9)) {
      case 0:
        break;
      case 1:
        at = path.front();
        break;
      case 2:
        at = scene.mesh.points[random.next() % scene.mesh.points.size()];
        break;
      default:
        if (k == 0 || random.one_in(4)) {
          const double size = std::exp2(uniform(random, -10, 3));
          for (double& x : way) x = size * uniform(random, -1, 1);
        }
        for (std::size_t i = 0; i < 3; ++i) at[i] += way[i];
    }
    path.push_back(at);
  }
  return path;
}

std::vector<double> fast_bounds(const MotionCase& test) {
  const auto& s = test.mesh.samples;
  const motion::BoundThresholds thresholds(test.thresholds);
  std::array<motion::Row, 4> row;
  for (std::size_t i = 0; i < 4; ++i) row[i] = motion::row_of(s[i], test.viewpoint);
  // Of the edge that they share; doubles take for granted that both face the viewpoint.
  const double second = motion::triangle_bound(row[3], row[2], row[1], thresholds);
  double shared = test.thresholds.delaunay ? motion::delaunay_bound(row[0], row[1], row[2], row[3]) : motion::kInfinity;
  if (test.thresholds.delaunay && !(second > 0)) shared = 0;
  return {std::min(motion::triangle_bound(row[0], row[1], row[2], thresholds), shared), std::min(second, shared)};
}

class MotionTrial : public Trial {
 public:
  explicit MotionTrial(BoundsMaker fast) : fast_(std::move(fast)) {
    for (int k = 0; k < motion_kinds; ++k) {
      const char* name = kind_names[static_cast<std::size_t>(k)];
      generators_.push_back(
          {name, kind_texts[static_cast<std::size_t>(k)], [name, k](std::uint64_t seed, std::uint64_t index) {
             return bounds_case(name, static_cast<MotionKind>(k), seed, index);
           }});
    }
    generators_.push_back({walks, "small scenes of clues fuzz, and a viewpoint that goes through them", walk_case});
  }

  const char* what() const override { return "motion bounds of both kernels, and walks of clues motion (D28-D30)"; }
  std::vector<NamedGenerator> generators(const GivenScenes&) const override { return generators_; }
  const std::vector<Check>& checks() const override {
    static const std::vector<Check> all{
        {bounds_hold, "no viewpoint nearer than a bound violates what it is for", {"bounds proved"}},
        {frames_hold, "in each frame of a walk every constraint holds", {"frames checked", "samples taken out"}}};
    return all;
  }
  bool looks_at(const std::string& check, const std::string& generator) const override {
    return (check == frames_hold) == (generator == walks);
  }
  bool is_a_mesh(const Case& scene) const override { return scene.generator == walks; }

  void judge(const Case& scene, const std::vector<std::string>& asked, Outcome& outcome) const override {
    if (scene.generator == walks) {
      if (is_asked(asked, frames_hold)) judge_walk(scene, outcome);
    } else if (is_asked(asked, bounds_hold)) {
      judge_bounds(scene, outcome);
    }
  }

 private:
  void judge_bounds(const Case& scene, Outcome& outcome) const {
    const MotionCase test = test_of(scene);
    const auto of_reference =
        reference::motion_bounds(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
    for (const auto& [kernel, bounds] : {std::pair("the reference", of_reference), {"the fast path", fast_(test)}}) {
      validate::JudgeBoundsOptions options;
      options.threads = 1;
      options.most_cubes = 2000;
      const auto report = validate::judge_motion_bounds(test.mesh, test.thresholds, test.viewpoint, bounds, options);
      outcome.counters["bounds judged"] += report.triangles.size();
      for (const auto& triangle : report.triangles) {
        if (triangle.claim > 0 && triangle.verdict == validate::BoundVerdict::proved)
          ++outcome.counters["bounds proved"];
      }
      outcome.counters["bounds undecided"] += report.undecided;
      if (report.refuted == 0) continue;
      const auto bad = std::find_if(report.triangles.begin(), report.triangles.end(),
                                    [](const auto& t) { return t.verdict == validate::BoundVerdict::refuted; });
      file(scene, bounds_hold,
           fmt::format("triangle {}: {} says {}, and {} is violated at ({}, {}, {})", bad - report.triangles.begin(),
                       kernel, bad->claim, scene::name_of(bad->place.constraint), bad->viewpoint[0].get_str(),
                       bad->viewpoint[1].get_str(), bad->viewpoint[2].get_str()),
           outcome);
      return;
    }
  }

  static void judge_walk(const Case& scene, Outcome& outcome) {
    const fastpath::Bvh bvh(scene.mesh);
    motion::WalkOptions options;
    options.samples = 120;
    options.seed = scene.index + 1;
    options.thresholds.delaunay = scene.index % 2 == 1;
    const auto path = path_of(scene);
    motion::Walk walk(bvh, options, path.front());
    for (std::size_t k = 0; k < path.size(); ++k) {
      if (k > 0) {
        const auto frame = walk.move_to(path[k]);
        outcome.counters["samples taken out"] += frame.removed;
        outcome.counters["frames made anew"] += frame.rebuilt ? 1U : 0U;
      }
      validate::WalkReport report;
      validate::check_frame({k, path[k], options.thresholds, walk.depth_mesh()}, report);
      ++outcome.counters["frames checked"];
      outcome.counters["constraints tested"] += report.tested;
      if (report.sound()) continue;
      return file(scene, frames_hold, fmt::format("frame {}: {}", k, report.findings.front().what), outcome);
    }
  }

  BoundsMaker fast_;
  std::vector<NamedGenerator> generators_;
};

}  // namespace

std::unique_ptr<Trial> make_motion_trial() { return make_motion_trial(fast_bounds); }

std::unique_ptr<Trial> make_motion_trial(BoundsMaker fast) { return std::make_unique<MotionTrial>(std::move(fast)); }

}  // namespace clues::fuzz
