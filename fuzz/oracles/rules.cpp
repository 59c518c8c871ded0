#include "fuzz/oracles/rules.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "exact/cell/standard_range.h"

namespace clues::fuzz {
namespace {

using reference::VisibilityMap;

struct Rule {
  const char* name;
  bool (*met)(const Case&, const VisibilityMap&);
};

bool some_piece(const VisibilityMap& map, bool (*is)(const VisibilityMap&, std::uint32_t)) {
  for (std::uint32_t p = 0; p < map.complex.pieces.size(); ++p) {
    if (is(map, p)) return true;
  }
  return false;
}

bool some_wedge(const VisibilityMap& map, bool (*is)(const reference::Wedge&)) {
  return std::any_of(map.wedges.begin(), map.wedges.end(), is);
}

bool is_cut_by_a_border(const VisibilityMap& map) {
  std::map<std::pair<std::uint32_t, bool>, int> labels;
  for (const auto& r : map.regions) labels[{r.piece, r.front}] |= r.visible ? 1 : 2;
  return std::any_of(labels.begin(), labels.end(), [](const auto& side) { return side.second == 3; });
}

const std::array rules{
    Rule{"D1 triangle without area", [](const Case&, const VisibilityMap& m) { return !m.complex.degenerate.empty(); }},
    Rule{"D1 out of the standard range",
         [](const Case& s, const VisibilityMap&) { return exact::StandardRange(s.mesh, s.cell).moves(); }},
    Rule{"D2 point", [](const Case&, const VisibilityMap& m) { return m.cell.dimension() == 0; }},
    Rule{"D2 segment", [](const Case&, const VisibilityMap& m) { return m.cell.dimension() == 1; }},
    Rule{"D2 polygon", [](const Case&, const VisibilityMap& m) { return m.cell.dimension() == 2; }},
    Rule{"D2 solid cell", [](const Case&, const VisibilityMap& m) { return m.cell.dimension() == 3; }},
    Rule{"D3 geometry in the cell",
         [](const Case&, const VisibilityMap& m) {
           return some_piece(m, [](const VisibilityMap& map, std::uint32_t p) { return bool{map.complex.in_cell[p]}; });
         }},
    Rule{"D4 solid mode", [](const Case& s, const VisibilityMap&) { return s.solid; }},
    Rule{"D10 SV-ME", [](const Case&, const VisibilityMap& m) { return m.statistics.sv_me > 0; }},
    Rule{"D11 SE-ME", [](const Case&, const VisibilityMap& m) { return m.statistics.se_me > 0; }},
    Rule{"D11 edge parallel to the cell",
         [](const Case&, const VisibilityMap& m) { return m.statistics.parallel_edges > 0; }},
    Rule{"D12 SE-MV", [](const Case&, const VisibilityMap& m) { return m.statistics.se_mv > 0; }},
    Rule{"D12 inside corner", [](const Case&, const VisibilityMap& m) { return m.statistics.inside_corners > 0; }},
    Rule{"D13 piece that nothing ends",
         [](const Case&, const VisibilityMap& m) {
           return some_wedge(m, [](const reference::Wedge& w) { return w.unbounded; });
         }},
    Rule{"D13 piece that a surface ends",
         [](const Case&, const VisibilityMap& m) {
           return some_wedge(m, [](const reference::Wedge& w) { return !w.unbounded; });
         }},
    Rule{"D14 walk", [](const Case&, const VisibilityMap& m) { return m.statistics.walks > 0; }},
    Rule{"D15 border on a surface", [](const Case&, const VisibilityMap& m) { return is_cut_by_a_border(m); }},
    Rule{"D15 region with a hole",
         [](const Case&, const VisibilityMap& m) {
           return std::any_of(m.regions.begin(), m.regions.end(), [](const auto& r) { return r.rings.size() > 1; });
         }},
    Rule{"D16 triangle cut by another",
         [](const Case&, const VisibilityMap& m) { return m.statistics.refined_triangles > 0; }},
    Rule{"D16 triangles upon each other",
         [](const Case&, const VisibilityMap& m) {
           return some_piece(
               m, [](const VisibilityMap& map, std::uint32_t p) { return map.complex.pieces[p].origins.size() > 1; });
         }},
    Rule{"D17 compound vertex", [](const Case&, const VisibilityMap& m) { return m.statistics.csv > 0; }},
    Rule{"D17 wedge of a compound vertex",
         [](const Case&, const VisibilityMap& m) { return m.statistics.generations > 0; }},
    Rule{"D17 wedge of a second generation",
         [](const Case&, const VisibilityMap& m) { return m.statistics.generations > 1; }},
    Rule{"D17 fallback", [](const Case&, const VisibilityMap& m) { return m.statistics.conservative_fallbacks > 0; }},
    Rule{"T5 traversal",
         [](const Case&, const VisibilityMap& m) { return m.formulation == reference::Formulation::traversal; }}};

// Which never come up in one map, and why.
struct Apart {
  std::string_view a;
  std::vector<std::string_view> b;
  const char* why;
};

const std::vector<Apart>& impossible() {
  static const std::vector<Apart> all{
      {"D2 point", {"D2 segment", "D2 polygon", "D2 solid cell"}, "a cell has one dimension (D2)"},
      {"D2 segment", {"D2 polygon", "D2 solid cell"}, "a cell has one dimension (D2)"},
      {"D2 polygon", {"D2 solid cell"}, "a cell has one dimension (D2)"},
      {"D3 geometry in the cell",
       {"D2 point", "D2 segment", "D2 polygon"},
       "only what lies in a solid cell does not block (D3)"},
      {"D2 point",
       {"D11 SE-ME", "D11 edge parallel to the cell"},
       "a plane touches it in a point, and in no edge (D11)"},
      {"D2 point",
       {"D12 SE-MV", "D12 inside corner", "D17 compound vertex", "D17 wedge of a compound vertex",
        "D17 wedge of a second generation"},
       "an anti-cone has no facet, which takes an edge of the cell (D12), and compound vertices have wedges of this "
       "kind only"}};
  return all;
}

// Null where they may.
const char* why_never(std::string_view a, std::string_view b) {
  const auto has = [](const Apart& apart, std::string_view x, std::string_view y) {
    return apart.a == x && std::find(apart.b.begin(), apart.b.end(), y) != apart.b.end();
  };
  const auto found = std::find_if(impossible().begin(), impossible().end(),
                                  [&](const Apart& apart) { return has(apart, a, b) || has(apart, b, a); });
  return found == impossible().end() ? nullptr : found->why;
}

std::string pair_of(const Rule& a, const Rule& b) { return std::string(a.name) + " + " + b.name; }

}  // namespace

void count_rules(const Case& scene, const VisibilityMap& map, Counters& counters) {
  std::vector<const Rule*> met;
  for (const Rule& r : rules) {
    if (r.met(scene, map)) met.push_back(&r);
  }
  for (std::size_t i = 0; i < met.size(); ++i) {
    ++counters[std::string("rule ") + met[i]->name];
    for (std::size_t k = i + 1; k < met.size(); ++k) ++counters["pair " + pair_of(*met[i], *met[k])];
  }
}

RulesMet rules_met(const Counters& counters) {
  RulesMet out;
  const auto met = [&](const Rule& r) { return counters.contains(std::string("rule ") + r.name); };
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (!met(rules[i])) out.never.emplace_back(rules[i].name);
    for (std::size_t k = i + 1; k < rules.size(); ++k) {
      const std::string pair = pair_of(rules[i], rules[k]);
      if (const char* why = why_never(rules[i].name, rules[k].name)) {
        ++out.impossible;
        if (counters.contains("pair " + pair)) out.wrongly_impossible.push_back(pair + ", though " + why);
        continue;
      }
      ++out.all_pairs;
      if (counters.contains("pair " + pair)) {
        ++out.pairs;
      } else if (met(rules[i]) && met(rules[k])) {
        out.apart.push_back(pair);
      }
    }
  }
  return out;
}

}  // namespace clues::fuzz
