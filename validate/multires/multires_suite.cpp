// Reads and writes the cases of vectors/multires.
#include "validate/multires/multires_suite.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "validate/vectors/side_topic.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;

constexpr const char* multires_format = "clues-multires-vectors/1";
constexpr std::array kind_words{"surface", "file", "plain"};
constexpr std::array vertex_words{"removable", "fixed", "high", "link", "flat"};
constexpr std::array verdict_words{"proved", "refuted", "undecided"};
constexpr std::array check_words{"E1", "E2", "E3", "E4", "E5", "E6"};

const Json& list_in(const Json& object, const char* key, const std::string& where) {
  if (!object[key].is_array()) refuse(where, fmt::format("\"{}\" must be a list", key));
  return object[key];
}

template <std::size_t n>
std::string word_in(const Json& value, const std::array<const char*, n>& words, const std::string& where) {
  const std::string word = text_in(value, where);
  if (std::find(words.begin(), words.end(), word) == words.end()) refuse(where, "'" + word + "' is not known here");
  return word;
}

std::uint32_t number_in(const Json& value, std::size_t count, const std::string& where) {
  if (count == 0) refuse(where, "there is nothing that a number could name");
  try {
    return static_cast<std::uint32_t>(scene::whole_number(value, "a number", count - 1));
  } catch (const scene::JsonError& e) {
    refuse(where, e.what());
  }
}

template <std::size_t n>
std::array<std::uint32_t, n> numbers_in(const Json& value, std::size_t count, const std::string& where) {
  if (!value.is_array() || value.size() != n) refuse(where, fmt::format("must be a list of {} numbers", n));
  std::array<std::uint32_t, n> out{};
  for (std::size_t k = 0; k < n; ++k) out[k] = number_in(value[k], count, where);
  return out;
}

scene::TriangleMesh mesh_in(const Json& object, const std::string& where) {
  scene::TriangleMesh out;
  for (const Json& point : list_in(object, "vertices", where)) {
    if (!point.is_array() || point.size() != 3) refuse(where + ": vertices", "a vertex has three coordinates");
    auto& at = out.points.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!point[i].is_number()) refuse(where + ": vertices", scene::json_excerpt(point[i]) + " is no number");
      at[i] = point[i].get<double>();
    }
  }
  for (const Json& t : list_in(object, "triangles", where)) {
    out.face_of.push_back(static_cast<std::uint32_t>(out.triangles.size()));
    out.triangles.push_back(numbers_in<3>(t, out.points.size(), where + ": triangles"));
  }
  if (out.triangles.empty()) refuse(where, "there is no triangle");
  return out;
}

void read_surface_facts(const Json& expect, MultiresVector& out, const std::string& where) {
  const std::size_t vertices = out.mesh.points.size();
  if (expect.is_object() && expect.contains("refused")) {
    check_keys(expect, {"refused"}, {}, where);
    const Json& place = expect["refused"];
    check_keys(place, {}, {"edge", "vertex", "triangle"}, where + ": refused");
    if (place.size() != 1) refuse(where + ": refused", "one edge, vertex or triangle is the place");
    out.refused.emplace();
    if (place.contains("edge")) {
      const auto e = numbers_in<2>(place["edge"], vertices, where + ": edge");
      out.refused->edge = scene::edge_of(e[0], e[1]);
    } else if (place.contains("vertex")) {
      out.refused->vertex = number_in(place["vertex"], vertices, where + ": vertex");
    } else {
      out.refused->triangle = number_in(place["triangle"], out.mesh.triangles.size(), where + ": triangle");
    }
    return;
  }
  check_keys(expect, {"components", "genus", "boundaries", "vertices"}, {}, where);
  SurfaceFacts facts;
  constexpr std::size_t any = 1U << 30;
  facts.components = number_in(expect["components"], any, where + ": components");
  facts.genus = number_in(expect["genus"], any, where + ": genus");
  facts.boundaries = number_in(expect["boundaries"], any, where + ": boundaries");
  for (const Json& word : list_in(expect, "vertices", where))
    facts.vertices.push_back(word_in(word, vertex_words, where + ": vertices"));
  if (facts.vertices.size() != vertices) refuse(where, "\"vertices\" must have a word for each vertex");
  out.facts = std::move(facts);
}

void read_findings(const Json& expect, MultiresVector& out, const std::string& where) {
  std::vector<std::string> findings;
  for (const Json& word : list_in(expect, "findings", where))
    findings.push_back(word_in(word, check_words, where + ": findings"));
  if (!std::is_sorted(findings.begin(), findings.end()) ||
      std::adjacent_find(findings.begin(), findings.end()) != findings.end())
    refuse(where, "\"findings\" must ascend");
  out.findings = std::move(findings);
}

void read_plain(const Json& value, MultiresVector& out, const std::string& where) {
  for (const char* key : {"input", "base"}) check_keys(value[key], {"vertices", "triangles"}, {}, where + ": " + key);
  out.mesh = mesh_in(value["input"], where + ": input");
  out.base = mesh_in(value["base"], where + ": base");
  for (const Json& line : list_in(value, "map", where)) {
    if (!line.is_array() || line.size() < 3 || line.size() > 4)
      refuse(where + ": map", "a line is a base triangle and two or three coordinates");
    scene::PlainMapLine read;
    read.triangle = number_in(line[0], out.base.triangles.size(), where + ": map");
    for (std::size_t k = 1; k < line.size(); ++k) read.weights[k - 1] = text_in(line[k], where + ": map");
    out.map.push_back(std::move(read));
  }
  if (out.map.size() != out.mesh.points.size()) refuse(where, "\"map\" must have a line for each vertex of the input");
}

MultiresVector case_in(const Json& value, const std::string& file, bool drafts) {
  MultiresVector out;
  out.file = file;
  out.source = value;
  out.id = case_id_in(value, file);
  const std::string where = place_of_case(file, out.id);
  if (!value.contains("kind")) refuse(where, "the field \"kind\" is missing");
  const std::string kind = word_in(value["kind"], kind_words, where + ": kind");
  std::vector<std::string> required{"id", "comment", "kind"}, optional{"expect"};
  if (kind == "surface") {
    required.insert(required.end(), {"vertices", "triangles"});
    optional.insert(optional.end(), {"features", "fixed"});
  } else if (kind == "file") {
    required.emplace_back("lines");
  } else {
    required.insert(required.end(), {"input", "base", "map"});
  }
  check_keys(value, required, optional, where);
  out.comment = comment_in(value, where);
  if (!value.contains("expect") && !drafts) refuse_draft(where);
  const Json* expect = value.contains("expect") ? &value["expect"] : nullptr;
  const std::string at = where + ": expect";
  if (kind == "surface") {
    out.mesh = mesh_in(value, where);
    if (value.contains("features")) {
      for (const Json& e : list_in(value, "features", where)) {
        const auto ends = numbers_in<2>(e, out.mesh.points.size(), where + ": features");
        out.features.push_back(scene::edge_of(ends[0], ends[1]));
      }
    }
    if (value.contains("fixed")) {
      for (const Json& v : list_in(value, "fixed", where))
        out.fixed.push_back(number_in(v, out.mesh.points.size(), where + ": fixed"));
    }
    if (expect != nullptr) read_surface_facts(*expect, out, at);
  } else if (kind == "file") {
    out.kind = MultiresKind::file;
    for (const Json& line : list_in(value, "lines", where)) out.text += text_in(line, where + ": lines") + "\n";
    if (expect != nullptr) {
      check_keys(*expect, {"findings"}, {}, at);
      read_findings(*expect, out, at);
    }
  } else {
    out.kind = MultiresKind::plain;
    read_plain(value, out, where);
    if (expect != nullptr) {
      check_keys(*expect, {"verdict", "findings"}, {}, at);
      out.verdict = word_in((*expect)["verdict"], verdict_words, at);
      read_findings(*expect, out, at);
    }
  }
  return out;
}

Json expectation_of(const MultiresVector& test) {
  if (test.refused) {
    if (test.refused->edge) return {{"refused", {{"edge", *test.refused->edge}}}};
    if (test.refused->vertex) return {{"refused", {{"vertex", *test.refused->vertex}}}};
    return {{"refused", {{"triangle", *test.refused->triangle}}}};
  }
  if (test.facts) {
    return {{"components", test.facts->components},
            {"genus", test.facts->genus},
            {"boundaries", test.facts->boundaries},
            {"vertices", test.facts->vertices}};
  }
  Json out{{"findings", test.findings.value_or(std::vector<std::string>())}};
  if (test.kind == MultiresKind::plain) out["verdict"] = test.verdict;
  return out;
}

std::string case_to_text(const MultiresVector& test) {
  std::string out = "    {";
  const auto field = [&out](const char* key, const Json& value) {
    out += fmt::format("{}\n      \"{}\": ", out.back() == '{' ? "" : ",", key);
    if (std::string_view(key) != "lines") {
      out += value.dump();
      return;
    }
    out += "[";
    for (std::size_t k = 0; k < value.size(); ++k)
      out += fmt::format("{}\n        {}", k == 0 ? "" : ",", value[k].dump());
    out += "\n      ]";
  };
  for (const char* key :
       {"id", "comment", "kind", "vertices", "triangles", "features", "fixed", "lines", "input", "base", "map"}) {
    if (test.source.contains(key)) field(key, test.source[key]);
  }
  if (test.has_expectation()) field("expect", expectation_of(test));
  return out + "\n    }";
}

}  // namespace

bool is_multires_suite(const std::filesystem::path& folder) { return is_suite_of(folder, multires_format); }

MultiresTopic parse_multires_topic(std::string_view text, const std::string& file, bool drafts) {
  return topic_in<MultiresTopic>(text, file, multires_format,
                                 [&](const Json& value) { return case_in(value, file, drafts); });
}

MultiresTopic read_multires_topic(const std::filesystem::path& path, bool drafts) {
  return parse_multires_topic(scene::read_file_bytes(path), path.string(), drafts);
}

std::string to_json_text(const MultiresTopic& topic) {
  std::vector<std::string> cases;
  for (const MultiresVector& test : topic.cases) cases.push_back(case_to_text(test));
  return topic_to_text(multires_format, topic.topic, cases);
}

}  // namespace clues::validate
