#include "validate/multires/check_hierarchy.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/messages/error.h"

namespace clues::validate {
namespace {

constexpr std::uint64_t most_listed = 20;

}  // namespace

void HierarchyReport::find(const std::string& check, const std::string& what) {
  if (++counts[check] <= most_listed) findings.push_back({check, what});
}

HierarchyReport check_hierarchy(const scene::Hierarchy& hierarchy) {
  if (hierarchy.points.size() < hierarchy.input.points.size()) {
    throw scene::Error(scene::ErrorCode::bad_argument, "a hierarchy whose overlay lacks vertices of the input");
  }
  HierarchyReport report;
  check_levels(hierarchy, report);
  check_overlay(hierarchy, report);
  return report;
}

std::string to_text(const HierarchyReport& r) {
  std::string out = fmt::format("{:>5} {:>9} {:>9} {:>5} {:>6} {:>8} {:>7} {:>8} {:>6} {:>6} {:>5} {:>5} {:>8}\n",
                                "level", "vertices", "triangles", "chi", "bounds", "removed", "share", "blocked", "12+",
                                "fixed", "link", "flat", "numbers");
  for (std::size_t l = 0; l < r.levels.size(); ++l) {
    const LevelRow& row = r.levels[l];
    const bool base = l + 1 == r.levels.size();
    out += fmt::format("{:>5} {:>9} {:>9} {:>5} {:>6}", base ? "base" : fmt::format("{}", l + 1), row.vertices,
                       row.triangles, row.euler, row.boundaries);
    if (!base) {
      out += fmt::format(
          " {:>8} {:>6.2f}% {:>8} {:>6} {:>6} {:>5} {:>5} {:>8}", row.removed,
          100.0 * static_cast<double>(row.removed) / static_cast<double>(row.vertices > 0 ? row.vertices : 1),
          row.blocked, row.high, row.fixed, row.kept_link, row.kept_flat, row.kept_numbers);
    }
    out += "\n";
  }
  out += fmt::format("{} triangles on {}, by {} points and {} pieces\n", r.input_triangles, r.base_triangles, r.points,
                     r.pieces);
  out += fmt::format(
      "without the overlay, linear on input triangles: {} of {} that lie in one base triangle are flipped\n",
      r.linear_flips, r.linear_judged);
  if (r.remesh) {
    const auto bound = [](double x) { return std::isfinite(x) ? fmt::format("{}", x) : "none"; };
    out += fmt::format(
        "a remesh of {} vertices and {} triangles, by {} pieces: bounds {} (input to remesh), {} (remesh to input)\n",
        r.remesh->vertices, r.remesh->triangles, r.remesh->pieces, bound(r.remesh->to_remesh),
        bound(r.remesh->to_input));
  }
  for (const auto& f : r.findings) out += fmt::format("{} {}\n", f.check, f.what);
  for (const auto& [check, count] : r.counts) {
    if (count > most_listed) out += fmt::format("{}: {} findings, {} are listed\n", check, count, most_listed);
  }
  out += r.sound() ? "verified: a homeomorphism, piece by piece, and every level as stated\n" : "NOT verified\n";
  return out;
}

std::string to_json_text(const HierarchyReport& r) {
  nlohmann::json levels = nlohmann::json::array(), findings = nlohmann::json::array();
  for (const LevelRow& row : r.levels) {
    levels.push_back({{"vertices", row.vertices},
                      {"triangles", row.triangles},
                      {"euler", row.euler},
                      {"boundaries", row.boundaries},
                      {"removed", row.removed},
                      {"blocked", row.blocked},
                      {"degree_12_or_more", row.high},
                      {"fixed", row.fixed},
                      {"kept_link", row.kept_link},
                      {"kept_flat", row.kept_flat},
                      {"kept_numbers", row.kept_numbers}});
  }
  for (const auto& f : r.findings) findings.push_back({{"check", f.check}, {"what", f.what}});
  nlohmann::json out{{"format", "clues-maps-verdict/1"},
                     {"verified", r.sound()},
                     {"counts", r.counts},
                     {"findings", findings},
                     {"levels", levels},
                     {"input_triangles", r.input_triangles},
                     {"base_triangles", r.base_triangles},
                     {"points", r.points},
                     {"pieces", r.pieces},
                     {"linear_flips", r.linear_flips},
                     {"linear_judged", r.linear_judged}};
  if (r.remesh) {
    const auto bound = [](double x) { return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr); };
    out["remesh"] = {{"vertices", r.remesh->vertices},
                     {"triangles", r.remesh->triangles},
                     {"pieces", r.remesh->pieces},
                     {"to_remesh", bound(r.remesh->to_remesh)},
                     {"to_input", bound(r.remesh->to_input)}};
  }
  return out.dump(1) + "\n";
}

}  // namespace clues::validate
