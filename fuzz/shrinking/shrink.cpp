#include "fuzz/shrinking/shrink.h"

#include <algorithm>
#include <cmath>

#include "exact/sight/witness.h"
#include "fuzz/findings/dials.h"
#include "fuzz/oracles/oracle.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

using exact::FT;
using exact::Point3;
using scene::Point;
using validate::Witness;

const Oracle* oracle_of(const Finding& f) {
  const auto& all = all_oracles();
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& o) { return o->name() == f.oracle; });
  return at == all.end() ? nullptr : at->get();
}

// The verdict that the subject's answer earns with this witness; empty when it is no witness or nothing is denied.
std::string verdict_of(const Case& scene, const Answer& answer, const Witness& w) {
  if (scene.solid && !w.front) return {};
  const bool listed = std::binary_search(answer.pvs.begin(), answer.pvs.end(), w.triangle);
  if (listed && !(answer.map && in_hidden_region(*answer.map, w.triangle, w.front, w.p))) return {};
  const auto cell = exact::ConvexCell::from_doubles(scene.cell);
  if (!exact::check_witness(scene.mesh, cell, w.triangle, w.front, w.v, w.p).valid) return {};
  return listed ? "hidden-region/visible" : "hidden/visible";
}

// The old witness in a scene whose triangle `t` is the old one, perhaps with other corners: the same barycentric coordinates.
Witness carried(const Finding& old, std::uint32_t t, const Case& scene) {
  Witness w = to_witness(*old.witness);
  const auto corners = [](const scene::TriangleMesh& mesh, std::uint32_t id) {
    std::array<Point3, 3> out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = exact::to_exact(mesh.points[mesh.triangles[id][i]]);
    return out;
  };
  const auto before = corners(old.where.mesh, w.triangle), after = corners(scene.mesh, t);
  w.triangle = t;
  if (before == after || CGAL::collinear(before[0], before[1], before[2])) return w;
  const auto normal = CGAL::cross_product(before[1] - before[0], before[2] - before[0]);
  const auto part = [&](std::size_t i, std::size_t j) {
    return FT(CGAL::cross_product(before[i] - w.p, before[j] - w.p) * normal / normal.squared_length());
  };
  const FT b0 = part(1, 2), b1 = part(2, 0), b2 = part(0, 1);
  w.p = exact::collapsed(CGAL::ORIGIN + (b0 * (after[0] - CGAL::ORIGIN) + b1 * (after[1] - CGAL::ORIGIN) +
                                         b2 * (after[2] - CGAL::ORIGIN)));
  return w;
}

std::optional<Finding> by_witness(const Finding& f, const Case& candidate, const Answer& answer) {
  if (!f.witness || !f.triangle || *f.triangle >= candidate.mesh.triangles.size()) return std::nullopt;
  const Witness w = carried(f, *f.triangle, candidate);
  if (verdict_of(candidate, answer, w) != f.verdict) return std::nullopt;
  Finding out = f;
  out.where = candidate;
  out.witness = to_text(w);
  return out;
}

// `f` as it would be in `candidate`: its triangle is number `triangle` there.
// Throws NoAnswer.
std::optional<Finding> found_by_oracles(const Finding& f, const Case& candidate, const Subject& subject) {
  if (const Trial* trial = subject.trial()) return trial->found_again(f, candidate);
  if (f.oracle == "subject") {  // it gave no answer
    for (Finding& g : judge_case(candidate, subject, {}).findings) {
      if (g.verdict == f.verdict) return std::move(g);
    }
    return std::nullopt;
  }
  if (f.witness) {
    if (auto found = by_witness(f, candidate, subject.answer(candidate))) return found;
  }
  // A witness that came from another scene is looked for with the lines and points of this one.
  std::vector<const Oracle*> ask;
  if (f.witness && f.oracle == "metamorphic") {
    ask = oracles_named({"sight-lines", "point-occlusion"});
  } else if (const Oracle* oracle = oracle_of(f)) {
    ask = {oracle};
  }
  Outcome outcome;
  Exam exam(candidate, subject, outcome);
  for (const Oracle* oracle : ask) oracle->examine(exam);
  for (Finding& g : outcome.findings) {
    if (g.verdict != f.verdict) continue;
    g.oracle = f.oracle;
    return std::move(g);
  }
  return std::nullopt;
}

// A fault of the system is none of the scene's.
bool is_of_the_system(const scene::Error& error) {
  return error.code() == scene::ErrorCode::file_unwritable || error.code() == scene::ErrorCode::file_unreadable ||
         error.code() == scene::ErrorCode::file_not_found;
}

std::optional<Finding> again(const Finding& f, const Case& candidate, const Subject& subject) {
  try {
    return found_by_oracles(f, candidate, subject);
  } catch (const NoAnswer&) {  // another defect
  } catch (const scene::Error& error) {
    if (is_of_the_system(error)) throw;
  }
  return std::nullopt;
}

class Shrinker {
 public:
  Shrinker(const Finding& finding, const Subject& subject, const ShrinkLimits& limits)
      : best_(finding), subject_(subject), limits_(limits), end_(std::chrono::steady_clock::now() + limits.time) {}

  Shrunk run() {
    for (bool smaller = true; smaller && !spent();) {
      smaller = fewer_triangles();
      smaller = fewer_cell_points() || smaller;
      smaller = shorter_coordinates() || smaller;
      smaller = fewer_dials() || smaller;
    }
    return {std::move(best_), steps_};
  }

 private:
  bool spent() const { return steps_ >= limits_.steps || std::chrono::steady_clock::now() >= end_; }

  bool accept(const Case& candidate, std::optional<std::uint32_t> triangle) {
    if (spent()) return false;
    ++steps_;
    Finding moved = best_;
    moved.triangle = triangle;
    auto found = again(with_triangle(moved, triangle), candidate, subject_);
    if (!found) return false;
    best_ = std::move(*found);
    return true;
  }

  // The witness of best_ is about its triangle in best_'s mesh; in the candidate that triangle has another number.
  static Finding with_triangle(Finding f, std::optional<std::uint32_t> triangle) {
    f.triangle = triangle;
    return f;
  }

  // Delta debugging: halves, quarters, ... single triangles, from the back.
  bool fewer_triangles() {
    bool any = false;
    for (std::size_t chunk = std::max<std::size_t>(1, best_.where.mesh.triangles.size() / 2);; chunk /= 2) {
      for (std::size_t end = best_.where.mesh.triangles.size(); end > 0 && !spent();) {
        const std::size_t begin = end > chunk ? end - chunk : 0;
        any = without(begin, end) || any;
        end = begin;
      }
      if (chunk == 1) return any;
    }
  }

  bool without(std::size_t begin, std::size_t end) {
    const Case& old = best_.where;
    Case candidate = old;
    candidate.mesh = {};
    candidate.blocks.clear();
    candidate.counts.clear();
    std::optional<std::uint32_t> triangle;
    std::vector<std::uint32_t> number(old.mesh.points.size(), 0xffffffffU);
    for (std::size_t t = 0; t < old.mesh.triangles.size(); ++t) {
      const bool kept = best_.triangle == t;
      if (begin <= t && t < end && !kept) continue;
      if (kept) triangle = static_cast<std::uint32_t>(candidate.mesh.triangles.size());
      scene::Triangle corners = old.mesh.triangles[t];
      for (auto& c : corners) {
        if (number[c] == 0xffffffffU) {
          number[c] = static_cast<std::uint32_t>(candidate.mesh.points.size());
          candidate.mesh.points.push_back(old.mesh.points[c]);
        }
        c = number[c];
      }
      candidate.mesh.face_of.push_back(static_cast<std::uint32_t>(candidate.mesh.triangles.size()));
      candidate.mesh.triangles.push_back(corners);
      if (!old.blocks.empty()) candidate.blocks.push_back(old.blocks[t]);
      if (!old.counts.empty()) candidate.counts.push_back(old.counts[t]);
    }
    const std::size_t left = candidate.mesh.triangles.size();
    if (left == 0 || left == old.mesh.triangles.size()) return false;
    return accept(candidate, triangle);
  }

  bool fewer_cell_points() {
    bool any = false;
    for (std::size_t i = best_.where.cell.size(); i-- > 0 && best_.where.cell.size() > 1 && !spent();) {
      Case candidate = best_.where;
      candidate.cell.erase(candidate.cell.begin() + static_cast<std::ptrdiff_t>(i));
      any = accept(candidate, best_.triangle) || any;
    }
    return any;
  }

  // Those of the engine; what those of the scene have done is in the coordinates.
  bool fewer_dials() {
    bool any = false;
    for (const NamedDial& dial : all_dials()) {
      if (dial.of != NamedDial::Of::engine || !best_.where.dials.contains(dial.name)) continue;
      Case candidate = best_.where;
      candidate.dials.erase(dial.name);
      any = accept(candidate, best_.triangle) || any;
    }
    return any;
  }

  // Multiples of 1, 1/2, 1/4, ...: all coordinates at once first, then point by point.
  bool shorter_coordinates() {
    bool any = false;
    for (const int digits : {0, 1, 2, 4, 8, 16}) {
      if (rounded_all(digits)) {
        any = true;
        break;
      }
    }
    for (const bool cell : {true, false}) {
      const std::size_t n = (cell ? best_.where.cell : best_.where.mesh.points).size();
      for (std::size_t i = 0; i < n && !spent(); ++i) {
        for (const int digits : {0, 1, 2, 4, 8, 16}) {
          Case candidate = best_.where;
          auto& points = cell ? candidate.cell : candidate.mesh.points;
          if (!round(points[i], digits)) break;  // it is that short already
          if (!accept(candidate, best_.triangle)) continue;
          any = true;
          break;
        }
      }
    }
    return any;
  }

  bool rounded_all(int digits) {
    Case candidate = best_.where;
    bool changed = false;
    for (auto* points : {&candidate.mesh.points, &candidate.cell}) {
      for (Point& p : *points) changed = round(p, digits) || changed;
    }
    return changed && accept(candidate, best_.triangle);
  }

  static bool round(Point& p, int digits) {
    const Point old = p;
    for (double& x : p) x = std::ldexp(std::nearbyint(std::ldexp(x, digits)), -digits);
    return p != old;
  }

  Finding best_;
  const Subject& subject_;
  ShrinkLimits limits_;
  std::chrono::steady_clock::time_point end_;
  std::uint64_t steps_ = 0;
};

}  // namespace

std::optional<Finding> found_again(const Finding& finding, const Case& candidate, const Subject& subject) {
  return again(finding, candidate, subject);
}

Shrunk shrink(const Finding& finding, const Subject& subject, const ShrinkLimits& limits) {
  // Of a smaller surface the kernels may say rightly that it is none.
  if (subject.trial() && (finding.oracle == "subject" || !subject.trial()->is_a_mesh(finding.where)))
    return {finding, 0};
  return Shrinker(finding, subject, limits).run();
}

std::string flaw_of(const Finding& f, const Subject& subject) {
  if (f.witness) {
    const Witness w = to_witness(*f.witness);
    if (w.triangle >= f.where.mesh.triangles.size()) return "the witness names a triangle that the scene does not have";
    const auto checked = check_flagged_witness(flagged(f.where), exact::ConvexCell::from_doubles(f.where.cell), w);
    if (!checked.valid) return "the witness is no proof: " + checked.reason;
  }
  if (!f.witness || subject.trial())
    return found_by_oracles(f, f.where, subject) ? "" : "the oracle " + f.oracle + " does not find it again";
  const Witness w = to_witness(*f.witness);
  const Answer answer = subject.answer(f.where);
  const std::string verdict = verdict_of(f.where, answer, w);
  if (verdict != f.verdict) return "the subject does not deny what the witness proves";
  return {};
}

}  // namespace clues::fuzz
