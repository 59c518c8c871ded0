#include "fuzz/report/cells_section.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "fuzz/findings/json_fields.h"

namespace clues::fuzz {
namespace {

using nlohmann::json;

// One sight line a triangle: from the cell to a point of it.
std::string lines_of(const json& witnesses) {
  std::string text;
  for (const json& w : witnesses) {
    const auto v = three_texts(w.at("v")), p = three_texts(w.at("p"));
    text += fmt::format("triangle {} ({}), {} side: free sight line\n  from ({}, {}, {})\n  to   ({}, {}, {})\n",
                        whole_number<std::uint32_t>(w, "triangle"), w.at("part").get<std::string>(),
                        w.at("side").get<std::string>(), v[0], v[1], v[2], p[0], p[1], p[2]);
  }
  return text;
}

// Of the kernel; without it (null) nobody knows.
std::uint64_t may_be_seen(const json& cell) {
  return cell.at("may_be_seen").is_null() ? 0 : whole_number<std::uint64_t>(cell, "may_be_seen");
}

ReportRow row_of(const json& cell) {
  const json &holes = cell.at("holes"), &contradictions = cell.at("contradictions");
  const auto undecided = cell.at("undecided").size(), beyond = cell.value("beyond", json::array()).size();
  const bool by_lines_alone = cell.at("may_be_seen").is_null();
  ReportRow row;
  row.verdict = !contradictions.empty() ? "contradiction"
                : !holes.empty()        ? "holes"
                : undecided > 0         ? "undecided"
                : beyond > 0            ? "beyond"
                : by_lines_alone        ? "nothing found"
                                        : "sound";
  row.bad = !contradictions.empty() || !holes.empty();
  row.name = "cell " + cell.at("cell").get<std::string>();
  if (const auto cluster = cell.at("cluster").get<std::int64_t>(); cluster >= 0)
    row.name += fmt::format(", cluster {}", cluster);
  row.note =
      fmt::format("{} listed, {}{} witnessed; {} holes, {} undecided", whole_number<std::uint64_t>(cell, "listed"),
                  by_lines_alone ? std::string() : fmt::format("{} may be seen, ", may_be_seen(cell)),
                  whole_number<std::uint64_t>(cell, "witnessed"), holes.size(), undecided);
  if (beyond > 0) row.note += fmt::format(", {} beyond the far plane", beyond);
  row.details = lines_of(holes);
  if (!contradictions.empty())
    row.details += "called hidden by clues, and seen; please report:\n" + lines_of(contradictions);
  return row;
}

}  // namespace

ReportSection cells_section(const json& report) {
  const json& cells = report.at("cells");
  ReportSection section;
  std::uint64_t listed = 0, seen = 0, witnessed = 0;
  bool by_lines_alone = false;
  for (const json& cell : cells) {
    listed += whole_number<std::uint64_t>(cell, "listed");
    seen += may_be_seen(cell);
    by_lines_alone = by_lines_alone || cell.at("may_be_seen").is_null();
    witnessed += whole_number<std::uint64_t>(cell, "witnessed");
    section.rows.push_back(row_of(cell));
  }
  const auto average = [&](std::uint64_t n) {
    return cells.empty() ? 0.0 : static_cast<double>(n) / static_cast<double>(cells.size());
  };
  const auto beyond = report.contains("beyond") ? whole_number<std::uint64_t>(report, "beyond") : 0;
  section.summary = fmt::format(
      "scene: {}\nlists: {}\n{} cells: on average {:.1f} triangles listed, {}{:.1f} witnessed\n"
      "{} holes in {} cells, {} undecided{}; {} sight lines decided exactly{}\n",
      report.at("scene").at("file").get<std::string>(), report.at("lists").get<std::string>(), cells.size(),
      average(listed), by_lines_alone ? std::string() : fmt::format("{:.1f} may be seen, ", average(seen)),
      average(witnessed), whole_number<std::uint64_t>(report, "holes"),
      whole_number<std::uint64_t>(report, "cells_with_holes"), whole_number<std::uint64_t>(report, "undecided"),
      beyond > 0 ? fmt::format(", {} missing and beyond the far plane", beyond) : std::string(),
      whole_number<std::uint64_t>(report, "sight_lines"),
      by_lines_alone ? ", and nothing else: where they found no hole, nothing is proved" : "");
  return section;
}

}  // namespace clues::fuzz
