// Text and JSON of a judgement (D19). Exact coordinates are strings; doubles beside them are for reading only.
#include "validate/verdicts/judge_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace clues::validate {
namespace {

using nlohmann::json;

json point_json(const exact::Point3& p) {
  return {{"exact", {exact::to_string_exact(p.x()), exact::to_string_exact(p.y()), exact::to_string_exact(p.z())}},
          {"estimate", exact::to_double_estimate(p)}};
}

json witness_json(const Witness& w) {
  return {
      {"triangle", w.triangle}, {"side", w.front ? "front" : "back"}, {"v", point_json(w.v)}, {"p", point_json(w.p)}};
}

std::string witness_line(const Witness& w) {
  return fmt::format("  triangle {}, {} side: free sight line from {} in the cell\n    to {} on the triangle\n",
                     w.triangle, w.front ? "front" : "back", to_string_exact(w.v), to_string_exact(w.p));
}

std::vector<std::uint32_t> with_verdict(const Judgement& judgement, TriangleVerdict verdict) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < judgement.triangles.size(); ++t) {
    if (judgement.triangles[t] == verdict) ids.push_back(t);
  }
  return ids;
}

std::string id_list(const std::vector<std::uint32_t>& ids, std::size_t limit) {
  std::string text;
  for (std::size_t i = 0; i < ids.size() && i < limit; ++i) text += fmt::format("{}{}", i ? ", " : "", ids[i]);
  if (ids.size() > limit) text += fmt::format(", ... ({} in all)", ids.size());
  return text;
}

std::string chain_lines(const Chain& chain) {
  std::string text = fmt::format("  triangle {}, {} side:\n", chain.triangle, chain.front ? "front" : "back");
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    text += fmt::format("    {} from {} to {}\n", i == 0 ? "seen" : "and on", to_string_exact(chain.links[i].v),
                        to_string_exact(chain.links[i].x));
  }
  return text;
}

json chain_json(const Chain& chain) {
  json links = json::array();
  for (const ChainLink& link : chain.links) links.push_back({{"v", point_json(link.v)}, {"x", point_json(link.x)}});
  return {{"triangle", chain.triangle}, {"side", chain.front ? "front" : "back"}, {"links", links}};
}

std::string bounds_text(const std::optional<Bounds>& bounds) {
  if (!bounds) return "-";
  if (bounds->at_least == bounds->at_most) return fmt::format("{:.4g}", bounds->at_least);
  return fmt::format("{:.4g} to {:.4g}", bounds->at_least, bounds->at_most);
}

json bounds_json(const std::optional<Bounds>& bounds) {
  if (!bounds) return nullptr;
  return {{"at_least", bounds->at_least}, {"at_most", bounds->at_most}};
}

json weights_json(const Weights& w) {
  const auto of = [&](double weight) { return w.range.area_moved_back(weight); };
  return {{"visible_listed", of(w.visible_listed)},
          {"visible_missing", of(w.visible_missing)},
          {"undecided_listed", of(w.undecided_listed)},
          {"undecided_missing", of(w.undecided_missing)},
          {"hidden_listed", of(w.hidden_listed)},
          {"overestimate_qo", bounds_json(over_estimate(w))},
          {"underestimate_qu", bounds_json(under_estimate(w))}};
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::sound:
      return "sound";
    case Verdict::undecided:
      return "undecided";
    case Verdict::unsound:
      return "unsound";
  }
  return "?";
}

const char* to_string(TriangleVerdict verdict) {
  switch (verdict) {
    case TriangleVerdict::hidden:
      return "hidden";
    case TriangleVerdict::missing_undecided:
      return "missing-undecided";
    case TriangleVerdict::missing_visible:
      return "missing-visible";
    case TriangleVerdict::exact:
      return "exact";
    case TriangleVerdict::first_order:
      return "first-order";
    case TriangleVerdict::loose:
      return "loose";
  }
  return "?";
}

std::string to_string_exact(const exact::Point3& p) {
  return fmt::format("({}, {}, {})", exact::to_string_exact(p.x()), exact::to_string_exact(p.y()),
                     exact::to_string_exact(p.z()));
}

std::string to_text(const Judgement& judgement, const Surroundings& around, std::size_t limit) {
  std::string text = fmt::format("verdict: {}\n", to_string(judgement.verdict));
  const auto missing = with_verdict(judgement, TriangleVerdict::missing_visible);
  if (!missing.empty()) {
    text += fmt::format("missing although visible: {}\n", id_list(missing, limit));
    std::size_t shown = 0;
    for (const auto& w : judgement.witnesses) {
      if (shown < limit && judgement.triangles[w.triangle] == TriangleVerdict::missing_visible) {
        text += witness_line(w);
        ++shown;
      }
    }
    for (const auto t : judgement.meet_cell) {
      if (shown < limit && judgement.triangles[t] == TriangleVerdict::missing_visible) {
        text += fmt::format("  triangle {} meets the cell\n", t);
        ++shown;
      }
    }
  }
  const auto undecided = with_verdict(judgement, TriangleVerdict::missing_undecided);
  if (!undecided.empty()) {
    text += fmt::format("missing, first-order visible, no witness found: {}\n", id_list(undecided, limit));
  }
  text +=
      fmt::format("listed: {} triangles: {} exact, {} first-order (no witness found), {} loose (certainly hidden)\n",
                  judgement.exact + judgement.first_order + judgement.loose, judgement.exact, judgement.first_order,
                  judgement.loose);
  if (!judgement.proved_hidden.empty()) {
    text += fmt::format("first-order visible, and proved hidden by an exhaustive search: {}\n",
                        id_list(judgement.proved_hidden, limit));
  }
  const auto undecided_count = judgement.first_order + judgement.missing_undecided;
  if (undecided_count > 0) {
    text += fmt::format("first-order visible without a sight line: {}, with a chain that proves it: {}\n",
                        undecided_count, judgement.chains.size());
    for (std::size_t i = 0; i < judgement.chains.size() && i < limit; ++i) text += chain_lines(judgement.chains[i]);
  }
  text += fmt::format("overestimate Qo = {}, in area {}\n", bounds_text(over_estimate(around.counts)),
                      bounds_text(over_estimate(around.areas)));
  text += fmt::format("underestimate Qu = {}, in area {}\n", bounds_text(under_estimate(around.counts)),
                      bounds_text(under_estimate(around.areas)));
  if (!judgement.contradictions.empty()) {
    text += "CONTRADICTION: the reference map hides what a confirmed sight line sees; please report this:\n";
    for (std::size_t i = 0; i < judgement.contradictions.size() && i < limit; ++i) {
      text += witness_line(judgement.contradictions[i]);
    }
  }
  return text;
}

std::string to_json_text(const Judgement& judgement, const Surroundings& around) {
  json verdicts = json::array(), witnesses = json::array(), contradictions = json::array(), chains = json::array(),
       fractions = json::array();
  for (const Chain& chain : judgement.chains) chains.push_back(chain_json(chain));
  for (const auto& [front, back] : around.first_order_fractions)
    fractions.push_back({exact::to_string_exact(front), exact::to_string_exact(back)});
  for (const auto verdict : judgement.triangles) verdicts.push_back(to_string(verdict));
  for (const auto& w : judgement.witnesses) witnesses.push_back(witness_json(w));
  for (const auto& w : judgement.contradictions) contradictions.push_back(witness_json(w));
  const json out = {{"format", "clues-judgement/1"},
                    {"verdict", to_string(judgement.verdict)},
                    {"counts",
                     {{"missing_visible", judgement.missing_visible},
                      {"missing_undecided", judgement.missing_undecided},
                      {"exact", judgement.exact},
                      {"first_order", judgement.first_order},
                      {"loose", judgement.loose}}},
                    {"triangles_measured", weights_json(around.counts)},
                    {"area_measured", weights_json(around.areas)},
                    {"first_order_fractions", fractions},
                    {"scene", around.scene},
                    {"cell", around.cell},
                    {"chains", chains},
                    {"proved_hidden", judgement.proved_hidden},
                    {"meet_cell", judgement.meet_cell},
                    {"triangles", verdicts},
                    {"witnesses", witnesses},
                    {"contradictions", contradictions}};
  return out.dump(2) + "\n";
}

}  // namespace clues::validate
