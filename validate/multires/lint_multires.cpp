// Proves the cases of vectors/multires.
#include "validate/multires/lint_multires.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reference/multires/hierarchy.h"
#include "scene/messages/error.h"
#include "validate/multires/check_hierarchy.h"
#include "validate/multires/check_plain_map.h"
#include "validate/multires/level_topology.h"

namespace clues::validate {
namespace {

bool is_refused(const MultiresVector& test) {
  try {
    reference::checked_surface(test.mesh, test.id);
    return false;
  } catch (const scene::Error& error) {
    if (error.code() != scene::ErrorCode::unsupported) throw;
    return true;
  }
}

bool names(const scene::Triangle& t, std::uint32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); }

// By looking through all triangles: what D31 does not allow is there.
bool is_defect(const scene::TriangleMesh& mesh, const RefusedPlace& place) {
  const auto& triangles = mesh.triangles;
  if (place.triangle) {
    auto corners = triangles[*place.triangle];
    std::sort(corners.begin(), corners.end());
    const bool twice = std::adjacent_find(corners.begin(), corners.end()) != corners.end();
    return twice || std::count_if(triangles.begin(), triangles.end(), [&](scene::Triangle t) {
                      std::sort(t.begin(), t.end());
                      return t == corners;
                    }) > 1;
  }
  if (place.edge) {
    int forward = 0, backward = 0;
    for (const auto& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        forward += t[k] == (*place.edge)[0] && t[(k + 1) % 3] == (*place.edge)[1] ? 1 : 0;
        backward += t[k] == (*place.edge)[1] && t[(k + 1) % 3] == (*place.edge)[0] ? 1 : 0;
      }
    }
    return forward > 1 || backward > 1;
  }
  // One fan: from one triangle all others are reached over edges at the vertex.
  std::vector<scene::Triangle> around;
  for (const auto& t : triangles) {
    if (names(t, *place.vertex)) around.push_back(t);
  }
  std::set<std::uint32_t> reached;
  for (bool grown = !around.empty(); grown;) {
    grown = false;
    for (const auto& t : around) {
      const auto met = std::count_if(t.begin(), t.end(), [&](std::uint32_t v) { return reached.count(v) != 0; });
      if ((met == 0 && !reached.empty()) || met == 2) continue;
      for (const std::uint32_t v : t) grown = (v != *place.vertex && reached.insert(v).second) || grown;
    }
  }
  return std::any_of(around.begin(), around.end(),
                     [&](const scene::Triangle& t) {
                       return std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return reached.count(v) != 0; });
                     }) ||
         around.empty();
}

// What becomes of a vertex when it is the only one that may go; and whether the judge verifies that.
std::string vertex_word(const MultiresVector& test, std::uint32_t v, std::vector<std::string>& flaws) {
  reference::HierarchyOptions options;
  options.base_triangles = 0;
  options.features = test.features;
  for (std::uint32_t w = 0; w < test.mesh.points.size(); ++w) {
    if (w != v || std::find(test.fixed.begin(), test.fixed.end(), w) != test.fixed.end()) options.fixed.push_back(w);
  }
  auto h = reference::build_hierarchy(test.mesh, options);
  if (!check_hierarchy(h).sound())
    flaws.push_back(fmt::format("vertex {}: the reference and the judge contradict each other", v));
  if (!h.levels.empty()) return "removable";
  if (std::find(h.fixed.begin(), h.fixed.end(), v) != h.fixed.end()) return "fixed";
  std::set<std::uint32_t> around;  // and itself
  for (const auto& t : test.mesh.triangles) {
    if (names(t, v)) around.insert(t.begin(), t.end());
  }
  if (around.size() > 12) return "high";
  // A level that removes nothing is in no hierarchy; here the judge is asked which reason holds. Where a side is one triangle both do.
  for (const auto& [reason, word] :
       {std::pair{scene::KeptFor::flat, "flat"}, std::pair{scene::KeptFor::link, "link"}}) {
    h.levels = {{{}, {{v, reason}}}};
    if (check_hierarchy(h).sound()) return word;
  }
  flaws.push_back(fmt::format("vertex {}: stays, and no reason holds", v));
  return "";
}

SurfaceFacts facts_of(const MultiresVector& test, std::vector<std::string>& flaws) {
  SurfaceFacts out;
  const auto census = reference::checked_surface(test.mesh, test.id);
  out.components = census.components;
  out.genus = static_cast<std::uint64_t>(census.genus());
  out.boundaries = census.boundaries;
  const auto topology = topology_of(test.mesh.triangles, test.mesh.points.size());
  if (!topology.defect.empty() || topology.euler() != census.euler() ||
      topology.boundaries != static_cast<std::int64_t>(census.boundaries)) {
    flaws.emplace_back("the reference and OpenMesh contradict each other");
  }
  for (std::uint32_t v = 0; v < test.mesh.points.size(); ++v) out.vertices.push_back(vertex_word(test, v, flaws));
  reference::HierarchyOptions options;
  options.base_triangles = 0;
  options.features = test.features;
  options.fixed = test.fixed;
  if (!check_hierarchy(reference::build_hierarchy(test.mesh, options)).sound())
    flaws.emplace_back("the hierarchy of the reference is not verified");
  return out;
}

std::vector<std::string> checks_of(const std::map<std::string, std::uint64_t>& counts) {
  std::vector<std::string> out;
  for (const auto& [check, unused] : counts) out.push_back(check);
  return out;
}

std::string verdict_word(PlainVerdict verdict) {
  switch (verdict) {
    case PlainVerdict::proved:
      return "proved";
    case PlainVerdict::refuted:
      return "refuted";
    case PlainVerdict::undecided:
      break;
  }
  return "undecided";
}

std::vector<std::string> flaws_of_surface(const MultiresVector& test) {
  std::vector<std::string> out;
  if (test.refused) {
    if (!is_refused(test)) out.emplace_back("refused: the reference takes it");
    if (!is_defect(test.mesh, *test.refused)) out.emplace_back("refused: nothing is wrong at that place");
    return out;
  }
  if (is_refused(test)) return {"the reference refuses it"};
  const SurfaceFacts facts = facts_of(test, out);
  if (facts.components != test.facts->components) out.push_back(fmt::format("components: {}", facts.components));
  if (facts.genus != test.facts->genus) out.push_back(fmt::format("genus: {}", facts.genus));
  if (facts.boundaries != test.facts->boundaries) out.push_back(fmt::format("boundaries: {}", facts.boundaries));
  for (std::size_t v = 0; v < facts.vertices.size(); ++v) {
    if (facts.vertices[v] != test.facts->vertices[v])
      out.push_back(fmt::format("vertex {}: {}, not {}", v, facts.vertices[v], test.facts->vertices[v]));
  }
  return out;
}

struct MultiresCases {
  static MultiresTopic parse(std::string_view text, const std::string& file, bool drafts) {
    return parse_multires_topic(text, file, drafts);
  }
  static bool has_expectation(const MultiresVector& test) { return test.has_expectation(); }
  static void fill_in(MultiresVector& test) { validate::fill_in(test); }
  static std::vector<std::string> flaws_of(const MultiresVector& test) { return validate::flaws_of(test); }
  static std::string to_json_text(const MultiresTopic& topic) { return validate::to_json_text(topic); }
};

}  // namespace

std::vector<std::string> flaws_of(const MultiresVector& test) {
  if (test.kind == MultiresKind::surface) return flaws_of_surface(test);
  MultiresVector computed = test;
  fill_in(computed);
  std::vector<std::string> out;
  if (computed.findings != test.findings)
    out.push_back(fmt::format("findings: the judge has {}", fmt::join(*computed.findings, ", ")));
  if (computed.verdict != test.verdict) out.push_back("verdict: the judge says " + computed.verdict);
  return out;
}

void fill_in(MultiresVector& test) {
  switch (test.kind) {
    case MultiresKind::surface: {
      if (test.refused) return;
      if (is_refused(test)) {
        throw scene::Error(scene::ErrorCode::malformed,
                           fmt::format("{}: case '{}': is no surface; say where, as \"expect\": {{\"refused\": ...}}",
                                       test.file, test.id));
      }
      std::vector<std::string> flaws;
      test.facts = facts_of(test, flaws);
      return;
    }
    case MultiresKind::file:
      test.findings = checks_of(check_hierarchy(scene::parse_hierarchy(test.text, test.id)).counts);
      return;
    case MultiresKind::plain: {
      const auto report = check_plain_map(test.mesh, test.base, test.map, test.id);
      test.findings = checks_of(report.counts);
      test.verdict = verdict_word(report.verdict);
      return;
    }
  }
}

SideLintReport lint_multires_suite(const std::filesystem::path& folder, const SideLintOptions& options) {
  return lint_side_suite<MultiresCases>(folder, options);
}

}  // namespace clues::validate
