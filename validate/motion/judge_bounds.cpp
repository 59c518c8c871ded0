// Facing and edge length are compared with their exact bounds; separation and Delaunay are proved by branch and bound. What is not proved is
// looked for.
#include "validate/motion/judge_bounds.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "exact/motion/compare_bounds.h"
#include "exact/threads.h"
#include "scene/messages/error.h"
#include "validate/motion/ball_proof.h"
#include "validate/motion/counterexample.h"
#include "validate/motion/mesh_places.h"

namespace clues::validate {
namespace {

using scene::ConstraintPlace;
using scene::MotionConstraint;

class Judge {
 public:
  Judge(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds, const scene::MotionPoint& viewpoint,
        std::uint64_t most_cubes)
      : mesh_(mesh),
        thresholds_(thresholds),
        limits_(thresholds),
        viewpoint_(viewpoint),
        exact_viewpoint_(exact::exact_viewpoint(viewpoint)),
        places_(mesh),
        most_cubes_(most_cubes) {
    require_one_across(places_, thresholds);
  }

  BoundJudgement judge(std::uint32_t triangle, double claim) const {
    BoundJudgement out;
    out.claim = out.proved = claim;
    out.verdict = BoundVerdict::proved;
    if (claim == 0) return out;
    for (const auto& place : constraints_of(places_, thresholds_, triangle)) {
      const auto samples = pointers(place);
      std::vector<scene::MotionPoint> hints;
      if (proved(place, samples, claim, hints)) continue;
      if (auto found = find_violation({place.constraint, samples, viewpoint_, claim}, limits_, hints)) {
        out.verdict = BoundVerdict::refuted;
        out.place = place;
        out.viewpoint = *found;
        out.proved = 0;
        return out;
      }
      const double radius = proved_radius(place, samples, claim);
      if (out.verdict == BoundVerdict::proved || radius < out.proved) {
        out.place = place;
        out.proved = std::min(out.proved, radius);
      }
      out.verdict = BoundVerdict::undecided;
    }
    return out;
  }

 private:
  using Samples = std::array<const scene::DepthSample*, 4>;

  Samples pointers(const ConstraintPlace& place) const {
    const auto numbers = samples_at(mesh_, places_, place);
    Samples out{};
    for (std::size_t i = 0; i < numbers.count; ++i) out[i] = &mesh_.samples[numbers.sample[i]];
    return out;
  }

  // What moves nothing when the viewpoint moves holds everywhere or nowhere.
  bool constant(const Samples& samples) const {
    return std::all_of(samples.begin(), samples.end(), [](const auto* s) { return !s || s->is_direction; });
  }

  bool proved(const ConstraintPlace& place, const Samples& s, double radius,
              std::vector<scene::MotionPoint>& hints) const {
    if (constant(s)) return holds_at(place.constraint, s, exact_viewpoint_, limits_);
    if (!std::isfinite(radius)) return false;
    const mpq_class square = mpq_class(radius) * mpq_class(radius);
    switch (place.constraint) {
      case MotionConstraint::facing:
        return exact::compare_facing_bound(*s[0], *s[1], *s[2], exact_viewpoint_, square) >= 0;
      case MotionConstraint::edge_length:
        return exact::compare_edge_bound(*s[0], *s[1], exact_viewpoint_, limits_, square) >= 0;
      case MotionConstraint::separation:
        // Where the triangle faces the viewpoint every separation is more than 0.
        if (thresholds_.sigma == 0 && exact::compare_facing_bound(*s[0], *s[1], *s[2], exact_viewpoint_, square) >= 0) {
          return true;
        }
        break;
      case MotionConstraint::delaunay:
        break;
    }
    const auto proof = prove_in_ball({place.constraint, s, viewpoint_, thresholds_.sigma}, radius, most_cubes_);
    if (proof.suspect) hints.push_back(proof.at);
    return proof.proved;
  }

  // The largest of claim * k / 256 that is proved, by halving.
  double proved_radius(const ConstraintPlace& place, const Samples& samples, double claim) const {
    if (!std::isfinite(claim)) return 0;
    // A large claim would be infinite when it is multiplied, a tiny one lose digits when it is divided.
    const auto part = [&](int k) { return claim > 1 ? claim / 256 * k : claim * k / 256; };
    int low = 0, high = 256;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      std::vector<scene::MotionPoint> unused;
      (proved(place, samples, part(middle), unused) ? low : high) = middle;
    }
    return part(low);
  }

  const scene::DepthMesh& mesh_;
  scene::MotionThresholds thresholds_;
  exact::ExactThresholds limits_;
  scene::MotionPoint viewpoint_;
  exact::ExactViewpoint exact_viewpoint_;
  MeshPlaces places_;
  std::uint64_t most_cubes_;
};

std::string description(const scene::DepthMesh& mesh, const ConstraintPlace& place) {
  const auto& t = mesh.triangles[place.triangle];
  return scene::describe(place.constraint, t[place.corner], t[(place.corner + 1U) % 3U], t[(place.corner + 2U) % 3U]);
}

std::string rational_point(const exact::ExactViewpoint& v) {
  return fmt::format("({}, {}, {})", v[0].get_str(), v[1].get_str(), v[2].get_str());
}

}  // namespace

BoundsReport judge_motion_bounds(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds,
                                 const scene::MotionPoint& viewpoint, const std::vector<double>& claims,
                                 const JudgeBoundsOptions& options) {
  if (claims.size() != mesh.triangles.size()) {
    throw scene::Error(
        scene::ErrorCode::bad_argument,
        fmt::format("{} bounds for {} triangles; there must be one for each", claims.size(), mesh.triangles.size()));
  }
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (!(claims[i] >= 0)) {
      throw scene::Error(scene::ErrorCode::bad_argument, fmt::format("the bound of triangle {} is no distance", i));
    }
  }
  const Judge judge(mesh, thresholds, viewpoint, options.most_cubes);
  BoundsReport report;
  report.triangles.resize(claims.size());
  std::atomic<std::uint64_t> done = 0;
  std::mutex telling;
  exact::by_threads(options.threads, [&] {
    tbb::parallel_for(std::size_t{0}, claims.size(), [&](std::size_t i) {
      report.triangles[i] = judge.judge(static_cast<std::uint32_t>(i), claims[i]);
      const auto so_far = ++done;
      if (options.progress && so_far % 64 == 0) {
        const std::lock_guard lock(telling);
        options.progress(so_far, claims.size());
      }
    });
  });
  for (const auto& triangle : report.triangles) {
    ++(triangle.verdict == BoundVerdict::proved    ? report.proved
       : triangle.verdict == BoundVerdict::refuted ? report.refuted
                                                   : report.undecided);
  }
  return report;
}

std::string to_text(const BoundsReport& report, const scene::DepthMesh& mesh) {
  constexpr std::uint64_t most_shown = 20;
  std::string text = report.refuted != 0     ? "verdict: unsound\n"
                     : report.undecided != 0 ? "verdict: undecided\n"
                                             : "verdict: sound\n";
  text += fmt::format("bounds: {} proved, {} refuted, {} undecided\n", report.proved, report.refuted, report.undecided);
  std::uint64_t shown = 0;
  for (std::size_t i = 0; i < report.triangles.size(); ++i) {
    const auto& t = report.triangles[i];
    if (t.verdict == BoundVerdict::proved) continue;
    if (shown++ == most_shown) {
      text += fmt::format("  ... and {} more (--json has all)\n", report.refuted + report.undecided - most_shown);
      break;
    }
    const auto claim = std::isinf(t.claim) ? std::string("no limit") : fmt::format("{}", t.claim);
    if (t.verdict == BoundVerdict::refuted) {
      text += fmt::format("  triangle {}: claimed {}; violated ({}) at {}\n", i, claim, description(mesh, t.place),
                          rational_point(t.viewpoint));
    } else {
      text += fmt::format("  triangle {}: claimed {}; proved up to {} (not decided: {})\n", i, claim, t.proved,
                          description(mesh, t.place));
    }
  }
  return text;
}

std::string to_json_text(const BoundsReport& report, const scene::DepthMesh& mesh) {
  auto triangles = nlohmann::json::array();
  for (std::size_t i = 0; i < report.triangles.size(); ++i) {
    const auto& t = report.triangles[i];
    if (t.verdict == BoundVerdict::proved) continue;
    nlohmann::json item{{"triangle", i},
                        {"constraint", scene::name_of(t.place.constraint)},
                        {"what", description(mesh, t.place)},
                        {"claim", std::isinf(t.claim) ? nlohmann::json() : nlohmann::json(t.claim)}};
    if (t.verdict == BoundVerdict::refuted) {
      item["verdict"] = "refuted";
      item["viewpoint"] = {t.viewpoint[0].get_str(), t.viewpoint[1].get_str(), t.viewpoint[2].get_str()};
    } else {
      item["verdict"] = "undecided";
      item["proved"] = t.proved;
    }
    triangles.push_back(std::move(item));
  }
  const nlohmann::json root{{"format", "clues-motion-judgement/1"},
                            {"proved", report.proved},
                            {"refuted", report.refuted},
                            {"undecided", report.undecided},
                            {"triangles", std::move(triangles)}};
  return root.dump(2).append("\n");
}

}  // namespace clues::validate
