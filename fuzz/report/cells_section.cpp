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

ReportRow row_of(const json& cell) {
  const json &holes = cell.at("holes"), &contradictions = cell.at("contradictions");
  const auto undecided = cell.at("undecided").size();
  ReportRow row;
  row.verdict = !contradictions.empty() ? "contradiction"
                : !holes.empty()        ? "holes"
                : undecided > 0         ? "undecided"
                                        : "sound";
  row.bad = !contradictions.empty() || !holes.empty();
  row.name = "cell " + cell.at("cell").get<std::string>();
  if (const auto cluster = cell.at("cluster").get<std::int64_t>(); cluster >= 0)
    row.name += fmt::format(", cluster {}", cluster);
  row.note = fmt::format("{} listed, {} may be seen, {} witnessed; {} holes, {} undecided",
                         whole_number<std::uint64_t>(cell, "listed"), whole_number<std::uint64_t>(cell, "may_be_seen"),
                         whole_number<std::uint64_t>(cell, "witnessed"), holes.size(), undecided);
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
  for (const json& cell : cells) {
    listed += whole_number<std::uint64_t>(cell, "listed");
    seen += whole_number<std::uint64_t>(cell, "may_be_seen");
    witnessed += whole_number<std::uint64_t>(cell, "witnessed");
    section.rows.push_back(row_of(cell));
  }
  const auto average = [&](std::uint64_t n) {
    return cells.empty() ? 0.0 : static_cast<double>(n) / static_cast<double>(cells.size());
  };
  section.summary = fmt::format(
      "scene: {}\nlists: {}\n{} cells: on average {:.1f} triangles listed, {:.1f} may be seen, {:.1f} witnessed\n"
      "{} holes in {} cells, {} undecided; {} sight lines decided exactly\n",
      report.at("scene").at("file").get<std::string>(), report.at("lists").get<std::string>(), cells.size(),
      average(listed), average(seen), average(witnessed), whole_number<std::uint64_t>(report, "holes"),
      whole_number<std::uint64_t>(report, "cells_with_holes"), whole_number<std::uint64_t>(report, "undecided"),
      whole_number<std::uint64_t>(report, "sight_lines"));
  return section;
}

}  // namespace clues::fuzz
