// The facts of a case are computed once (Facts) and then compared with, or turned into, an expectation.
#include "validate/vectors/prove.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "reference/visibility/first_order.h"
#include "validate/see_through/layers.h"
#include "validate/vectors/rational_point.h"
#include "validate/vectors/short_witness.h"
#include "validate/verdicts/judge.h"
#include "validate/verdicts/judge_report.h"
#include "validate/visible_set/visible_set.h"

namespace clues::validate {
namespace {

using exact::FT;
using exact::Point3;

RationalPoint text_of(const Point3& p) {
  return {exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())};
}

template <class List>
bool contains(const List& ascending, std::uint32_t id) {
  return std::binary_search(ascending.begin(), ascending.end(), id);
}

// Weights of points of a triangle: the middle, beside each corner, beside each edge.
constexpr std::array<std::array<int, 3>, 7> kPlaces{
    {{1, 1, 1}, {61, 2, 1}, {1, 61, 2}, {2, 1, 61}, {31, 32, 1}, {1, 31, 32}, {32, 1, 31}}};

// A scene in which everything blocks, and what can be asked of its triangles. Triangles have the numbers of this scene.
class OpaqueFacts {
 public:
  OpaqueFacts(scene::TriangleMesh mesh, const exact::ConvexCell& cell, CaseMode mode)
      : mesh_(std::move(mesh)),
        cell_(cell),
        mode_(mode == CaseMode::solid ? reference::Mode::solid : reference::Mode::sheet),
        degenerate_(scene::degenerate_triangles(mesh_)),
        map_(reference::first_order_visibility(mesh_, cell_, options())) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!contains(degenerate_, t)) soup_.push_back(corners(t));
    }
  }

  const reference::VisibilityMap& map() const { return map_; }
  bool is_degenerate(std::uint32_t t) const { return contains(degenerate_, t); }
  bool in_omega(std::uint32_t t) const { return contains(map_.visible, t); }
  bool touches_cell(std::uint32_t t) const { return exact::meets_cell(corners(t), cell_); }

  exact::WitnessVerdict check(const Witness& w) const {
    if (solid() && !w.front) return {false, "a back side does not count in solid mode"};
    return exact::check_witness(mesh_, cell_, w.triangle, w.front, w.v, w.p);
  }

  exact::OcclusionAnswer oracle(std::uint32_t t, bool front, const Point3& p) const {
    const auto [a, b, c] = corners(t);
    const exact::Plane3 plane(a, b, c);
    return exact::point_occlusion(p, front ? plane : plane.opposite(), cell_, soup_);
  }

  // Asks the oracle at some places of t, on the sides that count. A sight line that it finds is confirmed before it is believed.
  std::optional<Witness> search_with_oracle(std::uint32_t t, std::uint64_t& asked) const {
    const auto [a, b, c] = corners(t);
    for (const auto& [i, j, k] : kPlaces) {
      const Point3 p = exact::collapsed(CGAL::barycenter(a, FT(i), b, FT(j), c, FT(k)));
      for (const bool front : {true, false}) {
        if (!front && solid()) continue;
        ++asked;
        const auto answer = oracle(t, front, p);
        if (answer.occluded || !answer.witness) continue;
        const Witness found{t, front, *answer.witness, p};
        if (check(found).valid) return found;
      }
    }
    return std::nullopt;
  }

  std::optional<Witness> search_witness(std::uint32_t t) const {
    if (auto found = short_witness(mesh_, cell_, t, solid())) return found;
    std::uint64_t unused = 0;
    auto found = search_with_oracle(t, unused);
    if (!found) {
      JudgeOptions only;
      only.only = {t};
      only.points_per_region = 40;
      const auto judgement = judge_pvs(mesh_, map_, {}, only);
      if (!judgement.witnesses.empty()) found = judgement.witnesses.front();
    }
    return found ? std::optional(shorter(*found)) : std::nullopt;
  }
  Witness shorter(const Witness& w) const { return shortened(mesh_, cell_, w); }

  // The visible set decided without the map, so that the two check each other. Computed when first asked for.
  const TriangleSight& exhaustively(std::uint32_t t) const {
    if (!visible_set_) {
      VisibleSetOptions only_exhaustive;
      only_exhaustive.mode = mode_;
      only_exhaustive.trust_map = false;
      visible_set_ = exact_visible_set(mesh_, cell_, only_exhaustive);
    }
    return visible_set_->triangles[t];
  }

 private:
  bool solid() const { return mode_ == reference::Mode::solid; }
  reference::Options options() const {
    reference::Options options;
    options.mode = mode_;
    options.check_two_walks = true;
    options.threads = 1;  // cases run side by side, in processes
    return options;
  }
  exact::TriangleCorners corners(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {exact::to_exact(mesh_.points[a]), exact::to_exact(mesh_.points[b]), exact::to_exact(mesh_.points[c])};
  }

  scene::TriangleMesh mesh_;
  exact::ConvexCell cell_;
  reference::Mode mode_;
  std::vector<std::uint32_t> degenerate_;
  reference::VisibilityMap map_;
  std::vector<exact::TriangleCorners> soup_;
  mutable std::optional<VisibleSet> visible_set_;
};

// D22, one triangle at a time: those that block are asked about in the scene of all that blocks, each of the others in that and itself alone.
class Facts {
 public:
  struct Asked {  // a triangle that counts
    std::uint32_t id = 0;
    const OpaqueFacts* scene = nullptr;
    std::uint32_t place = 0;  // its number there
  };

  explicit Facts(const VectorCase& c) {
    const auto cell = exact::ConvexCell::from_doubles(c.cell);
    const auto flagged = c.flagged();
    const OpaqueFacts* opaque = nullptr;
    for (std::uint32_t t = 0; t < c.mesh.triangles.size(); ++t) {
      if (!flagged.counting(t)) continue;
      AskedAlone alone = asked_alone(flagged, t);
      const OpaqueFacts* scene = flagged.blocking(t) ? opaque : nullptr;
      if (scene == nullptr) {
        scenes_.push_back(std::make_unique<OpaqueFacts>(std::move(alone.mesh), cell, c.mode));
        scene = scenes_.back().get();
      }
      if (flagged.blocking(t)) opaque = scene;
      asked_.push_back({t, scene, alone.triangle});
    }
  }

  const std::vector<Asked>& asked() const { return asked_; }  // ascending
  const std::vector<std::unique_ptr<OpaqueFacts>>& scenes() const { return scenes_; }
  // The triangle must count.
  const Asked& operator[](std::uint32_t t) const {
    return *std::find_if(asked_.begin(), asked_.end(), [&](const Asked& a) { return a.id == t; });
  }
  std::vector<std::uint32_t> degenerate() const {
    return those([](const Asked& a) { return a.scene->is_degenerate(a.place); });
  }
  std::vector<std::uint32_t> first_order_visible() const {
    return those([](const Asked& a) { return a.scene->in_omega(a.place); });
  }

 private:
  template <class Holds>
  std::vector<std::uint32_t> those(const Holds& holds) const {
    std::vector<std::uint32_t> ids;
    for (const Asked& a : asked_) {
      if (holds(a)) ids.push_back(a.id);
    }
    return ids;
  }

  std::vector<std::unique_ptr<OpaqueFacts>> scenes_;
  std::vector<Asked> asked_;
};

std::string ids(const std::vector<std::uint32_t>& list) { return fmt::format("[{}]", fmt::join(list, ", ")); }

std::string words(const Witness& w) {
  return fmt::format("free sight line from {} to {} on its {}", to_string_exact(w.v), to_string_exact(w.p),
                     w.front ? "front" : "back");
}

class Prover {
 public:
  explicit Prover(const VectorCase& c) : facts_(c), expect_(*c.expect) {}

  CaseProofs run() {
    if (const auto degenerate = facts_.degenerate(); expect_.no_surface != degenerate)
      complain("expect.no_surface", "without area are exactly " + ids(degenerate));
    for (const auto& seen : expect_.must_be_visible) prove_visible(seen);
    for (const auto& hidden : expect_.umbra) prove_umbra(hidden);
    prove_first_order();
    return std::move(proofs_);
  }

 private:
  void complain(const std::string& field, const std::string& message, bool contradiction = false) {
    proofs_.findings.push_back({field, message, contradiction});
  }

  void prove_visible(const MustBeVisible& seen) {
    const auto& [id, facts, t] = facts_[seen.triangle];
    const std::string field = fmt::format("expect.must_be_visible, triangle {}", id);
    if (facts->is_degenerate(t)) return complain(field, "has no area: it belongs into no_surface");
    const bool touches = facts->touches_cell(t);
    if (touches != seen.meets_cell) {
      return complain(field, touches ? "meets the cell: say \"meets_cell\": true" : "does not meet the cell");
    }
    if (touches) {
      ++proofs_.cell_contacts;
      return;
    }
    const Witness witness{t, seen.front, point_of(seen.v), point_of(seen.p)};
    if (text_of(witness.v) != seen.v || text_of(witness.p) != seen.p)
      complain(field, "a fraction is not in lowest terms");
    const auto verdict = facts->check(witness);
    if (!verdict.valid) return complain(field, "no witness: " + verdict.reason);
    ++proofs_.witnesses;
    ++proofs_.oracle_points;
    if (facts->oracle(t, seen.front, witness.p).occluded) {
      complain(field, "the witness is good, but the point-occlusion oracle calls p hidden", true);
    }
    if (!facts->in_omega(t)) complain(field, "the witness is good, but the first-order map calls it hidden", true);
  }

  void prove_umbra(const Umbra& hidden) {
    const auto& [id, facts, t] = facts_[hidden.triangle];
    const std::string field = fmt::format("expect.umbra, triangle {}", id);
    if (facts->is_degenerate(t)) return complain(field, "has no area: it belongs into no_surface");
    if (facts->touches_cell(t)) return complain(field, "is visible: it meets the cell");
    if (const auto seen = facts->search_with_oracle(t, proofs_.oracle_points)) {
      return complain(field, "is visible: " + words(*seen), !facts->in_omega(t));
    }
    const bool by_map = !facts->in_omega(t);
    if (by_map != (hidden.proof == UmbraProof::first_order_map)) {
      return complain(field, by_map ? "is outside Omega: the proof is first_order_map"
                                    : "is inside Omega: first_order_map does not prove it hidden");
    }
    const auto& sight = facts->exhaustively(t);
    if (sight.sight == Sight::visible) {
      return complain(field, "is visible: " + (sight.witness ? words(*sight.witness) : "it meets the cell"), by_map);
    }
    if (sight.sight == Sight::hidden) ++proofs_.umbra_exhaustive;
    if (by_map) {
      ++proofs_.umbra_by_map;
    } else if (sight.sight != Sight::hidden) {
      complain(field, "could not be decided exhaustively");
    }
  }

  void prove_first_order() {
    if (const auto visible = facts_.first_order_visible(); expect_.first_order_visible != visible)
      complain("expect.first_order_visible", "the first-order visible triangles are exactly " + ids(visible));
    for (const auto& scene : facts_.scenes()) {
      const auto& statistics = scene->map().statistics;
      if (statistics.walk_disagreements != 0) complain("scene", "two walks to one point disagree (D14)", true);
      // A limit makes a map larger: where all that it lists is seen, it is right for all that.
      if (statistics.conservative_fallbacks != 0 && !all_listed_are_seen())
        complain("scene", "the map was cut short by the generation limit (D17): too hard to be a case");
    }
  }

  bool all_listed_are_seen() const {
    return std::all_of(expect_.first_order_visible.begin(), expect_.first_order_visible.end(), [&](std::uint32_t t) {
      return std::any_of(expect_.must_be_visible.begin(), expect_.must_be_visible.end(),
                         [&](const auto& seen) { return seen.triangle == t; });
    });
  }

  Facts facts_;
  const Expectation& expect_;
  CaseProofs proofs_;
};

}  // namespace

CaseProofs prove_case(const VectorCase& c) { return Prover(c).run(); }

std::optional<Expectation> derive_expectation(const VectorCase& c, std::string& why) {
  const Facts all(c);
  Expectation expect;
  expect.no_surface = all.degenerate();
  expect.first_order_visible = all.first_order_visible();
  for (const Facts::Asked& asked : all.asked()) {
    const OpaqueFacts& facts = *asked.scene;
    const std::uint32_t id = asked.id, t = asked.place;
    if (facts.is_degenerate(t)) continue;
    if (facts.touches_cell(t)) {
      expect.must_be_visible.push_back({id, true, true, {}, {}});
      continue;
    }
    if (!facts.in_omega(t)) {
      expect.umbra.push_back({id, UmbraProof::first_order_map});
      continue;
    }
    if (c.expect) {
      const auto& old = c.expect->must_be_visible;
      const auto same =
          std::find_if(old.begin(), old.end(), [&](const auto& o) { return o.triangle == id && !o.meets_cell; });
      if (same != old.end() && facts.check({t, same->front, point_of(same->v), point_of(same->p)}).valid) {
        expect.must_be_visible.push_back(
            {id, false, same->front, text_of(point_of(same->v)), text_of(point_of(same->p))});
        continue;
      }
    }
    if (const auto found = facts.search_witness(t)) {
      expect.must_be_visible.push_back({id, false, found->front, text_of(found->v), text_of(found->p)});
      continue;
    }
    const auto& sight = facts.exhaustively(t);
    if (sight.sight == Sight::visible && sight.witness) {
      const Witness found = facts.shorter(*sight.witness);
      expect.must_be_visible.push_back({id, false, found.front, text_of(found.v), text_of(found.p)});
    } else if (sight.sight == Sight::hidden) {
      expect.umbra.push_back({id, UmbraProof::exhaustive});
    } else {
      why = fmt::format("triangle {} is first-order visible, and could not be decided", id);
      return std::nullopt;
    }
  }
  return expect;
}

}  // namespace clues::validate
