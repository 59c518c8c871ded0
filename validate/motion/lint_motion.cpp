// Proves the cases of vectors/motion.
#include "validate/motion/lint_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/motion/compare_bounds.h"
#include "reference/motion/mesh.h"
#include "validate/motion/judge_bounds.h"
#include "validate/motion/mesh_places.h"

namespace clues::validate {
namespace {

using scene::ConstraintPlace;

constexpr double infinite = std::numeric_limits<double>::infinity();

std::array<const scene::DepthSample*, 4> samples_of(const MotionVector& test, const MeshPlaces& places,
                                                    const ConstraintPlace& place) {
  const auto numbers = samples_at(test.mesh, places, place);
  std::array<const scene::DepthSample*, 4> out{};
  for (std::size_t i = 0; i < numbers.count; ++i) out[i] = &test.mesh.samples[numbers.sample[i]];
  return out;
}

// By the judge's own loop.
std::vector<ConstraintPlace> violated_at(const MotionVector& test) {
  const MeshPlaces places(test.mesh);
  require_one_across(places, test.thresholds);
  const exact::ExactThresholds thresholds(test.thresholds);
  std::vector<ConstraintPlace> out;
  for (std::uint32_t i = 0; i < test.mesh.triangles.size(); ++i) {
    for (const auto& place : constraints_of(places, test.thresholds, i)) {
      if (!holds_at(place.constraint, samples_of(test, places, place), exact::exact_viewpoint(test.viewpoint),
                    thresholds)) {
        out.push_back(place);
      }
    }
  }
  return out;
}

BoundJudgement judged(const MotionVector& test, std::size_t triangle, double claim) {
  std::vector<double> claims(test.mesh.triangles.size(), 0);
  claims[triangle] = claim;
  JudgeBoundsOptions options;
  options.threads = 1;
  return judge_motion_bounds(test.mesh, test.thresholds, test.viewpoint, claims, options).triangles[triangle];
}

std::vector<double> reference_bounds(const MotionVector& test) {
  return reference::motion_bounds(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
}

std::vector<std::string> flaws_of_exact(const MotionVector& test) {
  std::vector<std::string> out;
  const MeshPlaces places(test.mesh);
  const auto v = exact::exact_viewpoint(test.viewpoint);
  for (const auto& known : test.exact) {
    const auto s = samples_of(test, places, known.place);
    mpq_class square(known.square, 10);
    square.canonicalize();
    int order = 0;
    switch (known.place.constraint) {
      case scene::MotionConstraint::facing:
        order = exact::compare_facing_bound(*s[0], *s[1], *s[2], v, square);
        break;
      case scene::MotionConstraint::edge_length:
        order = exact::compare_edge_bound(*s[0], *s[1], v, exact::ExactThresholds(test.thresholds), square);
        break;
      case scene::MotionConstraint::separation:
      case scene::MotionConstraint::delaunay:
        out.push_back("exact: only bounds of facing and edge length are known exactly");
        continue;
    }
    if (order != 0) {
      out.push_back(fmt::format("exact: the square of the {} bound of triangle {} is {} than {}",
                                scene::name_of(known.place.constraint), known.place.triangle,
                                order > 0 ? "more" : "less", known.square));
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> flaws_of(const MotionVector& test) {
  std::vector<std::string> out = flaws_of_exact(test);
  const auto by_reference = reference::violations(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
  if (by_reference != violated_at(test)) out.push_back("violated: the reference and the judge contradict each other");
  if (by_reference != test.violated) out.push_back("violated: not what is violated at the viewpoint");
  const auto bounds = reference_bounds(test);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (!(bounds[i] <= test.sound[i])) {
      out.push_back(fmt::format("sound: the reference claims more for triangle {}: {}", i, bounds[i]));
    }
    // Where the cubes are too few or doubles too coarse for the judge, the proof of the reference (T8, T9) is left.
    const auto verdict = judged(test, i, test.sound[i]).verdict;
    if (verdict == BoundVerdict::refuted || (verdict == BoundVerdict::undecided && test.sound[i] > bounds[i])) {
      out.push_back(fmt::format("sound: {} of triangle {} is not proved", test.sound[i], i));
    }
    if (std::isinf(test.unsound[i]) && std::isinf(test.sound[i])) continue;
    if (judged(test, i, test.unsound[i]).verdict != BoundVerdict::refuted) {
      out.push_back(fmt::format("unsound: {} of triangle {} is not refuted", test.unsound[i], i));
    }
  }
  return out;
}

void fill_in(MotionVector& test) {
  test.violated = reference::violations(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
  test.sound = reference_bounds(test);
  test.unsound.clear();
  for (std::size_t i = 0; i < test.sound.size(); ++i) {
    const double sound = test.sound[i];
    double unsound = infinite;
    if (sound == 0 && judged(test, i, std::numeric_limits<double>::denorm_min()).verdict == BoundVerdict::refuted) {
      unsound = std::numeric_limits<double>::denorm_min();
    }
    // Beyond the bound by more and more; where nothing is left of it, from 2^-60 on.
    for (int k = sound == 0 ? -60 : -52; k <= 20 && std::isinf(unsound) && std::isfinite(sound); ++k) {
      const double more = sound == 0 ? std::ldexp(1.0, k) : sound * (1 + std::ldexp(1.0, k));
      if (judged(test, i, more).verdict == BoundVerdict::refuted) unsound = more;
    }
    test.unsound.push_back(unsound);
  }
  test.has_expectation = true;
}

namespace {

struct MotionCases {
  static MotionTopic parse(std::string_view text, const std::string& file, bool drafts) {
    return parse_motion_topic(text, file, drafts);
  }
  static bool has_expectation(const MotionVector& test) { return test.has_expectation; }
  static void fill_in(MotionVector& test) { validate::fill_in(test); }
  static std::vector<std::string> flaws_of(const MotionVector& test) { return validate::flaws_of(test); }
  static std::string to_json_text(const MotionTopic& topic) { return validate::to_json_text(topic); }
};

}  // namespace

SideLintReport lint_motion_suite(const std::filesystem::path& folder, const SideLintOptions& options) {
  return lint_side_suite<MotionCases>(folder, options);
}

}  // namespace clues::validate
