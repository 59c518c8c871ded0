// docs/protocol.md in code.
#include "validate/conform/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

#include "scene/json_reader.h"
#include "scene/messages/printable.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;

std::string excerpt(std::string_view text) { return fmt::format("'{}'", scene::printable(text, 80)); }

Json parse_object(std::string_view line) {
  Json json;
  try {
    json = scene::parse_json_text(line);
  } catch (const scene::JsonError& error) {
    const std::string_view what = error.what(), not_json = "this is not JSON";
    throw ProtocolError("the line " + excerpt(line) +
                        (what.starts_with(not_json) ? " is not JSON" + std::string(what.substr(not_json.size()))
                                                    : ": " + std::string(what)));
  }
  if (!json.is_object()) throw ProtocolError("the line " + excerpt(line) + " is not a JSON object");
  return json;
}

void only_fields(const Json& object, std::initializer_list<const char*> known, const std::string& where) {
  if (!object.is_object()) throw ProtocolError(where + " is not an object");
  for (const auto& [key, value] : object.items()) {
    if (std::none_of(known.begin(), known.end(), [&k = key](const char* name) { return k == name; })) {
      throw ProtocolError(where + " has the unknown field " + excerpt(key));
    }
  }
}

const Json& field(const Json& object, const char* name, const std::string& where) {
  const auto found = object.find(name);
  if (found == object.end()) throw ProtocolError(fmt::format("{} has no field '{}'", where, name));
  return *found;
}

std::string text_of(const Json& value, const std::string& where) {
  if (!value.is_string()) throw ProtocolError(where + " is not a string");
  return value.get<std::string>();
}

std::string optional_text(const Json& object, const char* name, const std::string& where) {
  const auto found = object.find(name);
  return found == object.end() ? std::string() : text_of(*found, fmt::format("{}, '{}'", where, name));
}

bool is_index(const Json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max();
}

void check_protocol(const Json& object, const std::string& where) {
  const auto& version = field(object, "protocol", where);
  if (!version.is_number_unsigned() || version != protocol_version) {
    throw ProtocolError(fmt::format("{} speaks protocol {}, and this is protocol {}", where,
                                    scene::json_excerpt(version), protocol_version));
  }
}

std::vector<std::uint32_t> visible_ids(const Json& result, std::size_t triangles) {
  const auto& list = field(result, "visible", "'result'");
  if (!list.is_array()) throw ProtocolError("'visible' is not a list");
  std::vector<std::uint32_t> ids;
  for (const auto& id : list) {
    if (!id.is_number_integer())
      throw ProtocolError("'visible' holds " + scene::json_excerpt(id) + ", which is not a triangle id");
    if (!is_index(id) || id.get<std::uint32_t>() >= triangles) {
      throw ProtocolError(fmt::format("'visible' holds {}, but the scene has the triangles 0 to {}",
                                      scene::json_excerpt(id), triangles - 1));
    }
    ids.push_back(id.get<std::uint32_t>());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

// The kinds of reply without a PVS, by their field.
struct Refusal {
  const char* name;
  AnswerKind kind;
};
constexpr Refusal refusals[] = {{"skipped", AnswerKind::skipped},
                                {"rejected", AnswerKind::rejected_input},
                                {"errored", AnswerKind::errored},
                                {"malformed", AnswerKind::malformed_output}};

Answer reply_of(const Json& json, std::uint32_t seq, std::size_t triangles) {
  only_fields(json, {"seq", "result", "skipped", "rejected", "errored", "malformed"}, "the reply");
  const auto& echoed = field(json, "seq", "the reply");
  if (!is_index(echoed) || echoed.get<std::uint32_t>() != seq)
    throw ProtocolError(fmt::format("the reply has the sequence number {}, not {}", scene::json_excerpt(echoed), seq));
  if (json.size() != 2) {
    throw ProtocolError(
        "the reply has to hold exactly one of 'result', 'skipped', 'rejected', 'errored' and 'malformed'");
  }
  Answer answer;
  if (const auto result = json.find("result"); result != json.end()) {
    only_fields(*result, {"visible", "stats"}, "'result'");
    answer.visible = visible_ids(*result, triangles);
    return answer;
  }
  for (const auto& [name, kind] : refusals) {
    const auto found = json.find(name);
    if (found == json.end()) continue;
    const auto where = fmt::format("'{}'", name);
    only_fields(*found, {"message", "issue_url"}, where);
    answer.kind = kind;
    answer.message = text_of(field(*found, "message", where), where + ", 'message'");
    answer.issue_url = optional_text(*found, "issue_url", where);
  }
  return answer;
}

scene::Point point_of(const Json& value) {
  if (!value.is_array() || value.size() != 3 ||
      !std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_number(); })) {
    throw ProtocolError("the point " + scene::json_excerpt(value) + " is not three numbers");
  }
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

std::vector<scene::Point> points_of(const Json& list, const char* name) {
  if (!list.is_array()) throw ProtocolError(fmt::format("'{}' is not a list", name));
  std::vector<scene::Point> points;
  for (const auto& point : list) points.push_back(point_of(point));
  return points;
}

scene::TriangleMesh mesh_of(const Json& json) {
  only_fields(json, {"vertices", "triangles", "see_through", "not_counted"}, "'scene'");
  scene::TriangleMesh mesh;
  mesh.points = points_of(field(json, "vertices", "'scene'"), "vertices");
  const auto& triangles = field(json, "triangles", "'scene'");
  if (!triangles.is_array()) throw ProtocolError("'triangles' is not a list");
  for (const auto& corners : triangles) {
    const bool fits =
        corners.is_array() && corners.size() == 3 && std::all_of(corners.begin(), corners.end(), [&](const Json& c) {
          return is_index(c) && c.get<std::uint32_t>() < mesh.points.size();
        });
    if (!fits) throw ProtocolError("the triangle " + scene::json_excerpt(corners) + " is not three vertex numbers");
    mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back(
        {corners[0].get<std::uint32_t>(), corners[1].get<std::uint32_t>(), corners[2].get<std::uint32_t>()});
  }
  return mesh;
}

// The flags of n triangles, of which those listed in the field lack one; none where the field is not there.
std::vector<std::uint8_t> flags_of(const Json& scene, const char* name, std::size_t n) {
  const auto found = scene.find(name);
  if (found == scene.end()) return {};
  if (!found->is_array() || found->empty()) throw ProtocolError(fmt::format("'{}' is not a list of triangles", name));
  std::vector<std::uint8_t> flags(n, 1);
  for (const auto& id : *found) {
    if (!is_index(id) || id.get<std::uint32_t>() >= n)
      throw ProtocolError(fmt::format("'{}' holds {}, which is no triangle", name, scene::json_excerpt(id)));
    flags[id.get<std::uint32_t>()] = 0;
  }
  return flags;
}

std::vector<std::uint32_t> ids_without(const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < flags.size(); ++t) {
    if (flags[t] == 0) ids.push_back(t);
  }
  return ids;
}

Json scene_json(const VectorCase& test) {
  Json scene = {{"vertices", test.mesh.points}, {"triangles", test.mesh.triangles}};
  if (!test.blocks.empty()) scene["see_through"] = ids_without(test.blocks);
  if (!test.counts.empty()) scene["not_counted"] = ids_without(test.counts);
  return scene;
}

// What an implementation writes need not be UTF-8; JSON must be.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string start_request() { return dump({{"cmd", "start"}, {"protocol", protocol_version}}); }

std::string run_request(std::uint32_t seq, const VectorCase& test) {
  // The library writes the shortest decimal that reads back as the same double.
  return dump({{"cmd", "run"},
               {"seq", seq},
               {"case",
                {{"id", test.id},
                 {"mode", test.mode == CaseMode::solid ? "solid" : "sheet"},
                 {"cell", test.cell},
                 {"scene", scene_json(test)}}}});
}

std::string stop_request() { return dump({{"cmd", "stop"}}); }

Implementation parse_start_reply(std::string_view line) {
  const std::string where = "the reply to 'start'";
  const auto json = parse_object(line);
  only_fields(json, {"protocol", "implementation", "capabilities"}, where);
  check_protocol(json, where);
  const auto& about = field(json, "implementation", where);
  only_fields(about, {"name", "version", "language", "homepage", "issues"}, "'implementation'");
  Implementation result;
  result.name = text_of(field(about, "name", "'implementation'"), "'name'");
  result.version = text_of(field(about, "version", "'implementation'"), "'version'");
  result.language = optional_text(about, "language", "'implementation'");
  result.homepage = optional_text(about, "homepage", "'implementation'");
  result.issues = optional_text(about, "issues", "'implementation'");
  const auto& can = field(json, "capabilities", where);
  only_fields(can, {"modes", "input", "see_through"}, "'capabilities'");
  const auto& modes = field(can, "modes", "'capabilities'");
  if (!modes.is_array() || modes.empty()) throw ProtocolError("'modes' is not a list of \"sheet\" and \"solid\"");
  result.sheet = result.solid = false;
  for (const auto& mode : modes) {
    if (mode != "sheet" && mode != "solid")
      throw ProtocolError("'modes' holds " + scene::json_excerpt(mode) + "; use \"sheet\" and \"solid\"");
    (mode == "sheet" ? result.sheet : result.solid) = true;
  }
  const auto& input = field(can, "input", "'capabilities'");
  if (input != "float64" && input != "float32")
    throw ProtocolError("'input' is " + scene::json_excerpt(input) + "; use \"float64\" or \"float32\"");
  result.float32 = input == "float32";
  if (const auto found = can.find("see_through"); found != can.end()) {
    if (!found->is_boolean()) throw ProtocolError("'see_through' is neither true nor false");
    result.see_through = found->get<bool>();
  }
  return result;
}

Answer parse_reply(std::string_view line, std::uint32_t seq, std::size_t triangles) {
  try {
    return reply_of(parse_object(line), seq, triangles);
  } catch (const ProtocolError& error) {
    Answer answer;
    answer.kind = AnswerKind::malformed_output;
    answer.message = error.what();
    return answer;
  }
}

Request parse_request(std::string_view line) {
  const auto json = parse_object(line);
  const auto& cmd = field(json, "cmd", "the request");
  Request request;
  if (cmd == "start") {
    only_fields(json, {"cmd", "protocol"}, "the request");
    check_protocol(json, "the request");
  } else if (cmd == "stop") {
    only_fields(json, {"cmd"}, "the request");
    request.kind = Request::Kind::stop;
  } else if (cmd == "run") {
    only_fields(json, {"cmd", "seq", "case"}, "the request");
    request.kind = Request::Kind::run;
    const auto& seq = field(json, "seq", "the request");
    if (!is_index(seq))
      throw ProtocolError("'seq' is " + scene::json_excerpt(seq) + "; it is a whole number below 2^32");
    request.seq = seq.get<std::uint32_t>();
    const auto& test = field(json, "case", "the request");
    only_fields(test, {"id", "mode", "cell", "scene"}, "'case'");
    const auto mode = text_of(field(test, "mode", "'case'"), "'mode'");
    if (mode != "sheet" && mode != "solid") throw ProtocolError("'mode' is " + excerpt(mode) + "; use sheet or solid");
    request.mode = mode == "solid" ? CaseMode::solid : CaseMode::sheet;
    request.cell = points_of(field(test, "cell", "'case'"), "cell");
    const auto& scene = field(test, "scene", "'case'");
    request.mesh = mesh_of(scene);
    request.blocks = flags_of(scene, "see_through", request.mesh.triangles.size());
    request.counts = flags_of(scene, "not_counted", request.mesh.triangles.size());
    for (std::size_t t = 0; t < std::min(request.blocks.size(), request.counts.size()); ++t) {
      if (request.blocks[t] == 0 && request.counts[t] == 0)
        throw ProtocolError(fmt::format("triangle {} is in 'see_through' and in 'not_counted'", t));
    }
  } else {
    throw ProtocolError("the command " + scene::json_excerpt(cmd) + " is not one of start, run and stop");
  }
  return request;
}

std::string start_reply(const Implementation& implementation) {
  Json about = {{"name", implementation.name}, {"version", implementation.version}};
  if (!implementation.language.empty()) about["language"] = implementation.language;
  if (!implementation.homepage.empty()) about["homepage"] = implementation.homepage;
  if (!implementation.issues.empty()) about["issues"] = implementation.issues;
  Json modes = Json::array();
  if (implementation.sheet) modes.push_back("sheet");
  if (implementation.solid) modes.push_back("solid");
  Json can = {{"modes", modes}, {"input", implementation.float32 ? "float32" : "float64"}};
  if (implementation.see_through) can["see_through"] = true;
  return dump({{"protocol", protocol_version}, {"implementation", about}, {"capabilities", can}});
}

std::string run_reply(std::uint32_t seq, const Answer& answer) {
  Json json = {{"seq", seq}};
  if (answer.kind == AnswerKind::visible) json["result"] = {{"visible", answer.visible}};
  for (const auto& [name, kind] : refusals) {
    if (answer.kind != kind) continue;
    json[name] = {{"message", answer.message}};
    if (!answer.issue_url.empty()) json[name]["issue_url"] = answer.issue_url;
  }
  return dump(json);
}

}  // namespace clues::validate
