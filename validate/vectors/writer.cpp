// Values that fit on the rest of a line stay on it; others are broken at their outermost brackets.
#include "validate/vectors/writer.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace clues::validate {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kColumns = 120;

std::string one_line(const ordered_json& value) {
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, item] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += ordered_json(key).dump() + ": ";
    text += one_line(item);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

void print(const ordered_json& value, std::size_t indent, std::size_t column, std::string& out) {
  const std::string flat = one_line(value);
  if (!value.is_structured() || value.empty() || column + flat.size() < kColumns) {  // one column for the comma
    out += flat;
    return;
  }
  const std::string margin(indent + 2, ' ');
  out += value.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    out += first ? "\n" : ",\n";
    out += margin;
    first = false;
    const std::string label = value.is_object() ? ordered_json(key).dump() + ": " : "";
    out += label;
    print(item, indent + 2, margin.size() + label.size(), out);
  }
  out += '\n';
  out.append(indent, ' ');
  out += value.is_object() ? '}' : ']';
}

std::string text_of(const ordered_json& value) {
  std::string text;
  print(value, 0, kColumns, text);  // the outermost object is always broken
  return text + "\n";
}

ordered_json points_json(const std::vector<scene::Point>& points) {
  auto list = ordered_json::array();
  for (const auto& p : points) list.push_back({to_hex_float(p[0]), to_hex_float(p[1]), to_hex_float(p[2])});
  return list;
}

ordered_json expectation_json(const Expectation& expect) {
  auto visible = ordered_json::array(), umbra = ordered_json::array();
  for (const auto& seen : expect.must_be_visible) {
    if (seen.meets_cell) {
      visible.push_back({{"triangle", seen.triangle}, {"meets_cell", true}});
    } else {
      visible.push_back({{"triangle", seen.triangle}, {"front", seen.front}, {"v", seen.v}, {"p", seen.p}});
    }
  }
  for (const auto& hidden : expect.umbra) {
    umbra.push_back({{"triangle", hidden.triangle},
                     {"proof", hidden.proof == UmbraProof::first_order_map ? "first_order_map" : "exhaustive"}});
  }
  return {{"must_be_visible", visible},
          {"umbra", umbra},
          {"no_surface", expect.no_surface},
          {"first_order_visible", expect.first_order_visible}};
}

ordered_json case_json(const VectorCase& c) {
  ordered_json value{{"id", c.id},
                     {"comment", c.comment},
                     {"flags", c.flags},
                     {"level", c.level == CaseLevel::core ? "core" : "full"},
                     {"scene", c.scene},
                     {"mode", c.mode == CaseMode::sheet ? "sheet" : "solid"},
                     {"cell", points_json(c.cell)}};
  if (c.expect) value["expect"] = expectation_json(*c.expect);
  return value;
}

}  // namespace

std::string to_hex_float(double x) {
  char digits[64];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, std::fabs(x), std::chars_format::hex);
  return fmt::format("{}0x{}", std::signbit(x) ? "-" : "",
                     std::string_view(digits, static_cast<std::size_t>(end - digits)));
}

std::string to_json_text(const VectorFile& file) {
  auto notes = ordered_json::object(), scenes = ordered_json::object();
  for (const auto& [flag, note] : file.notes) {
    notes[flag] = {{"bug_type", note.bug_type},
                   {"description", note.description},
                   {"effect", note.effect},
                   {"hazards", note.hazards}};
  }
  for (const auto& [name, scene] : file.scenes) {
    scenes[name] = {{"vertices", points_json(scene.vertices)}, {"triangles", scene.triangles}};
    if (!scene.see_through.empty()) scenes[name]["see_through"] = scene.see_through;
    if (!scene.not_counted.empty()) scenes[name]["not_counted"] = scene.not_counted;
  }
  auto cases = ordered_json::array();
  for (const auto& c : file.cases) cases.push_back(case_json(c));
  return text_of({{"format", "clues-vectors/1"},
                  {"topic", file.topic},
                  {"definition", file.definition},
                  {"source",
                   {{"name", file.source.name},
                    {"version", file.source.version},
                    {"seed", file.source.seed ? ordered_json(*file.source.seed) : ordered_json(nullptr)},
                    {"confirmed_by", file.source.confirmed_by}}},
                  {"notes", notes},
                  {"scenes", scenes},
                  {"cases", cases}});
}

std::string to_json_text(const VectorIndex& index) {
  auto topics = ordered_json::object(), cases = ordered_json::object();
  for (const auto& [topic, count] : index.topics) topics[topic] = count;
  for (const auto& [id, entry] : index.cases) {
    cases[id] = {{"topic", entry.topic}, {"status", entry.withdrawn ? "withdrawn" : "active"}};
    if (entry.withdrawn) cases[id]["reason"] = entry.reason;
  }
  return text_of({{"format", "clues-vectors-index/1"},
                  {"active", index.active},
                  {"withdrawn", index.withdrawn},
                  {"topics", topics},
                  {"cases", cases}});
}

std::string to_json_text(const Expectation& expect) { return text_of(expectation_json(expect)); }

}  // namespace clues::validate
