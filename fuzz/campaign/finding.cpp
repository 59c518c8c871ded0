// Findings as JSON: what the store keeps and what workers send.
#include "fuzz/campaign/finding.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "scene/error.h"
#include "scene/json_reader.h"

namespace clues::fuzz {
namespace {

using nlohmann::json;

json to_json(const Finding& f) {
  json out{{"oracle", f.oracle},
           {"verdict", f.verdict},
           {"generator", f.where.generator},
           {"seed", f.where.seed},
           {"index", f.where.index},
           {"points", f.where.mesh.points},
           {"cell", f.where.cell},
           {"triangles", f.where.mesh.triangles},
           {"explanation", f.explanation}};
  if (f.where.solid) out["solid"] = true;
  if (!f.where.dials.empty()) out["dials"] = f.where.dials;
  if (f.triangle) out["triangle"] = *f.triangle;
  if (f.witness) {
    out["witness"] = {
        {"triangle", f.witness->triangle}, {"front", f.witness->front}, {"v", f.witness->v}, {"p", f.witness->p}};
  }
  return out;
}

std::uint32_t id_of(const json& value) {
  return static_cast<std::uint32_t>(
      scene::whole_number(value, "\"triangle\"", std::numeric_limits<std::uint32_t>::max()));
}

scene::Triangle triangle_of(const json& corners, std::size_t points) {
  if (corners.size() != 3) throw scene::JsonError(0, "a triangle has not three corners");
  scene::Triangle triangle{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (points == 0) throw scene::JsonError(0, "a triangle without points");
    triangle[i] =
        static_cast<std::uint32_t>(scene::whole_number(corners.at(i), "the corner of a triangle", points - 1));
  }
  return triangle;
}

Finding to_finding(const json& in) {
  Finding f;
  in.at("oracle").get_to(f.oracle);
  in.at("verdict").get_to(f.verdict);
  in.at("generator").get_to(f.where.generator);
  f.where.seed = scene::whole_number(in.at("seed"), "\"seed\"");
  f.where.index = scene::whole_number(in.at("index"), "\"index\"");
  in.at("points").get_to(f.where.mesh.points);
  for (const json& t : in.at("triangles")) f.where.mesh.triangles.push_back(triangle_of(t, f.where.mesh.points.size()));
  in.at("cell").get_to(f.where.cell);
  in.at("explanation").get_to(f.explanation);
  f.where.solid = in.value("solid", false);
  f.where.dials = in.value("dials", CaseDials{});
  for (std::uint32_t face = 0; face < f.where.mesh.triangles.size(); ++face) f.where.mesh.face_of.push_back(face);
  if (in.contains("triangle")) f.triangle = id_of(in.at("triangle"));
  if (in.contains("witness")) {
    const json& w = in.at("witness");
    f.witness = WitnessText{id_of(w.at("triangle")), w.at("front").get<bool>(),
                            w.at("v").get<std::array<std::string, 3>>(), w.at("p").get<std::array<std::string, 3>>()};
  }
  return f;
}

template <class Read>
auto parsed(const std::string& text, const Read& read) {
  try {
    return read(scene::parse_json_text(text));
  } catch (const json::exception& error) {
    throw scene::Error(scene::ErrorCode::malformed, std::string("this is not a finding: ") + error.what());
  } catch (const scene::JsonError& error) {
    throw scene::Error(scene::ErrorCode::malformed, std::string("this is not a finding: ") + error.what());
  }
}

}  // namespace

std::string to_json_text(const Finding& finding) { return to_json(finding).dump(); }

Finding finding_from_json_text(const std::string& text) { return parsed(text, to_finding); }

std::string to_json_text(const Outcome& outcome) {
  json out{{"findings", json::array()}, {"contradictions", outcome.contradictions}, {"counters", outcome.counters}};
  for (const Finding& f : outcome.findings) out["findings"].push_back(to_json(f));
  return out.dump();
}

Outcome outcome_from_json_text(const std::string& text) {
  return parsed(text, [](const json& in) {
    Outcome outcome;
    in.at("contradictions").get_to(outcome.contradictions);
    in.at("counters").get_to(outcome.counters);
    for (const json& f : in.at("findings")) outcome.findings.push_back(to_finding(f));
    return outcome;
  });
}

}  // namespace clues::fuzz
