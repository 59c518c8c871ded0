// D19, D22. A triangle that does not block is decided by the layer that it leaves, or by the last one. What is proved hidden in an earlier layer is hidden
// there only, where others block that do not: it stays.
#include "validate/see_through/judge_layers.h"

#include <algorithm>
#include <utility>

#include "validate/certificates/chain_search.h"
#include "validate/see_through/layers.h"
#include "validate/verdicts/measures.h"
#include "validate/visible_set/settle.h"

namespace clues::validate {
namespace {

bool has(const std::vector<std::uint32_t>& ascending, std::uint32_t id) {
  return std::binary_search(ascending.begin(), ascending.end(), id);
}

class LayerJudge {
 public:
  LayerJudge(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell, const std::vector<std::uint32_t>& pvs,
             const reference::Options& options)
      : cell_(cell), pvs_(pvs), options_(options) {
    out_.judgement.triangles.resize(scene.mesh.triangles.size(), TriangleVerdict::hidden);
    out_.first_order_fractions.resize(scene.mesh.triangles.size(), {exact::FT(0), exact::FT(0)});
  }

  std::vector<std::uint32_t> decide(const Layer& layer) {
    ++out_.layers;
    const auto map = reference::first_order_visibility(layer.mesh, cell_, options_);
    JudgeOptions judge_options;
    judge_options.only = layer.asked;
    Judgement found = judge_pvs(layer.mesh, map, listed_in(layer), judge_options);
    if (layer.mesh.triangles.size() <= kSettleTriangles) settle(found, layer.mesh, cell_, options_.mode);
    std::vector<std::uint32_t> decided;
    for (const auto t : layer.asked) {
      if (has(map.visible, t) && !has(found.proved_hidden, t)) decided.push_back(t);
    }
    const auto& settled = !layer.see_through || decided.empty() ? layer.asked : decided;
    take(layer, found, first_order_fractions(layer.mesh, map), settled);
    take_chains(layer, map, found, settled);
    return decided;
  }

  SeeThroughJudgement finished() {
    Judgement& all = out_.judgement;
    for (const auto verdict : all.triangles) {
      if (verdict == TriangleVerdict::missing_undecided) ++all.missing_undecided;
      if (verdict == TriangleVerdict::missing_visible) ++all.missing_visible;
      if (verdict == TriangleVerdict::exact) ++all.exact;
      if (verdict == TriangleVerdict::first_order) ++all.first_order;
      if (verdict == TriangleVerdict::loose) ++all.loose;
    }
    const auto by_triangle = [](const Witness& a, const Witness& b) { return a.triangle < b.triangle; };
    std::sort(all.witnesses.begin(), all.witnesses.end(), by_triangle);
    std::sort(all.contradictions.begin(), all.contradictions.end(), by_triangle);
    std::sort(all.chains.begin(), all.chains.end(),
              [](const Chain& a, const Chain& b) { return a.triangle < b.triangle; });
    std::sort(all.meet_cell.begin(), all.meet_cell.end());
    std::sort(all.proved_hidden.begin(), all.proved_hidden.end());
    all.verdict = verdict_of(all);
    return std::move(out_);
  }

 private:
  std::vector<std::uint32_t> listed_in(const Layer& layer) const {
    std::vector<std::uint32_t> listed;
    for (std::uint32_t t = 0; t < layer.ids.size(); ++t) {
      if (has(pvs_, layer.ids[t])) listed.push_back(t);
    }
    return listed;
  }

  void take(const Layer& layer, const Judgement& found, const std::vector<std::array<exact::FT, 2>>& fractions,
            const std::vector<std::uint32_t>& decided) {
    Judgement& all = out_.judgement;
    for (const auto t : decided) {
      all.triangles[layer.ids[t]] = found.triangles[t];
      out_.first_order_fractions[layer.ids[t]] = fractions[t];
    }
    const auto take_ids = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
      for (const auto t : from) {
        if (has(decided, t)) to.push_back(layer.ids[t]);
      }
    };
    const auto take_witnesses = [&](const std::vector<Witness>& from, std::vector<Witness>& to, bool any) {
      for (Witness w : from) {
        if (!any && !has(decided, w.triangle)) continue;
        w.triangle = layer.ids[w.triangle];
        to.push_back(std::move(w));
      }
    };
    take_ids(found.meet_cell, all.meet_cell);
    take_ids(found.proved_hidden, all.proved_hidden);
    take_witnesses(found.witnesses, all.witnesses, false);
    take_witnesses(found.contradictions, all.contradictions, true);  // a layer is a scene like any other
  }

  // A chain that is free of a layer is free of what blocks: with fewer triangles every continuation is longer (D8).
  void take_chains(const Layer& layer, const reference::VisibilityMap& map, const Judgement& found,
                   const std::vector<std::uint32_t>& decided) {
    std::vector<std::uint32_t> open;
    for (const auto t : undecided(found)) {
      if (has(decided, t)) open.push_back(t);
    }
    for (Chain chain : find_chains(layer.mesh, map, open)) {
      chain.triangle = layer.ids[chain.triangle];
      out_.judgement.chains.push_back(std::move(chain));
    }
  }

  const exact::ConvexCell& cell_;
  const std::vector<std::uint32_t>& pvs_;
  const reference::Options& options_;
  SeeThroughJudgement out_;
};

}  // namespace

SeeThroughJudgement judge_see_through(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell,
                                      const std::vector<std::uint32_t>& pvs, const reference::Options& options) {
  LayerJudge judge(scene, cell, pvs, options);
  each_layer(scene, [&](const Layer& layer) { return judge.decide(layer); });
  return judge.finished();
}

}  // namespace clues::validate
