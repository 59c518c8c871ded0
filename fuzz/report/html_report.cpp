#include "fuzz/report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "fuzz/findings/json_fields.h"
#include "fuzz/report/cells_section.h"
#include "fuzz/shrinking/finding_folder.h"
#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/messages/shell_word.h"
#include "validate/vectors/reader.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

constexpr std::size_t largest_picture = 2000;  // triangles

// As text of a page: no markup, and no controls.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : scene::printable_lines(text)) {
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

// A whole page as the value of an attribute.
std::string quoted(const std::string& page) {
  std::string out;
  out.reserve(page.size() + page.size() / 16);
  for (const char c : page) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string picture(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell,
                    std::optional<std::uint32_t> triangle, const std::optional<WitnessText>& witness) {
  if (mesh.triangles.size() > largest_picture || cell.empty()) return "";
  Finding finding;
  finding.where.mesh = mesh;
  finding.where.cell = cell;
  finding.triangle = triangle;
  finding.witness = witness;
  return picture_of(finding);
}

using Coordinates = std::array<std::string, 3>;

WitnessText witness_of(const json& w, const Coordinates& v, const Coordinates& p) {
  return {whole_number<std::uint32_t>(w, "triangle"), w.at("side") == "front", v, p};
}

std::string sight_text(const WitnessText& w) {
  return fmt::format("free sight line from ({}, {}, {})\nto ({}, {}, {})\n", w.v[0], w.v[1], w.v[2], w.p[0], w.p[1],
                     w.p[2]);
}

std::string bounds_text(const json& bounds) {
  if (bounds.is_null()) return "-";
  const double low = bounds.at("at_least").get<double>(), high = bounds.at("at_most").get<double>();
  return low == high ? fmt::format("{:.4g}", low) : fmt::format("{:.4g} to {:.4g}", low, high);
}

// What is wrong with a scene or a suite is no matter of the page: it has no pictures then.
std::optional<scene::TriangleMesh> scene_for_pictures(const fs::path& file) {
  try {
    return scene::read_mesh(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::map<std::string, validate::VectorCase> suite_for_pictures(const fs::path& folder) {
  std::map<std::string, validate::VectorCase> suite;
  try {
    for (auto& c : validate::read_suite(folder)) suite.emplace(c.id, std::move(c));
  } catch (const Error&) {
  }
  return suite;
}

// A number, or null: nothing that could be long or deep.
std::string number_text(const json& value) { return value.is_null() ? "null" : json(value.get<double>()).dump(); }

ReportSection judgement_section(const json& j, bool look_around) {
  ReportSection section;
  const json &counts = j.at("triangles_measured"), &areas = j.at("area_measured");
  section.summary =
      fmt::format("verdict: {}\nscene: {}\noverestimate Qo = {}, in area {}\nunderestimate Qu = {}, in area {}\n",
                  j.at("verdict").get<std::string>(), j.at("scene").get<std::string>(),
                  bounds_text(counts.at("overestimate_qo")), bounds_text(areas.at("overestimate_qo")),
                  bounds_text(counts.at("underestimate_qu")), bounds_text(areas.at("underestimate_qu")));
  std::map<std::uint32_t, WitnessText> witnesses;
  for (const json& w : j.at("witnesses")) {
    const auto found = witness_of(w, three_texts(w.at("v").at("exact")), three_texts(w.at("p").at("exact")));
    witnesses.emplace(found.triangle, found);
  }
  std::map<std::uint32_t, std::string> chains;
  for (const json& chain : j.at("chains")) {
    std::string& text = chains[whole_number<std::uint32_t>(chain, "triangle")];
    for (const json& link : chain.at("links")) {
      const auto v = three_texts(link.at("v").at("exact")), x = three_texts(link.at("x").at("exact"));
      text += fmt::format("{} from ({}, {}, {})\n  to ({}, {}, {})\n", text.empty() ? "seen" : "and on", v[0], v[1],
                          v[2], x[0], x[1], x[2]);
    }
  }
  std::optional<scene::TriangleMesh> mesh;
  if (look_around) mesh = scene_for_pictures(j.at("scene").get<std::string>());
  std::vector<scene::Point> cell;
  for (const json& p : j.at("cell")) cell.push_back(three<double>(p, [](const json& x) { return x.get<double>(); }));
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
      row.has_scene = true;
      row.picture = picture(*mesh, cell, t, seen != witnesses.end() ? std::optional(seen->second) : std::nullopt);
    }
    section.rows.push_back(std::move(row));
  }
  return section;
}

ReportSection conformance_section(const json& j, bool look_around) {
  ReportSection section;
  const json& total = j.at("total");
  section.summary = fmt::format(
      "implementation: {} {}\nsubject: {}\nsuite: {}\n{} cases: ", j.at("implementation").at("name").get<std::string>(),
      j.at("implementation").at("version").get<std::string>(), j.at("subject").get<std::string>(),
      j.at("suite").get<std::string>(), whole_number<std::uint64_t>(total, "cases"));
  for (const auto& [outcome, count] : total.at("outcomes").items()) {
    if (count != 0) section.summary += fmt::format("{} {}, ", whole<std::uint64_t>(count), outcome);
  }
  section.summary += fmt::format("Qo = {}, Qu = {}\n", number_text(total.at("overestimate_qo")),
                                 number_text(total.at("underestimate_qu")));
  std::map<std::string, validate::VectorCase> suite;
  if (look_around) suite = suite_for_pictures(j.at("suite").get<std::string>());
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
      std::optional<WitnessText> witness;
      if (first.contains("v")) {
        witness = witness_of(first, three_texts(first.at("v")), three_texts(first.at("p")));
        row.details += fmt::format("missing: triangle {}, {}", witness->triangle, sight_text(*witness));
      } else {
        row.details +=
            fmt::format("missing: triangle {}, which meets the cell\n", whole_number<std::uint32_t>(first, "triangle"));
      }
      if (test != suite.end()) {
        row.has_scene = true;
        row.picture =
            picture(test->second.mesh, test->second.cell, whole_number<std::uint32_t>(first, "triangle"), witness);
      }
    }
    section.rows.push_back(std::move(row));
  }
  return section;
}

ReportSection finding_section(const fs::path& folder) {
  const SavedFinding saved = load_finding(folder);
  const Finding& f = saved.finding;
  ReportSection section;
  section.summary = "subject: " + saved.subject + "\n";
  ReportRow row{
      f.verdict, f.oracle, f.explanation, true, "verify: clues replay " + scene::shell_word(folder.string()) + "\n",
      "",        true};
  if (f.witness) row.details += sight_text(*f.witness);
  row.picture = picture(f.where.mesh, f.where.cell, f.triangle, f.witness);
  section.rows.push_back(std::move(row));
  return section;
}

constexpr const char* head = R"(<style>
body{font:15px/1.4 sans-serif;margin:2em auto;max-width:75em;padding:0 1em;color:#222}
table{border-collapse:collapse;width:100%}td,th{border-bottom:1px solid #ccc;padding:.3em .6em;text-align:left;vertical-align:top}
pre{background:#f4f4f4;padding:.6em;overflow:auto;white-space:pre-wrap;word-break:break-all}
.bad td:first-child{color:#b00000;font-weight:bold}svg{max-width:100%;height:auto}
iframe{position:fixed;right:0;top:0;width:55%;height:100%;border:0;border-left:1px solid #ccc;background:#fff}
body.viewing{margin-right:56%}
@media(max-width:900px){iframe{top:auto;bottom:0;width:100%;height:60%;border-top:1px solid #ccc}body.viewing{margin:1em auto 62vh}}
</style></head><body><h1>clues report</h1>
)";

constexpr const char* about_pictures =
    "<p>Pictures are seen from above (x to the right, y up): cell blue, the triangle in question red, sight line "
    "green.</p>\n";

constexpr const char* filters = R"(<p><label>Show <select id="verdict"><option value="">every verdict</option>)";

constexpr const char* script = R"(<script>
const verdict=document.getElementById('verdict'),text=document.getElementById('text');
function filter(){for(const row of document.querySelectorAll('tr[data-verdict]'))
row.hidden=(verdict.value!==''&&row.dataset.verdict!==verdict.value)||!row.textContent.includes(text.value);}
verdict.oninput=filter;text.oninput=filter;
const holder=document.getElementById('view');
let frame=null;
for(const button of document.querySelectorAll('button[data-file]'))button.onclick=()=>{
const show=()=>frame.contentWindow.cluesView.showRowOf(button.dataset.file,button.dataset.name);
if(frame){show();return;}
document.body.classList.add('viewing');
frame=document.createElement('iframe');frame.title='The scene';
frame.onload=()=>{const wait=()=>frame.contentDocument.body.dataset.ready?show():setTimeout(wait,20);wait();};
frame.srcdoc=holder.dataset.page;document.body.append(frame);};
</script></body></html>
)";

}  // namespace

std::optional<ReportSection> section_of(const std::string& bytes, const fs::path& file, bool look_around) {
  const auto read = [&]() -> std::optional<ReportSection> {
    const json j = scene::parse_json(bytes, file.string());
    const auto format = j.is_object() ? j.find("format") : j.end();
    if (!j.is_object() || format == j.end() || !format->is_string()) return std::nullopt;
    const std::string name = *format;
    if (name == "clues-judgement/1") return judgement_section(j, look_around);
    if (name == "clues-check-cells/1") return cells_section(j);
    if (name == "clues-conformance/1") return conformance_section(j, look_around);
    if (name == "clues-finding/2" && look_around) return finding_section(file.parent_path());
    for (const char* kind : {"clues-judgement/", "clues-check-cells/", "clues-conformance/", "clues-finding/"}) {
      if (name.starts_with(kind) && name != "clues-finding/2")
        throw Error(ErrorCode::unsupported, file.string() + ": is of another version of clues; make it anew");
    }
    return std::nullopt;
  };
  return reading_fields(read, [&](const std::string& what) {
    return Error(ErrorCode::malformed,
                 file.string() + ": is no complete result of this version of clues (" + what + "); make it anew");
  });
}

std::vector<ReportSection> read_results(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw Error(ErrorCode::file_not_found,
                folder.string() + ": there is no such folder; give one with results of clues");
  std::vector<fs::path> files;
  fs::path last = folder;
  for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::recursive_directory_iterator();
       at.increment(error)) {
    last = at->path();
    std::error_code gone;
    if (at->path().extension() == ".json" && at->is_regular_file(gone)) files.push_back(at->path());
  }
  if (error)
    throw Error(ErrorCode::file_unreadable, last.string() + ": cannot read this folder: " + error.message() +
                                                "; check its permissions, or leave it out");
  std::sort(files.begin(), files.end());
  std::vector<ReportSection> sections;
  for (const fs::path& file : files) {
    if (auto section = section_of(scene::read_file_bytes(file), file, true)) {
      section->title = file.lexically_relative(folder).string();
      sections.push_back(std::move(*section));
    }
  }
  return sections;
}

std::string to_html(const std::vector<ReportSection>& sections, const std::string& view) {
  std::set<std::string> verdicts;
  bool pictures = false;
  const auto shown = [&](const ReportSection& section, const ReportRow& row) {
    return !view.empty() && section.in_view && row.has_scene;
  };
  for (const auto& section : sections) {
    for (const auto& row : section.rows) {
      verdicts.insert(row.verdict);
      pictures = pictures || (!row.picture.empty() && !shown(section, row));
    }
  }
  std::string html = std::string(html_begin) + head;
  if (pictures) html += about_pictures;
  html += filters;
  for (const auto& verdict : verdicts) html += fmt::format("<option>{}</option>", escaped(verdict));
  html += "</select></label> <label>with <input id=\"text\" placeholder=\"some text\"></label></p>\n";
  for (const auto& section : sections) {
    html += fmt::format("<h2>{}</h2>\n<pre>{}</pre>\n<table><tr><th>verdict</th><th>what</th><th>notes</th></tr>\n",
                        escaped(section.title), escaped(section.summary));
    for (const auto& row : section.rows) {
      html += fmt::format("<tr data-verdict=\"{0}\"{1}><td>{0}</td><td>{2}</td><td>{3}", escaped(row.verdict),
                          row.bad ? " class=\"bad\"" : "", escaped(row.name), escaped(row.note));
      if (shown(section, row)) {
        html += fmt::format(" <button data-file=\"{}\" data-name=\"{}\">show</button>", escaped(section.title),
                            escaped(row.name));
      }
      if (!row.details.empty() || !row.picture.empty()) {
        html += fmt::format("<details><summary>proof</summary><pre>{}</pre>{}</details>", escaped(row.details),
                            shown(section, row) ? "" : row.picture);
      }
      html += "</td></tr>\n";
    }
    html += "</table>\n";
  }
  if (!view.empty()) html += "<div id=\"view\" hidden data-page=\"" + quoted(view) + "\"></div>\n";
  return html + script;
}

}  // namespace clues::fuzz
