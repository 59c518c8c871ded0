// D22: the case once more with random flags. Some of its triangles do not block, some do not count; which, is a function of the case's name and of their
// coordinates, so that they keep their flags when the case is shrunk, and no case is changed.
//
// The subject knows only triangles that block. It is asked layer by layer (validate/see_through/layers.h); the fast path is also asked as
// `clues bake` asks it. *Not to block only enlarges*: what a sight line of the unchanged case shows has to be listed, and so has what is seen past
// the triangles that do not block.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "exact/threads.h"
#include "fastpath/visibility/see_through.h"
#include "fuzz/generators/parts.h"
#include "fuzz/oracles/oracle.h"
#include "validate/see_through/layers.h"
#include "validate/verdicts/judge_report.h"

namespace clues::fuzz {
namespace {

using exact::Point3;
using Ids = std::vector<std::uint32_t>;

constexpr std::size_t kMostTriangles = 40;  // each layer is a map
constexpr int kLinesEach = 8;               // sight lines for each triangle that counts

std::uint64_t place_hash(const scene::TriangleMesh& mesh, const scene::Triangle& t) {
  std::uint64_t hash = 0;
  for (const auto corner : t) {
    for (const double x : mesh.points[corner]) hash = Random(hash ^ std::bit_cast<std::uint64_t>(x)).next();
  }
  return hash;
}

scene::FlaggedMesh with_flags(const Case& scene, std::uint64_t name) {
  scene::FlaggedMesh flagged{scene.mesh, {}, {}, {}};
  for (const auto& t : scene.mesh.triangles) {
    const int kind = Random(name ^ place_hash(scene.mesh, t)).between(0, 5);
    flagged.blocks.push_back(kind == 1 || kind == 2 ? 0 : 1);
    flagged.counts.push_back(kind == 0 ? 0 : 1);
  }
  return flagged;
}

class SeeThrough : public Oracle {
 public:
  const char* name() const override { return "see-through"; }
  const char* what() const override {
    return "random triangles do not block, others do not count: what was seen is still seen, and what is behind them";
  }
  std::vector<const char*> needs() const override {
    return {"scenes with flags", "seen past what does not block", "seen with and without flags"};
  }

  void examine(Exam& exam) const override {
    Random random = exam.random(name());
    const std::uint64_t salt = random.next();
    if (exam.scene().solid || exam.scene().mesh.triangles.size() > kMostTriangles || !random.one_in(3)) return;
    const auto flagged = with_flags(exam.scene(), salt);
    if (flagged.is_plain()) return;
    exam.count("scenes with flags");
    std::vector<std::pair<const char*, Ids>> lists;
    try {
      lists.emplace_back("in layers", validate::visible_in_layers(flagged, [&](const scene::TriangleMesh& mesh) {
                           Case layer = exam.scene();
                           layer.mesh = mesh;
                           return exam.subject().answer(layer).pvs;
                         }));
    } catch (const NoAnswer& error) {
      return exam.file(without_answer(exam.scene(), error.what()));
    }
    const std::string subject = exam.subject().name();
    if (subject == "fast" || subject.starts_with("fast/")) {  // with --agreement
      const fastpath::SeeThroughScene scene(flagged);
      lists.emplace_back("at once", exact::by_threads(1, [&] {
                           return fastpath::visible_through(scene, exam.scene().cell, {}).counting(flagged);
                         }));
    }
    for (const auto& [how, list] : lists) {
      if (look_for_missing(exam, flagged, how, list, random)) return;
    }
  }

 private:
  // Whether a finding was filed.
  bool look_for_missing(Exam& exam, const scene::FlaggedMesh& flagged, const char* how, const Ids& list,
                        Random& random) const {
    for (std::uint32_t t = 0; t < flagged.mesh.triangles.size(); ++t) {
      if (!flagged.counting(t) || !exam.is_surface(t)) continue;
      const auto alone = validate::asked_alone(flagged, t);
      const auto& [a, b, c] = flagged.mesh.triangles[t];
      const auto corner = [&](std::uint32_t i) { return exact::to_exact(flagged.mesh.points[i]); };
      const std::array<Point3, 3> corners{corner(a), corner(b), corner(c)};
      for (int i = 0; i < kLinesEach; ++i) {
        const Point3 p = exact::collapsed(CGAL::barycenter(corners[0], exact::FT(random.between(1, 16)), corners[1],
                                                           exact::FT(random.between(1, 16)), corners[2],
                                                           exact::FT(random.between(1, 16))));
        std::vector<int> weights;
        for (std::size_t k = 0; k < exam.cell().vertices().size(); ++k) weights.push_back(random.between(1, 16));
        const Point3 v = exam.cell().interior_point(weights);
        const bool front = exact::Plane3(corners[0], corners[1], corners[2]).has_on_positive_side(v);
        if (!exact::check_witness(alone.mesh, exam.cell(), alone.triangle, front, v, p).valid) continue;
        const bool unchanged = exact::check_witness(flagged.mesh, exam.cell(), t, front, v, p).valid;
        exam.count(unchanged ? "seen with and without flags" : "seen past what does not block");
        if (std::binary_search(list.begin(), list.end(), t)) break;
        Finding f;
        f.oracle = name();
        f.verdict = "hidden/seen-through";
        f.where = exam.scene();
        f.triangle = t;
        f.explanation = fmt::format(
            "triangles [{}] do not block; triangle {} is not listed ({}), and seen from {} at {}",
            fmt::join(passing(flagged), ", "), t, how, validate::to_string_exact(v), validate::to_string_exact(p));
        exam.file(std::move(f));
        return true;
      }
    }
    return false;
  }

  static Ids passing(const scene::FlaggedMesh& flagged) {
    Ids ids;
    for (std::uint32_t t = 0; t < flagged.mesh.triangles.size(); ++t) {
      if (!flagged.blocking(t)) ids.push_back(t);
    }
    return ids;
  }
};

}  // namespace

std::unique_ptr<Oracle> make_see_through() { return std::make_unique<SeeThrough>(); }

}  // namespace clues::fuzz
