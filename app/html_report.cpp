#include "app/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "fuzz/campaign/finding_folder.h"
#include "scene/error.h"
#include "scene/json_reader.h"
#include "scene/mesh_io.h"
#include "validate/vectors/reader.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

constexpr std::size_t largest_picture = 2000;  // triangles

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string picture(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell,
                    std::optional<std::uint32_t> triangle, const std::optional<fuzz::WitnessText>& witness) {
  if (mesh.triangles.size() > largest_picture || cell.empty()) return "";
  fuzz::Finding finding;
  finding.where.mesh = mesh;
  finding.where.cell = cell;
  finding.triangle = triangle;
  finding.witness = witness;
  return fuzz::picture_of(finding);
}

using Coordinates = std::array<std::string, 3>;

fuzz::WitnessText witness_of(const json& w, const Coordinates& v, const Coordinates& p) {
  return {w.at("triangle").get<std::uint32_t>(), w.at("side") == "front", v, p};
}

std::string sight_text(const fuzz::WitnessText& w) {
  return fmt::format("free sight line from ({}, {}, {})\nto ({}, {}, {})\n", w.v[0], w.v[1], w.v[2], w.p[0], w.p[1],
                     w.p[2]);
}

std::string bounds_text(const json& bounds) {
  if (bounds.is_null()) return "-";
  const double low = bounds.at("at_least").get<double>(), high = bounds.at("at_most").get<double>();
  return low == high ? fmt::format("{:.4g}", low) : fmt::format("{:.4g} to {:.4g}", low, high);
}

ReportSection judgement_section(const json& j) {
  ReportSection section;
  const json &counts = j.at("triangles_measured"), &areas = j.at("area_measured");
  section.summary =
      fmt::format("verdict: {}\nscene: {}\noverestimate Qo = {}, in area {}\nunderestimate Qu = {}, in area {}\n",
                  j.at("verdict").get<std::string>(), j.at("scene").get<std::string>(),
                  bounds_text(counts.at("overestimate_qo")), bounds_text(areas.at("overestimate_qo")),
                  bounds_text(counts.at("underestimate_qu")), bounds_text(areas.at("underestimate_qu")));
  std::map<std::uint32_t, fuzz::WitnessText> witnesses;
  for (const json& w : j.at("witnesses")) {
    const auto found =
        witness_of(w, w.at("v").at("exact").get<Coordinates>(), w.at("p").at("exact").get<Coordinates>());
    witnesses.emplace(found.triangle, found);
  }
  std::map<std::uint32_t, std::string> chains;
  for (const json& chain : j.at("chains")) {
    std::string& text = chains[chain.at("triangle").get<std::uint32_t>()];
    for (const json& link : chain.at("links")) {
      const auto v = link.at("v").at("exact").get<Coordinates>(), x = link.at("x").at("exact").get<Coordinates>();
      text += fmt::format("{} from ({}, {}, {})\n  to ({}, {}, {})\n", text.empty() ? "seen" : "and on", v[0], v[1],
                          v[2], x[0], x[1], x[2]);
    }
  }
  std::optional<scene::TriangleMesh> mesh;
  if (fs::exists(j.at("scene").get<std::string>())) mesh = scene::read_mesh(j.at("scene").get<std::string>());
  const auto cell = j.at("cell").get<std::vector<scene::Point>>();
  const json& verdicts = j.at("triangles");
  for (std::uint32_t t = 0; t < verdicts.size(); ++t) {
    ReportRow row;
    row.verdict = verdicts[t].get<std::string>();
    row.name = fmt::format("triangle {}", t);
    row.bad = row.verdict == "missing-visible";
    const auto seen = witnesses.find(t);
    const auto chain = chains.find(t);
    if (seen != witnesses.end() && row.bad) row.details = sight_text(seen->second);
    if (chain != chains.end()) row.details = "first-order visible, by this chain:\n" + chain->second;
    if (row.bad && mesh && t < mesh->triangles.size()) {
      row.picture = picture(*mesh, cell, t, seen != witnesses.end() ? std::optional(seen->second) : std::nullopt);
    }
    section.rows.push_back(std::move(row));
  }
  return section;
}

ReportSection conformance_section(const json& j) {
  ReportSection section;
  const json& total = j.at("total");
  section.summary = fmt::format(
      "implementation: {} {}\nsubject: {}\nsuite: {}\n{} cases: ", j.at("implementation").at("name").get<std::string>(),
      j.at("implementation").at("version").get<std::string>(), j.at("subject").get<std::string>(),
      j.at("suite").get<std::string>(), total.at("cases").get<std::uint64_t>());
  for (const auto& [outcome, count] : total.at("outcomes").items()) {
    if (count != 0) section.summary += fmt::format("{} {}, ", count.get<std::uint64_t>(), outcome);
  }
  section.summary +=
      fmt::format("Qo = {}, Qu = {}\n", total.at("overestimate_qo").dump(), total.at("underestimate_qu").dump());
  std::map<std::string, validate::VectorCase> suite;
  if (fs::exists(fs::path(j.at("suite").get<std::string>()) / "index.json")) {
    for (auto& c : validate::read_suite(j.at("suite").get<std::string>())) suite.emplace(c.id, std::move(c));
  }
  for (const json& c : j.at("cases")) {
    ReportRow row;
    row.verdict = c.at("outcome").get<std::string>();
    row.name = c.at("id").get<std::string>();
    row.bad = row.verdict == "unsound" || row.verdict == "malformed_output" || row.verdict == "crash" ||
              row.verdict == "timeout";
    row.note = c.value("message", "");
    if (c.contains("extra") && !c.at("extra").empty())
      row.note += fmt::format("{} listed without being visible", c.at("extra").size());
    if (row.bad) row.details = "repeat: " + j.at("repeat").get<std::string>() + " --case " + row.name + "\n";
    const auto test = suite.find(row.name);
    if (test != suite.end()) row.note += (row.note.empty() ? "" : ". ") + test->second.comment;
    if (c.contains("missed") && !c.at("missed").empty()) {
      const json& first = c.at("missed").front();
      std::optional<fuzz::WitnessText> witness;
      if (first.contains("v")) {
        witness = witness_of(first, first.at("v").get<Coordinates>(), first.at("p").get<Coordinates>());
        row.details += fmt::format("missing: triangle {}, {}", witness->triangle, sight_text(*witness));
      } else {
        row.details +=
            fmt::format("missing: triangle {}, which meets the cell\n", first.at("triangle").get<std::uint32_t>());
      }
      if (test != suite.end()) {
        row.picture = picture(test->second.mesh, test->second.cell, first.at("triangle").get<std::uint32_t>(), witness);
      }
    }
    section.rows.push_back(std::move(row));
  }
  return section;
}

ReportSection finding_section(const fs::path& folder) {
  const fuzz::SavedFinding saved = fuzz::load_finding(folder);
  const fuzz::Finding& f = saved.finding;
  ReportSection section;
  section.summary = "subject: " + saved.subject + "\n";
  ReportRow row{f.verdict, f.oracle, f.explanation, true, "verify: clues replay " + folder.string() + "\n", ""};
  if (f.witness) row.details += sight_text(*f.witness);
  row.picture = picture(f.where.mesh, f.where.cell, f.triangle, f.witness);
  section.rows.push_back(std::move(row));
  return section;
}

std::optional<ReportSection> section_of(const fs::path& file) {
  const json j = scene::read_json_file(file);
  if (!j.is_object() || !j.contains("format")) return std::nullopt;
  try {
    if (j.at("format") == "clues-judgement/1") return judgement_section(j);
    if (j.at("format") == "clues-conformance/1") return conformance_section(j);
    if (j.at("format") == "clues-finding/1") return finding_section(file.parent_path());
  } catch (const json::exception& error) {
    throw Error(ErrorCode::malformed, file.string() + ": is no complete result of this version of clues (" +
                                          error.what() + "); make it anew");
  }
  return std::nullopt;
}

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>clues report</title><style>
body{font:15px/1.4 sans-serif;margin:2em auto;max-width:75em;padding:0 1em;color:#222}
table{border-collapse:collapse;width:100%}td,th{border-bottom:1px solid #ccc;padding:.3em .6em;text-align:left;vertical-align:top}
pre{background:#f4f4f4;padding:.6em;overflow:auto;white-space:pre-wrap;word-break:break-all}
.bad td:first-child{color:#b00000;font-weight:bold}svg{max-width:100%;height:auto}
</style></head><body><h1>clues report</h1>
<p>Pictures are seen from above (x to the right, y up): cell blue, the triangle in question red, sight line green.</p>
<p><label>Show <select id="verdict"><option value="">every verdict</option>)";

constexpr const char* script = R"(<script>
const verdict=document.getElementById('verdict'),text=document.getElementById('text');
function filter(){for(const row of document.querySelectorAll('tr[data-verdict]'))
row.hidden=(verdict.value!==''&&row.dataset.verdict!==verdict.value)||!row.textContent.includes(text.value);}
verdict.oninput=filter;text.oninput=filter;
</script></body></html>
)";

}  // namespace

std::vector<ReportSection> read_results(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw Error(ErrorCode::file_not_found,
                folder.string() + ": there is no such folder; give one with results of clues");
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<ReportSection> sections;
  for (const fs::path& file : files) {
    if (auto section = section_of(file)) {
      section->title = fs::relative(file, folder).string();
      sections.push_back(std::move(*section));
    }
  }
  return sections;
}

std::string to_html(const std::vector<ReportSection>& sections) {
  std::set<std::string> verdicts;
  for (const auto& section : sections) {
    for (const auto& row : section.rows) verdicts.insert(row.verdict);
  }
  std::string html = head;
  for (const auto& verdict : verdicts) html += fmt::format("<option>{}</option>", escaped(verdict));
  html += "</select></label> <label>with <input id=\"text\" placeholder=\"some text\"></label></p>\n";
  for (const auto& section : sections) {
    html += fmt::format("<h2>{}</h2>\n<pre>{}</pre>\n<table><tr><th>verdict</th><th>what</th><th>notes</th></tr>\n",
                        escaped(section.title), escaped(section.summary));
    for (const auto& row : section.rows) {
      html += fmt::format("<tr data-verdict=\"{0}\"{1}><td>{0}</td><td>{2}</td><td>{3}", escaped(row.verdict),
                          row.bad ? " class=\"bad\"" : "", escaped(row.name), escaped(row.note));
      if (!row.details.empty() || !row.picture.empty()) {
        html += fmt::format("<details><summary>proof</summary><pre>{}</pre>{}</details>", escaped(row.details),
                            row.picture);
      }
      html += "</td></tr>\n";
    }
    html += "</table>\n";
  }
  return html + script;
}

}  // namespace clues::app
