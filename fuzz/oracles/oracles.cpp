// The smaller oracles, the list of all, and one case from beginning to end.
#include <fmt/format.h>

#include <algorithm>

#include "exact/sight/scene_query.h"
#include "fuzz/findings/dials.h"
#include "fuzz/oracles/oracle.h"
#include "scene/messages/error.h"
#include "validate/verdicts/light_search.h"
#include "validate/visible_set/visible_set.h"

namespace clues::fuzz {
namespace {

using exact::Point3;

// D18: one point against all of the cell.
class PointOcclusion : public Oracle {
 public:
  const char* name() const override { return "point-occlusion"; }
  const char* what() const override { return "points of hidden regions, each against the whole cell, decided exactly"; }
  std::vector<const char*> needs() const override { return {"points occluded"}; }
  void examine(Exam& exam) const override {
    bool region = false, triangle = false;  // found
    for (const auto& d : exam.denied(3)) {
      bool& found = exam.lists(d.triangle) ? region : triangle;
      if (found) continue;
      const auto answer = exact::point_occlusion(d.p, d.side, exam.cell(), exam.soup());
      exam.count(answer.occluded ? "points occluded" : "points seen");
      if (answer.occluded || !answer.witness) continue;
      found = exam.claim(name(), {d.triangle, d.front, *answer.witness, d.p},
                         "some point of the cell sees this point, which is called hidden");
    }
  }
};

// D3: what meets the cell is visible.
class CellContact : public Oracle {
 public:
  const char* name() const override { return "cell-contact"; }
  const char* what() const override { return "triangles that meet the cell are visible, without a sight line"; }
  void examine(Exam& exam) const override {
    const auto& mesh = exam.scene().mesh;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (exam.lists(t) || !exam.is_surface(t)) continue;
      if (!exact::meets_cell(
              {exact::to_exact(mesh.points[a]), exact::to_exact(mesh.points[b]), exact::to_exact(mesh.points[c])},
              exam.cell()))
        continue;
      Finding f;
      f.oracle = name();
      f.verdict = "hidden/meets-cell";
      f.where = exam.scene();
      f.triangle = t;
      f.explanation = fmt::format("triangle {} meets the cell and is not listed", t);
      return exam.file(std::move(f));
    }
  }
};

// D6: light past what blocks, on triangles that are not listed (validate/verdicts/light_search.h).
class Light : public Oracle {
 public:
  const char* name() const override { return "light"; }
  const char* what() const override {
    return "triangles that are not listed, less the shadows of what blocks, from places of the cell";
  }
  std::vector<const char*> needs() const override { return {"triangles searched for light"}; }
  void examine(Exam& exam) const override {
    const auto& mesh = exam.scene().mesh;
    std::optional<validate::LightSearch> search;
    std::uint64_t searched = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size() && searched < most; ++t) {
      if (exam.lists(t) || !exam.is_surface(t)) continue;
      if (!search) search.emplace(mesh, exam.cell(), !exam.scene().solid);
      exam.count("triangles searched for light");
      ++searched;
      const auto witness = search->find(t);
      if (witness && exam.claim(name(), *witness, "there is light on a triangle that is not listed")) return;
    }
  }

 private:
  static constexpr std::uint64_t most = 64;
};

// D14: the label of a point does not depend on the point of the cell that the walk starts from.
class TwoWalks : public Oracle {
 public:
  const char* name() const override { return "two-walks"; }
  const char* what() const override {
    return "labels found by walks from two points of the cell must agree (maps only)";
  }
  void examine(Exam& exam) const override {
    if (!exam.answer().map) return;
    const auto& s = exam.map().statistics;
    exam.count("walks", s.walks);
    if (s.walk_disagreements == 0) return;
    Finding f;
    f.oracle = name();
    f.verdict = "label/other-label";
    f.where = exam.scene();
    f.explanation =
        fmt::format("{} labels depend on where the walk starts: an event surface is missing", s.walk_disagreements);
    exam.file(std::move(f));
  }
};

// D6, decided completely on scenes that are small enough (docs/visible-set.md).
class ExactVisibleSet : public Oracle {
 public:
  const char* name() const override { return "exact-visible-set"; }
  const char* what() const override {
    return "scenes of at most 10 triangles: everything that is visible, decided exactly";
  }
  void examine(Exam& exam) const override {
    if (exam.scene().mesh.triangles.size() > 10) return;
    exam.count("scenes decided completely");
    validate::VisibleSetOptions options;
    options.trust_map = false;
    if (exam.scene().solid) options.mode = reference::Mode::solid;
    const auto set = validate::exact_visible_set(exam.scene().mesh, exam.cell(), options);
    for (const auto& t : set.triangles) {
      if (t.witness && exam.claim(name(), *t.witness, "the exact visible set has a triangle that is not listed"))
        return;
    }
  }
};

// D9, D15: the reference's PVS and that of another computation of the same set. What one of the two knows to be in Omega the other has to list (D17b).
class Agreement : public Oracle {
 public:
  const char* name() const override { return "agreement"; }
  const char* what() const override { return "the PVS is the reference's, triangle by triangle (fast path only)"; }
  void examine(Exam& exam) const override {
    if (!exam.answer().in_doubt || !exam.is_compared()) return;
    exam.count("answers compared with the reference");
    const std::vector<std::uint32_t>&in_doubt = *exam.answer().in_doubt, &omega = exam.map().visible;
    exam.count("triangles in doubt", in_doubt.size());
    exam.count("triangles in doubt in the reference", exam.map().in_doubt.size());
    const auto has = [](const std::vector<std::uint32_t>& list, std::uint32_t t) {
      return std::binary_search(list.begin(), list.end(), t);
    };
    std::optional<std::uint32_t> less, more;
    for (std::uint32_t t = 0; t < exam.scene().mesh.triangles.size(); ++t) {
      if (has(omega, t) == exam.lists(t)) continue;
      if (exam.lists(t)) {
        exam.count("triangles more than the reference");
        if (!has(in_doubt, t) && !more) more = t;
      } else {
        exam.count("triangles less than the reference");
        if (!has(exam.map().in_doubt, t) && !less) less = t;
      }
    }
    if (less)
      differs(exam, *less, "hidden/first-order-visible",
              "has a visible region in the reference's map, and is not listed");
    if (more)
      differs(exam, *more, "visible/first-order-hidden",
              "is hidden in the reference's map, and listed without a doubt");
  }

 private:
  void differs(Exam& exam, std::uint32_t triangle, const char* verdict, const char* how) const {
    Finding f;
    f.oracle = name();
    f.verdict = verdict;
    f.where = exam.scene();
    f.triangle = triangle;
    f.explanation = fmt::format("triangle {} {}", triangle, how);
    exam.file(std::move(f));
  }
};

std::vector<std::unique_ptr<Oracle>> make_all() {
  std::vector<std::unique_ptr<Oracle>> all;
  all.push_back(make_sight_lines());
  all.push_back(make_point_occlusion());
  all.push_back(std::make_unique<Light>());
  all.push_back(std::make_unique<CellContact>());
  all.push_back(std::make_unique<ExactVisibleSet>());
  all.push_back(make_metamorphic());
  all.push_back(std::make_unique<TwoWalks>());
  all.push_back(std::make_unique<Agreement>());
  all.push_back(make_see_through());
  return all;
}

}  // namespace

std::unique_ptr<Oracle> make_point_occlusion() { return std::make_unique<PointOcclusion>(); }

const std::vector<std::unique_ptr<Oracle>>& all_oracles() {
  static const auto all = make_all();
  return all;
}

std::vector<const Oracle*> oracles_named(const std::vector<std::string>& names) {
  for (const auto& name : names) {
    if (std::none_of(all_oracles().begin(), all_oracles().end(), [&](const auto& o) { return o->name() == name; }))
      throw scene::Error(scene::ErrorCode::bad_argument,
                         "--oracle " + name + ": there is none of this name; `clues fuzz --help` lists them");
  }
  std::vector<const Oracle*> chosen;
  for (const auto& o : all_oracles()) {
    if (names.empty() || std::find(names.begin(), names.end(), o->name()) != names.end()) chosen.push_back(o.get());
  }
  return chosen;
}

Outcome judge_case(const Case& scene, const Subject& subject, const std::vector<const Oracle*>& oracles) {
  Outcome outcome;
  outcome.counters["cases of " + scene.generator] = 1;
  for (const auto& [name, value] : scene.dials) outcome.counters["dial " + name] = 1;
  try {
    Exam exam(scene, subject, outcome);
    for (const Oracle* oracle : oracles) oracle->examine(exam);
  } catch (const InputRefused& error) {  // made for a mode, and not fit for it
    outcome.contradictions.push_back(
        fmt::format("{} {} of seed {}: {}", scene.generator, scene.index, scene.seed, error.what()));
  } catch (const NoAnswer& error) {
    outcome.findings.push_back(without_answer(scene, error.what()));
  } catch (const scene::Error& error) {  // of an oracle, or of the reference as a guide
    outcome.contradictions.push_back(
        fmt::format("{} {} of seed {}: {}", scene.generator, scene.index, scene.seed, error.what()));
  }
  return outcome;
}

}  // namespace clues::fuzz
