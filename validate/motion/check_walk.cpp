// Intervals first: what is certain in them is certain.
#include "validate/motion/check_walk.h"

#include <CGAL/Interval_nt.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "scene/messages/error.h"
#include "validate/motion/interval_vector.h"
#include "validate/motion/mesh_places.h"

namespace clues::validate {
namespace {

using Vector = IntervalVector;
using scene::ConstraintPlace;
using scene::MotionConstraint;

constexpr std::size_t most_findings = 100;

// Of the same direction: what a double cannot hold is cut down, by one power of two, and rounded to both sides.
Vector enclosed(const exact::SightRow& row) {
  std::size_t bits = 0;
  for (const auto& x : row.x) bits = std::max(bits, mpz_sizeinbase(x.get_mpz_t(), 2));
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_class low, high;
    const mp_bitcnt_t cut = bits > 53 ? bits - 53 : 0;
    mpz_fdiv_q_2exp(low.get_mpz_t(), row.x[i].get_mpz_t(), cut);
    mpz_cdiv_q_2exp(high.get_mpz_t(), row.x[i].get_mpz_t(), cut);
    out[i] = Interval(low.get_d(), high.get_d());
  }
  return out;
}

class FrameCheck {
 public:
  FrameCheck(const scene::WalkFrame& frame, WalkReport& report)
      : frame_(frame),
        mesh_(frame.mesh),
        report_(report),
        limits_(frame.thresholds),
        places_(frame.mesh),
        kappa_(frame.thresholds.kappa),
        sigma_(frame.thresholds.sigma),
        exact_rows_(frame.mesh.samples.size()) {
    rows_.reserve(mesh_.samples.size());
    lengths_.reserve(mesh_.samples.size());
    for (const auto& sample : mesh_.samples) {
      Vector row{sample.at[0], sample.at[1], sample.at[2]};
      for (std::size_t i = 0; i < 3 && !sample.is_direction; ++i) row[i] -= frame.viewpoint[i];
      rows_.push_back(row);
      lengths_.push_back(CGAL::sqrt(dot(row, row)));
    }
  }

  void run() {
    ++report_.frames;
    report_.triangles += mesh_.triangles.size();
    if (places_.unpaired != 0 || mesh_.triangles.empty()) {
      ++report_.open_frames;
      find(WalkFault::open_mesh, mesh_.triangles.empty()
                                     ? std::string("there is no triangle")
                                     : fmt::format("{} edges have not one triangle on each side", places_.unpaired));
    }
    std::uint64_t not_facing = 0;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      not_facing += test({MotionConstraint::facing, i, 0}) ? 0U : 1U;
      for (std::uint8_t k = 0; k < 3; ++k) {
        test({MotionConstraint::separation, i, k});
        // What belongs to an edge, once for its two triangles.
        const bool first = places_.across[i][k] == MeshPlaces::none || corner(i, k) < corner(i, k + 1U);
        if (!first) continue;
        test({MotionConstraint::edge_length, i, k});
        if (frame_.thresholds.delaunay && places_.across[i][k] != MeshPlaces::none) {
          test({MotionConstraint::delaunay, i, k});
        }
      }
    }
    if (places_.unpaired == 0 && not_facing == 0 && !mesh_.triangles.empty()) check_degree();
  }

 private:
  std::uint32_t corner(std::uint32_t triangle, std::size_t k) const { return mesh_.triangles[triangle][k % 3]; }

  void find(WalkFault fault, const std::string& what) {
    if (report_.findings.size() < most_findings) report_.findings.push_back({frame_.number, fault, what});
  }

  const exact::SightRow& exact_row(std::uint32_t sample) {
    auto& row = exact_rows_[sample];
    if (!row) row = exact::sight_row(mesh_.samples[sample], frame_.viewpoint);
    return *row;
  }

  bool test(const ConstraintPlace& place) {
    ++report_.tested;
    const auto numbers = samples_at(mesh_, places_, place);
    if (certain(place.constraint, numbers.sample)) return true;
    ++report_.by_integers;
    std::array<const exact::SightRow*, 4> rows{};
    for (std::size_t i = 0; i < numbers.count; ++i) rows[i] = &exact_row(numbers.sample[i]);
    if (holds_at(place.constraint, rows, limits_)) return true;
    ++report_.violated[static_cast<std::size_t>(place.constraint)];
    const auto t = place.triangle;
    find(WalkFault::constraint,
         fmt::format("triangle {}, {}, {}: {}", corner(t, 0), corner(t, 1), corner(t, 2),
                     scene::describe(place.constraint, corner(t, place.corner), corner(t, place.corner + 1U),
                                     corner(t, place.corner + 2U))));
    return false;
  }

  bool certain(MotionConstraint constraint, const std::array<std::uint32_t, 4>& s) const {
    const Vector &a = rows_[s[0]], &b = rows_[s[1]];
    switch (constraint) {
      case MotionConstraint::facing:
        return dot(a, cross(b, rows_[s[2]])).inf() > 0;
      case MotionConstraint::edge_length: {
        const Vector normal = cross(a, b);
        return (kappa_ * CGAL::sqrt(dot(normal, normal)) - dot(a, b)).inf() > 0;
      }
      case MotionConstraint::separation: {
        // Far enough from the great circle of the edge is far enough from the edge.
        const Vector normal = cross(b, rows_[s[2]]);
        const Interval height = dot(a, normal);
        return (CGAL::square(height) - sigma_ * dot(normal, normal) * dot(a, a)).inf() > 0;
      }
      case MotionConstraint::delaunay: {
        const Vector &c = rows_[s[2]], &d = rows_[s[3]];
        const Vector ab = cross(a, b), cd = cross(c, d);
        const Interval g = lengths_[s[1]] * dot(a, cd) - lengths_[s[0]] * dot(b, cd) - lengths_[s[2]] * dot(d, ab) +
                           lengths_[s[3]] * dot(c, ab);
        return g.inf() > 0;
      }
    }
    return false;
  }

  // All triangles face the viewpoint and the mesh is closed: it covers every direction equally often (T7). The one to the middle of
  // triangle 0 must be in no other.
  void check_degree() {
    const auto& first = mesh_.triangles[0];
    exact::SightRow exact_middle;
    for (const auto sample : first) {
      const auto& row = exact_row(sample);
      for (std::size_t i = 0; i < 3; ++i) exact_middle.x[i] += row.x[i];
    }
    const Vector middle = enclosed(exact_middle);
    const auto outside = [&](const Vector& a, const Vector& b) { return dot(middle, cross(a, b)).sup() < 0; };
    for (std::uint32_t i = 1; i < mesh_.triangles.size(); ++i) {
      const auto& t = mesh_.triangles[i];
      const Vector &a = rows_[t[0]], &b = rows_[t[1]], &c = rows_[t[2]];
      if (outside(a, b) || outside(b, c) || outside(c, a)) continue;
      const auto &x = exact_row(t[0]), &y = exact_row(t[1]), &z = exact_row(t[2]);
      if (exact::facing_sign(exact_middle, x, y) < 0 || exact::facing_sign(exact_middle, y, z) < 0 ||
          exact::facing_sign(exact_middle, z, x) < 0) {
        continue;
      }
      ++report_.overlapping_frames;
      find(WalkFault::covered_twice, fmt::format("triangle {}, {}, {} overlaps triangle {}, {}, {} for the viewpoint",
                                                 t[0], t[1], t[2], first[0], first[1], first[2]));
      return;
    }
  }

  const scene::WalkFrame& frame_;
  const scene::DepthMesh& mesh_;
  WalkReport& report_;
  exact::ExactThresholds limits_;
  MeshPlaces places_;
  Interval kappa_, sigma_;
  std::vector<Vector> rows_;
  std::vector<Interval> lengths_;
  std::vector<std::optional<exact::SightRow>> exact_rows_;
};

}  // namespace

bool WalkReport::sound() const {
  return open_frames == 0 && overlapping_frames == 0 &&
         std::all_of(violated.begin(), violated.end(), [](std::uint64_t n) { return n == 0; });
}

void check_frame(const scene::WalkFrame& frame, WalkReport& report) {
  const Interval::Protector rounding;
  FrameCheck(frame, report).run();
}

WalkReport check_walk(const std::filesystem::path& path, const std::function<void(std::uint64_t frames)>& progress) {
  scene::WalkReader reader(path);
  scene::WalkFrame frame;
  WalkReport report;
  while (reader.next(frame)) {
    check_frame(frame, report);
    if (progress) progress(report.frames);
  }
  if (report.frames == 0) {
    throw scene::Error(scene::ErrorCode::malformed, path.string() + ": a walk without frames; nothing was checked");
  }
  return report;
}

std::string to_text(const WalkReport& report) {
  std::string text = report.sound() ? "verdict: every frame is valid\n" : "verdict: violations\n";
  text += fmt::format("frames: {}, with {} triangles\n", report.frames, report.triangles);
  text += fmt::format("constraints tested: {} ({} by integers)\n", report.tested, report.by_integers);
  text += fmt::format(
      "violated: facing {}, edge length {}, separation {}, Delaunay {}; frames not closed {}, overlapping {}\n",
      report.violated[0], report.violated[1], report.violated[2], report.violated[3], report.open_frames,
      report.overlapping_frames);
  for (std::size_t i = 0; i < report.findings.size() && i < 20; ++i) {
    text += fmt::format("  frame {}: {}\n", report.findings[i].frame, report.findings[i].what);
  }
  if (report.findings.size() > 20) text += "  ... (--json lists more)\n";
  return text;
}

std::string to_json_text(const WalkReport& report) {
  auto findings = nlohmann::json::array();
  for (const auto& finding : report.findings) findings.push_back({{"frame", finding.frame}, {"what", finding.what}});
  const nlohmann::json root{{"format", "clues-walk-report/1"},
                            {"frames", report.frames},
                            {"triangles", report.triangles},
                            {"tested", report.tested},
                            {"by_integers", report.by_integers},
                            {"violated",
                             {{"facing", report.violated[0]},
                              {"edge-length", report.violated[1]},
                              {"separation", report.violated[2]},
                              {"delaunay", report.violated[3]}}},
                            {"open_frames", report.open_frames},
                            {"overlapping_frames", report.overlapping_frames},
                            {"sound", report.sound()},
                            {"findings", std::move(findings)}};
  return root.dump(2).append("\n");
}

}  // namespace clues::validate
